# A client of `vs lsp`: lsp.py VS FOLDER ONLY. Prints `ok NAME`, or `not ok NAME` and its reasons.
import json, pathlib, random, re, subprocess, sys, threading

vs, work, only = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]

class Client:
    def __init__(self, initialize=True):
        self.process = subprocess.Popen([vs, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE)
        self.number, self.found = 0, {}
        if initialize: self.capabilities = self.ask("initialize", {"capabilities": {}})["capabilities"]

    def send(self, message):
        body = message if isinstance(message, bytes) else json.dumps(message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def receive(self):
        size = 0
        while (line := self.process.stdout.readline()) not in (b"\r\n", b""):
            if line.startswith(b"Content-Length:"): size = int(line.split(b":")[1])
        return json.loads(self.process.stdout.read(size).decode())

    # The answer; diagnostics that come before it are kept in self.found.
    def ask(self, method, parameters, whole=False):
        self.number += 1
        self.send({"jsonrpc": "2.0", "id": self.number, "method": method, "params": parameters})
        while True:
            m = self.receive()
            if "id" in m: return m if whole else m["result"]
            self.found[m["params"]["uri"]] = m["params"]["diagnostics"]

    def tell(self, method, parameters): self.send({"jsonrpc": "2.0", "method": method, "params": parameters})

    def diagnostics(self):
        m = self.receive()
        self.found[m["params"]["uri"]] = m["params"]["diagnostics"]
        return m["params"]["diagnostics"]

    def open(self, uri, text):
        self.tell("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "scheme", "version": 1, "text": text}})
        return self.diagnostics()

    def change(self, uri, *changes):
        self.tell("textDocument/didChange", {"textDocument": {"uri": uri, "version": 2}, "contentChanges": changes})
        return self.diagnostics()

    def at(self, method, uri, text, place, **more):
        offset = text.index(place.replace("^", "")) + place.index("^")
        return self.ask("textDocument/" + method, {"textDocument": {"uri": uri}, "position": position(text, offset), **more})

    def end(self):
        self.ask("shutdown", None)
        self.tell("exit", None)
        out = self.process.communicate(timeout=60)
        return self.process.returncode, out

def position(text, offset):
    lines = re.split(r"\r\n|\r|\n", text[:offset])
    return {"line": len(lines) - 1, "character": len(lines[-1].encode("utf-16-le")) // 2}

def spanned(text, span):
    lines = re.findall(r"[^\r\n]*(?:\r\n|\r|\n|$)", text)
    def offset(p):
        units, n = 0, 0
        for c in lines[p["line"]]:
            if units >= p["character"]: break
            units, n = units + len(c.encode("utf-16-le")) // 2, n + 1
        return sum(map(len, lines[:p["line"]])) + n
    return offset(span["start"]), offset(span["end"])

def words(text, span):
    a, b = spanned(text, span)
    return text[a:b]

def result(name, reasons):
    if only and only not in name: return
    print(f"not ok {name}" if reasons else f"ok {name}")
    for reason in reasons[:8]: print("    " + str(reason)[:600])

def expect(reasons, what, is_, want):
    if is_ != want: reasons.append(f"{what}: {is_!r}, not {want!r}")

TEXT = '''; A row of towers.
(define height 3) ; 😀 in metres
; Builds a tower of n storeys.
(define (tower n [width positive? 4])
  (let ([größe "😀"] [top (* n height)])
    (display größe)   (make-box origin width width top)))
(draw (tower 3))
'''

def answers():
    reasons, c, uri = [], Client(), "file:///tmp/a%20model.vs"
    for name in re.findall(r'LSP_REQUEST\("textDocument/(\w+)".*?\\"(\w+)\\":', pathlib.Path("cli/lsp/lsp_methods.def").read_text()):
        if name[1] not in c.capabilities: reasons.append(f"{name[0]} is not announced")
    expect(reasons, "findings of a sound text", c.open(uri, TEXT), [])
    hover = c.at("hover", uri, TEXT, "(to^wer 3")
    expect(reasons, "hover", "(tower n [width positive? 4])" in hover["contents"]["value"] and "Builds a tower" in hover["contents"]["value"], True)
    expect(reasons, "its range", words(TEXT, hover["range"]), "tower")
    hover = c.at("hover", uri, TEXT, "(make-b^ox")
    expect(reasons, "hover of the language", "(make-box" in hover["contents"]["value"], True)
    expect(reasons, "hover of a blank", c.at("hover", uri, TEXT, ")  ^ (make-box"), None)
    place = c.at("definition", uri, TEXT, "(display grö^ße")
    expect(reasons, "definition", (place["uri"], words(TEXT, place["range"]), place["range"]["start"]["line"]), (uri, "größe", 4))
    places = c.at("references", uri, TEXT, "(define hei^ght")
    expect(reasons, "references", [(words(TEXT, p["range"]), p["range"]["start"]["line"]) for p in places], [("height", 1), ("height", 4)])
    expect(reasons, "after a character of two units", c.at("references", uri, TEXT, "[t^op (*")[0]["range"]["start"], position(TEXT, TEXT.index("top (*")))
    items = c.at("completion", uri, TEXT, "(make-bo^x")
    box = [i for i in items if i["label"] == "make-box"]
    expect(reasons, "completion", (len(box), words(TEXT, box[0]["textEdit"]["range"])), (1, "make-bo"))
    expect(reasons, "its signature", "(make-box" in box[0]["detail"], True)
    expect(reasons, "completion of a name of the program", [i["label"] for i in c.at("completion", uri, TEXT, "(tow^er 3")][0], "tower")
    help_ = c.at("signatureHelp", uri, TEXT, "(make-box origin ^width")
    first = help_["signatures"][0]
    expect(reasons, "signature", (first["label"].startswith("(make-box"), help_["activeParameter"]), (True, 1))
    help_ = c.at("signatureHelp", uri, TEXT, "(tower 3^")
    label = help_["signatures"][0]["label"]
    expect(reasons, "own signature", [label[a:b] for a, b in (p["label"] for p in help_["signatures"][0]["parameters"])], ["n", "[width positive? 4]"])
    outline = c.ask("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
    expect(reasons, "outline", [(o["name"], words(TEXT, o["selectionRange"])) for o in outline], [("height", "height"), ("tower", "tower")])
    edits = c.at("rename", uri, TEXT, "(display grö^ße", newName="size😀")["changes"][uri]
    renamed = TEXT
    for e in reversed(edits):
        a, b = spanned(renamed, e["range"])
        renamed = renamed[:a] + e["newText"] + renamed[b:]
    expect(reasons, "rename", renamed, TEXT.replace("größe", "size😀"))
    for bad in ("width", "top", "3", "a b", "(", "display", ""):
        offset = TEXT.index("größe") + 1
        m = c.ask("textDocument/rename", {"textDocument": {"uri": uri}, "position": position(TEXT, offset), "newName": bad}, True)
        if "error" not in m: reasons.append(f"größe was renamed to {bad!r}")
    m = c.ask("textDocument/rename", {"textDocument": {"uri": uri}, "position": position(TEXT, TEXT.index("draw")), "newName": "paint"}, True)
    expect(reasons, "rename of a name of the language", "error" in m, True)
    edits = c.ask("textDocument/formatting", {"textDocument": {"uri": uri}, "options": {}})
    done = subprocess.run([vs, "format", "-"], input=TEXT.encode(), capture_output=True).stdout.decode()
    expect(reasons, "formatting", [(words(TEXT, e["range"]), e["newText"]) for e in edits], [(TEXT, done)])
    c.change(uri, {"text": done})
    expect(reasons, "formatting again", c.ask("textDocument/formatting", {"textDocument": {"uri": uri}, "options": {}}), [])
    expect(reasons, "end", c.end(), (0, (b"", b"")))
    return reasons

def findings():
    reasons, c, uri = [], Client(), "file:///tmp/b.vs"
    text = '(define "😀" 1)\n(define (f x) (* x 2))\n(draw (make-bx origin 1 2 3))\n(f 1 2)\n'
    text = text.split("\n", 1)[1]
    found = c.open(uri, text)
    expect(reasons, "findings", [(d["code"], d["severity"], d["range"]["start"]["line"]) for d in found], [("unbound", 2, 1), ("arguments", 2, 2)])
    expect(reasons, "place", words(text, found[0]["range"]), "make-bx")
    expect(reasons, "advice", "make-box" in found[0]["message"], True)
    found = c.change(uri, {"text": text + "(draw (f 1)"})
    expect(reasons, "an open bracket", [(d["code"], d["severity"]) for d in found], [("unreadable", 1)])
    check = subprocess.run([vs, "check", "--json", "/dev/stdin"], input=text.encode(), capture_output=True)
    found = c.change(uri, {"text": text})
    try: expect(reasons, "as vs check", [d["message"] for d in found], [d["details"] for d in json.loads(check.stdout)["findings"]])
    except ValueError: reasons.append(f"vs check: {check.stderr}")
    c.tell("textDocument/didClose", {"textDocument": {"uri": uri}})
    expect(reasons, "after the text is closed", c.diagnostics(), [])
    one, two = work / "one.vs", work / "two.vs"
    two.write_text("\n(define (step n) (* n 2))\n")
    text = '(load "two.vs")\n(draw (make-sphere origin (step 1)))\n'
    one.write_text(text)
    expect(reasons, "two files", c.open(one.as_uri(), text), [])
    place = c.at("definition", one.as_uri(), text, "(st^ep 1")
    expect(reasons, "definition in another file", (place["uri"], place["range"]["start"]), (two.as_uri(), {"line": 1, "character": 9}))
    two.write_text("(define (step n)")
    found = c.change(one.as_uri(), {"text": text})
    expect(reasons, "an error in another file", (len(found), "two.vs:1:1" in found[0]["message"], found[0]["range"]["start"]["line"]), (1, True, 0))
    expect(reasons, "end", c.end()[0], 0)
    return reasons

# Random edits in a text with every kind of line end and with characters of one to four bytes: the server's text, as its
# formatting and its completion show it, is the client's.
def edits():
    reasons, r, c, uri = [], random.Random(59), Client(), "untitled:Untitled-1"
    text = ""
    c.open(uri, text)
    for step in range(120):
        pieces = [r.choice(["a", "ü", "λ", "😀", " ", "\n", "\r\n", "(f x)", "; c\n", '"s"']) for _ in range(r.randrange(6))]
        a, b = sorted((r.randrange(len(text) + 1), r.randrange(len(text) + 1)))
        if text[a - 1:a + 1] == "\r\n" or text[b - 1:b + 1] == "\r\n": continue
        span = {"start": position(text, a), "end": position(text, b)}
        text = text[:a] + "".join(pieces) + text[b:]
        if re.search("\r(?!\n)", text): text = text.replace("\r", "\r\n").replace("\r\n\n", "\r\n"); change = {"text": text}
        else: change = {"range": span, "text": "".join(pieces)}
        c.change(uri, change)
        formatted = c.ask("textDocument/formatting", {"textDocument": {"uri": uri}, "options": {}})
        done = subprocess.run([vs, "format", "-"], input=text.encode(), capture_output=True)
        want = done.stdout.decode() if done.returncode == 0 else text
        got = formatted[0]["newText"] if formatted else text
        if got != want:
            reasons.append(f"step {step}: {got!r}, not {want!r}")
            break
    c.end()
    return reasons

def wrong():
    reasons, c = [], Client(initialize=False)
    expect(reasons, "before initialize", c.ask("textDocument/hover", {}, True)["error"]["code"], -32002)
    c.ask("initialize", {})
    c.send(b"{no json")
    m = c.receive()
    expect(reasons, "no JSON", (m["error"]["code"], m["id"]), (-32700, None))
    expect(reasons, "no method", c.ask("no/method", {}, True)["error"]["code"], -32601)
    c.tell("no/notice", {})
    c.send([1, 2])
    c.send(b"17")
    for method in re.findall(r'LSP_REQUEST\("([^"]+)"', pathlib.Path("cli/lsp/lsp_methods.def").read_text()):
        for parameters in (None, [], 5, {}, {"textDocument": {"uri": "file:///none.vs"}, "position": {"line": -1, "character": 1e30}}):
            m = c.ask(method, parameters, True)
            if ("error" in m) == ("result" in m): reasons.append(f"{method} {parameters}: {m}")
    c.tell("textDocument/didChange", {"textDocument": {"uri": "file:///none.vs"}, "contentChanges": [{"text": "x"}]})
    c.open("file:///c.vs", "(f")
    for method in re.findall(r'LSP_REQUEST\("([^"]+)"', pathlib.Path("cli/lsp/lsp_methods.def").read_text()):
        for place in ({"line": 0, "character": 2}, {"line": 99, "character": 99}, {"line": -5, "character": -5}):
            c.ask(method, {"textDocument": {"uri": "file:///c.vs"}, "position": place, "newName": "x"}, True)
    expect(reasons, "end", c.end(), (0, (b"", b"")))
    def code(text): return subprocess.run([vs, "lsp"], input=text, capture_output=True, timeout=60).returncode
    expect(reasons, "exit without shutdown", code(b'Content-Length: 33\r\n\r\n{"jsonrpc":"2.0","method":"exit"}'), 1)
    expect(reasons, "an end of the input", code(b""), 0)
    expect(reasons, "half a message", code(b"Content-Length: 100\r\n\r\n{"), 0)
    expect(reasons, "a length without end", code(b"Content-Length: 99999999999999999999\r\n\r\n{"), 0)
    return reasons

for test in (answers, findings, edits, wrong):
    try: result("lsp/" + test.__name__, test())
    except Exception as e: result("lsp/" + test.__name__, [repr(e)])
