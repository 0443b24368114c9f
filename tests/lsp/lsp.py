# A client of `vs lsp`: lsp.py VS FOLDER ONLY. Prints `ok NAME`, or `not ok NAME` and its reasons.
import base64, json, os, pathlib, random, re, subprocess, sys, time, urllib.parse, urllib.request, xml.etree.ElementTree as tree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from patience import patience

vs, work, only = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]

class Client:
    def __init__(self, initialize=True, shows=False, environment=None, capabilities={}, options={}, root=None, words=()):
        self.process = subprocess.Popen([vs, "lsp", *map(str, words)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, env=environment)
        self.number, self.found = 0, {}
        if initialize: self.capabilities = self.ask("initialize", {"capabilities": {"window": {"showDocument": {"support": shows}}, **capabilities}, "initializationOptions": options, "rootUri": root})["capabilities"]

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

    def save(self, uri, text):
        pathlib.Path(urllib.parse.unquote(uri.removeprefix("file://"))).write_text(text)
        self.tell("textDocument/didSave", {"textDocument": {"uri": uri}})
        return self.diagnostics()

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
    if reasons is None:
        print(f"skip {name}: no Landlock")
        return
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

def references(c, text):
    c.open("file:///last.vs", text)
    return c.at("references", "file:///last.vs", text, "(define ^x")

def answers():
    reasons, c, uri = [], Client(), "file:///tmp/a%20model.vs"
    for name in re.findall(r'LSP_REQUEST\("([\w/]+)",\s*\w+,\s*(?:"\\"(\w+)\\":|LSP_COLOURS)', pathlib.Path("cli/lsp/lsp_methods.def").read_text()):
        if (name[1] or "semanticTokensProvider") not in c.capabilities: reasons.append(f"{name[0]} is not announced")
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
    expect(reasons, "references to the last word", len(references(c, "(define x 1)\nx")), 2)
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

# Programs with a mistake, and the text that the action of its message makes: the first with advice, or that of the title.
MENDED = [
    ("(draw (make-bx origin 1 2 3))", "(draw (make-box origin 1 2 3))", None),
    ("(draw (make-cilinder origin 3 1))", "(draw (make-cylinder origin 3 1))", None),
    ("(draw (cylinder origin 3 1))", "(draw (make-cylinder origin 3 1))", None),
    ("(draw (do-move (make-sphere origin 1) (xyz 1 2 3)))", "(draw (do-move (make-sphere origin 1) (vxyz 1 2 3)))", None),
    ("(draw (make-sphere (list 0 1 0) 1))", "(draw (make-sphere (xyz 0 1 0) 1))", None),
    ("(draw (make-box 1 2 3))", "(draw (make-box (xyz 0 0 0) (xyz 1 2 3)))", None),
    ("(define i 1)\n(i++)\n(display i)", "(define i 1)\n(set! i (+ i 1))\n(display i)", None),
    ("(define a 3)\n(display (list -a))", "(define a 3)\n(display (list (- a)))", None),
    ("(define l (list 1 2))\n(display (list l.length))", "(define l (list 1 2))\n(display (list (length l)))", None),
    ("(define p (xyz 1 2 3))\n(display (cx (p)))", "(define p (xyz 1 2 3))\n(display (cx p))", None),
    ('(display (string-append "r = " 5))', '(display (string-append "r = " (number->string 5)))', None),
    ("(draw (make-sphere origin 1 #:segment 8))", "(draw (make-sphere origin 1 #:segments 8))", None),
    ("(draw (make-sphere origin 1 segments: 8))", "(draw (make-sphere origin 1 #:segments 8))", None),
    ("(draw (do-rotate (make-box origin 1 1 1) 'z 45))", "(draw (do-rotate (make-box origin 1 1 1) 'z (degrees->radians 45)))", None),
    ("(display (+ 1_000 1))", "(display (+ 1000 1))", None),
    ("(setq x 5)\n(display x)", "(define x 5)\n(display x)", None),
    ("(define (f x) (* 2 2))\n(draw (make-sphere origin (f 1)))", "(define (f _x) (* 2 2))\n(draw (make-sphere origin (f 1)))", None),
    ("(define (f x) (* 2 2)) ; half\n(draw (make-sphere origin (f 1)))", "; check: allow unused-parameter\n(define (f x) (* 2 2)) ; half\n(draw (make-sphere origin (f 1)))", "Allow unused-parameter here"),
    ("(define (f x) (* 2 2))\n(draw (make-sphere origin (f 1)))", "(define (f x) (* 2 2)) ; check: allow unused-parameter\n(draw (make-sphere origin (f 1)))", "Allow unused-parameter here"),
    ("(draw (make-sphere origin 1,5))", "(draw (make-sphere origin 1.5))", None),
    ("(draw (make-sphere origin 2)]", "(draw (make-sphere origin 2))", None),
    ("(define (f x)\n  (let ([y x]\n    (* y x))\n(draw (make-sphere origin (f 1)))", None, None),
    ("(define (f x)\n  (* x x)\n\n(draw (make-sphere origin (f 1)))\n", "(define (f x)\n  (* x x))\n\n(draw (make-sphere origin (f 1)))\n", None),
    ("; ünder 😀\n(draw (make-bx origin 1 2 3)) ; 😀", "; ünder 😀\n(draw (make-box origin 1 2 3)) ; 😀", None),
]

def edited(text, edits):
    for e in reversed(edits):
        a, b = spanned(text, e["range"])
        text = text[:a] + e["newText"] + text[b:]
    return text

def actions_of(c, uri, text):
    found = c.open(uri, text)
    return found, [a for d in found for a in c.ask("textDocument/codeAction", {"textDocument": {"uri": uri}, "range": d["range"], "context": {"diagnostics": [d]}})]

# Each action removes the message for which it is, and adds none.
def sound(reasons, c, uri, text, found, action):
    edits = action["edit"]["changes"][uri]
    after = c.change(uri, {"text": edited(text, edits)})
    mark = lambda d: (d["code"], d["message"], d["range"]["start"]["line"])
    if len(after) > len(found) and found[0]["code"] != "unreadable": reasons.append(f"{action['title']!r} in {text!r} adds {after}")
    if [mark(d) for d in after] == [mark(d) for d in found]: reasons.append(f"{action['title']!r} in {text!r} changes nothing")
    if action["diagnostics"][0] not in found: reasons.append(f"{action['title']!r} in {text!r} is for {action['diagnostics']}")

def actions():
    reasons, c, uri = [], Client(), "file:///tmp/a.vs"
    for text, want, title in MENDED:
        found, all_ = actions_of(c, uri, text)
        picked = [a for a in all_ if (a["title"] == title if title else not a["title"].startswith("Allow"))]
        got = edited(text, picked[0]["edit"]["changes"][uri]) if picked else None
        expect(reasons, repr(text), got, want)
        for a in all_: sound(reasons, c, uri, text, found, a)
    c.open(uri, MENDED[0][0])
    far = {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 2}}
    expect(reasons, "beside the message", c.ask("textDocument/codeAction", {"textDocument": {"uri": uri}, "range": far, "context": {"diagnostics": []}}), [])
    slips, offered = [], 0
    for path in sorted(pathlib.Path("tests/slips").glob("*.txt")):
        if path.name != "open.txt": slips += re.findall(r"^## .*\n((?:(?!@|=> |## ).*\n)+)=> ", path.read_text(), re.M)
    if not os.environ.get("LONG"): slips = slips[::12]
    for text in slips:
        found, all_ = actions_of(c, uri, text)
        offered += any(not a["title"].startswith("Allow") for a in all_)
        for a in all_: sound(reasons, c, uri, text, found, a)
    if offered < len(slips) // 12: reasons.append(f"only {offered} of {len(slips)} slips have an action")
    if os.environ.get("TELL"): print(f"# {offered} of {len(slips)} slips have an action")
    expect(reasons, "end", c.end(), (0, (b"", b"")))
    return reasons

# The words of a text with their meanings and marks; they are in order and do not overlap.
def meanings(reasons, c, uri, text):
    c.open(uri, text)
    data = c.ask("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}})["data"]
    legend = c.capabilities["semanticTokensProvider"]["legend"]
    line, unit, end, out = 0, 0, 0, []
    for i in range(0, len(data), 5):
        lines, units, length, kind, marks = data[i:i + 5]
        line, unit = line + lines, units + (unit if not lines else 0)
        a, b = spanned(text, {"start": {"line": line, "character": unit}, "end": {"line": line, "character": unit + length}})
        if a < end or b <= a or "\n" in text[a:b] or "\r" in text[a:b]: reasons.append(f"{uri}:{line + 1}: {text[a:b]!r} at {a}, after {end}")
        end = b
        out.append((text[a:b], legend["tokenTypes"][kind], {m for n, m in enumerate(legend["tokenModifiers"]) if marks >> n & 1}))
    return out

def colours():
    reasons, c, uri = [], Client(), "file:///tmp/c.vs"
    words_ = meanings(reasons, c, uri, TEXT + '(set! height 4) (display \'größe #:k "a\n\nb" #t)\n#| two\r\n lines |#')
    first = {}
    for text, kind, marks in words_: first.setdefault(text, (kind, marks))
    for text, kind, *marks in (("; A row of towers.", "comment"), ("define", "keyword"), ("height", "variable", "declaration"),
                               ("3", "number"), ("; 😀 in metres", "comment"), ("tower", "function", "declaration"), ("n", "parameter", "declaration"),
                               ("positive?", "function", "defaultLibrary"), ("größe", "variable", "declaration"), ('"😀"', "string"), ("origin", "variable", "defaultLibrary"),
                               ("make-box", "function", "defaultLibrary"), ("#:k", "property"), ('"a', "string"), ('b"', "string"), ("#| two", "comment"), (" lines |#", "comment")):
        expect(reasons, text, first.get(text), (kind, set(marks)))
    expect(reasons, "an assignment", ("height", "variable", {"modification"}) in words_, True)
    expect(reasons, "a quoted name", ("größe", "enumMember", set()) in words_, True)
    c.open(uri, "(f")
    expect(reasons, "an open bracket", "error" in c.ask("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}}, True), True)
    paths = sorted(p for p in pathlib.Path(".").glob("examples/**/*") if p.suffix in (".vs", ".js"))
    for path in paths if os.environ.get("LONG") else paths[::6]:
        text = path.read_bytes().decode()
        try: found = meanings(reasons, c, path.resolve().as_uri(), text)
        except KeyError: reasons.append(f"{path} has no colours")
        else:
            if not any(k == "function" for _, k, _ in found): reasons.append(f"{path} lacks words: {found[:20]}")
    expect(reasons, "end", c.end(), (0, (b"", b"")))
    return reasons

# The lens starts one live view of a file, whose address the editor shows; the view ends with the server.
def lens():
    reasons, model = [], work / "ä model.vs"
    text = "(define r 1)\n; 😀\n  (draw (make-sphere origin r))\n"
    model.write_text(text)
    for shows in (True, False):
        browser = work / "browser"
        browser.write_text(f'#!/bin/sh\necho "$1" >> "{work}/address"\n')
        browser.chmod(0o755)
        c = Client(shows=shows, environment={**os.environ, "BROWSER": str(browser)})
        uri = model.as_uri()
        c.open(uri, text)
        lens, = c.ask("textDocument/codeLens", {"textDocument": {"uri": uri}})
        expect(reasons, "place of the lens", (words(text, lens["range"]), lens["range"]["start"]["line"]), ("draw", 2))
        call = {"command": lens["command"]["command"], "arguments": lens["command"]["arguments"]}
        address = c.ask("workspace/executeCommand", call)
        page = urllib.request.urlopen(address.split("#")[0], timeout=20).read()
        expect(reasons, "the page", b"<html" in page.lower(), True)
        if shows: expect(reasons, "shown", c.receive()["params"], {"external": True, "uri": address})
        expect(reasons, "a second time", c.ask("workspace/executeCommand", call), address)
        if shows: expect(reasons, "shown again", c.receive()["params"], {"external": True, "uri": address})
        m = c.ask("workspace/executeCommand", {**call, "arguments": ["untitled:x"]}, True)
        expect(reasons, "a text without a file", "error" in m, True)
        expect(reasons, "end", c.end(), (0, (b"", b"")))
        try: urllib.request.urlopen(address.split("#")[0], timeout=5); reasons.append("the view goes on after the server's end")
        except OSError: pass
    for _ in range(100):
        if (work / "address").exists(): break
        time.sleep(0.05)
    expect(reasons, "the browser's address", (work / "address").read_text().split(), [address])
    c = Client()
    c.open("file:///l.vs", "(define (f) 1)\n")
    expect(reasons, "a library has no lens", c.ask("textDocument/codeLens", {"textDocument": {"uri": "file:///l.vs"}}), [])
    c.end()
    return reasons

# What a text runs into when it is saved: errors, warnings, forms that did not run, times of lines. Each program with the
# messages that the run adds: line, severity, and a part of the text.
RUNS = [
    ("(define l (map (lambda (i) (* i i)) (iota 2)))\n(draw (make-box origin 1 (apply list-ref (list l 5)) 1))\n", [(1, 1, "list-ref")]),
    ("(draw (make-box origin 1 1 1))\n(error \"größe\" 7)\n", [(1, 1, "größe 7")]),
    ("(load \"sub/two.vs\")\n(draw (two 0))\n", [(1, 1, "two.vs:2:3")]),
    ("(define (g i)\n  (/ 1 i))\n(draw (make-box origin 1 (g 0) 1))\n", [(1, 1, "division by zero")]),
    ("(draw (make-box origin 1 1 1))\n(display \"forged:1:1:\\nno message: 1:1: x\")\n", []),
    ("(define (f i)\n  (if (> i 3)\n      (make-sphere\n        (xyz i 0 0) 1)\n      (make-box origin 1 1 1)))\n(draw (f 1))\n", [(2, 4, "did not reach")]),
    ("(define (f i)\n  (if (> i 3) (make-box origin 1 1 1) 5))\n", []),
    ("(let loop () (loop))\n(draw (make-box origin 1 1 1))\n", None),
    ("(define (f", []),
]

# Without Landlock the server runs nothing.
def confines():
    (work / "probe.vs").write_text("(display 1)")
    return "Landlock" not in subprocess.run([vs, "-q", "--untrusted", work / "probe.vs"], capture_output=True, text=True).stderr

def runs():
    if not confines(): return None
    reasons, folder = [], work / "läufe"
    (folder / "sub").mkdir(parents=True)
    (folder / "sub/two.vs").write_text("(define (two i)\n  (/ 1 i))\n")
    tags = {"textDocument": {"publishDiagnostics": {"tagSupport": {"valueSet": [1, 2]}}}, "workspace": {"inlayHint": {"refreshSupport": True}}}
    for fades, root in ((True, None), (False, work.as_uri())):
        c = Client(capabilities=tags if fades else {}, root=root)
        uri = (folder / "a.vs").as_uri()
        for text, want in RUNS:
            before = c.open(uri, text)
            if want is None: # it ends by its limit of time, while the server answers
                (folder / "a.vs").write_text(text)
                c.tell("textDocument/didSave", {"textDocument": {"uri": uri}})
                begun = time.monotonic()
                c.at("hover", uri, text, "(lo^op")
                if time.monotonic() - begun > 2 * patience(): reasons.append("a run holds up the server")
                c.tell("textDocument/didChange", {"textDocument": {"uri": uri, "version": 2}, "contentChanges": [{"text": "1"}]}); c.diagnostics()
                continue
            if text == "(define (f": # it cannot be read, and does not run
                (folder / "a.vs").write_text(text)
                c.tell("textDocument/didSave", {"textDocument": {"uri": uri}})
                c.at("hover", uri, text, "(def^ine")
                continue
            found = [d for d in c.save(uri, text) if d not in before]
            if fades: expect(reasons, "the editor asks again", c.receive()["method"], "workspace/inlayHint/refresh")
            want = [w for w in want if fades or w[1] != 4]
            got = [(d["range"]["start"]["line"], d["severity"]) for d in found]
            expect(reasons, f"run of {text!r}", got, [w[:2] for w in want])
            for w, d in zip(want, found):
                if w[2] not in d["message"]: reasons.append(f"{text!r}: {d}")
                if (w[1] == 4) != (d.get("tags") == [1]): reasons.append(f"{text!r} has the tags {d}")
                if w[1] == 4: expect(reasons, "the form", words(text, d["range"]), "(make-sphere\n        (xyz i 0 0) 1)")
            if found: expect(reasons, "after a change", c.change(uri, {"range": {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}}, "text": "\n"}) == before or [d["message"] for d in c.found[uri]] == [d["message"] for d in before], True)
        # Nothing outside of the project is read, and nothing is written.
        (work / "outside.txt").write_text("secret")
        text = f'(display 1)\n(define (try f) (guard (e (#t (error-object-message e))) (f)))\n(draw (make-box origin 1 1 1))\n(define a (try (lambda () (call-with-output-file "{work}/written" (lambda (p) (display 1 p))))))\n(define b (try (lambda () (file->string "{work}/outside.txt"))))\n(error "seen" b)\n'
        c.open(uri, text)
        found = [d["message"] for d in c.save(uri, text) if d["code"] == "run" and d["severity"] == 1]
        if fades: c.receive()
        if (work / "written").exists(): reasons.append("a run has written a file")
        if len(found) != 1 or ("secret" in found[0]) == fades: reasons.append(f"a run reads {found}")
        text = "(define (spin n) (let loop ([i 0]) (if (< i n) (loop (+ i 1)))))\n(spin 30000000)\n(spin 10000000)\n(draw (make-box origin 1 1 1))\n"
        c.open(uri, text)
        c.save(uri, text)
        if fades: c.receive()
        hints = c.ask("textDocument/inlayHint", {"textDocument": {"uri": uri}, "range": {"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}}})
        expect(reasons, "hints", [(h["position"], h["label"]) for h in hints], [({"line": 0, "character": len(text.split("\n")[0])}, "100 %")])
        expect(reasons, "hints of other lines", c.ask("textDocument/inlayHint", {"textDocument": {"uri": uri}, "range": {"start": {"line": 1, "character": 0}, "end": {"line": 9, "character": 0}}}), [])
        expect(reasons, "end", c.end(), (0, (b"", b"")))
    c = Client(options={"run": False})
    uri = (folder / "a.vs").as_uri()
    c.open(uri, RUNS[0][0])
    (folder / "a.vs").write_text(RUNS[0][0])
    c.tell("textDocument/didSave", {"textDocument": {"uri": uri}})
    time.sleep(0.5)
    c.at("hover", uri, RUNS[0][0], "list-r^ef")
    expect(reasons, "without runs", [d["code"] for d in c.found[uri] if d["code"] == "run"], [])
    c.end()
    # A library of a package is found in a run, too.
    home = work / "run-package"
    (home / "shelf/towers").mkdir(parents=True)
    (home / "shelf/towers/spire.sld").write_text("(define-library (towers spire)\n  (export spire)\n  (import (visualscheme))\n  (begin (define (spire n) (car n))))\n")
    done = subprocess.run([vs, "add", "shelf/towers"], cwd=home, capture_output=True)
    if done.returncode: reasons.append(str(done))
    c, uri, text = Client(), (home / "m.vs").as_uri(), "(import (visualscheme) (towers spire))\n(draw (spire 3))\n"
    expect(reasons, "before the run", c.open(uri, text), [])
    expect(reasons, "run of a library", [("spire.sld:4" in d["message"], d["range"]["start"]) for d in c.save(uri, text)], [(True, {"line": 1, "character": 6})])
    c.end()
    return reasons

# Value and picture of a definition, for editors that show pictures, while the text is that of its file.
def pictures():
    if not confines(): return None
    reasons, uri = [], (work / "ä pictures.vs").as_uri()
    text = "; 😀 The tower.\n(define tower (make-box origin 1 2 3))\n(define towers (list tower (make-sphere origin 1)))\n(define n 7)\n(define (f x) x)\n(define w (make-line origin (xyz 1 2 3)))\n(define endless (delay 1))\n(display tower)\n(draw towers)\n"
    (work / "ä pictures.vs").write_text(text)
    c, plain = Client(options={"pictures": True}), Client()
    for client in (c, plain): client.open(uri, text)
    for name, value, picture in (("tower", "(make-box", True), ("towers", "((make-box", True), ("n", "7", False), ("w", "(make-line", True), ("f", None, False), ("endless", "promise", False)):
        place = f"(define {name[:1]}^{name[1:]} " if name != "f" else "(define (f^ x"
        told = c.at("hover", uri, text, place)
        expect(reasons, f"range of {name}", words(text, told["range"]), name)
        told, old = told["contents"]["value"], plain.at("hover", uri, text, place)["contents"]["value"]
        if not told.startswith(old): reasons.append(f"{name} is told as {told!r}, otherwise {old!r}")
        if "data:image" in old: reasons.append("an editor without pictures gets one")
        shown = re.search(r"!\[picture\]\(data:image/svg\+xml;base64,([^)]*)\)", told)
        if (shown is not None) != picture: reasons.append(f"{name} has the picture {told[:500]}")
        if shown:
            root = tree.fromstring(base64.b64decode(shown[1], validate=True))
            inked = [e for e in root.iter() if e.tag.endswith("path")]
            if root.get("width") != "320" or not inked: reasons.append(f"{name}: {tree.tostring(root)[:300]}")
        if (value is None) != ("```scheme\n" not in told[len(old):]) or (value and value not in told): reasons.append(f"{name} has the value {told[len(old):][:300]}")
    c.change(uri, {"text": text.replace("1 2 3", "9 9 9")})
    expect(reasons, "a text that is not saved", c.at("hover", uri, text, "(define to^wer ")["contents"]["value"], plain.at("hover", uri, text, "(define to^wer ")["contents"]["value"])
    endless = "(define a 1)\n(let loop () (loop))\n"
    c.open(uri, endless)
    (work / "ä pictures.vs").write_text(endless)
    c.tell("textDocument/didSave", {"textDocument": {"uri": uri}})
    begun = time.monotonic()
    told = c.at("hover", uri, endless, "(define ^a")["contents"]["value"]
    if "7" in told or time.monotonic() - begun > 10 * patience(): reasons.append(f"an endless text: {told}")
    plain.end()
    expect(reasons, "end", c.end(), (0, (b"", b"")))
    return reasons

# Processor time of the server for a text of 500 lines, in seconds.
def speed():
    reasons, c, uri = [], Client(), "file:///tower.vs"
    storey = """(define (storey-{0} width height [turn any? 0])
  (let* ([foot (make-box origin width width height)]
         [band (make-box (xyz 0 0 height) width width (* 0.1 height))])
    (do-rotate (unite foot band) 'z turn)))
(draw (do-move (storey-{0} 4 3) (vxyz 0 0 (* 3 {0}))))
"""
    c.open(uri, "".join(storey.format(i) for i in range(100)))
    place = {"line": 1, "character": 25}
    def spent(act):
        used = lambda: sum(map(int, pathlib.Path(f"/proc/{c.process.pid}/stat").read_text().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")
        before = used()
        for _ in range(10): act()
        return (used() - before) / 10
    slow = 10 if os.environ.get("SLOW") else 1  # a build with sanitizers
    large = "file:///large.vs"
    found = c.open(large, "".join(f"(define (f{i} a)\n  (if (> a {i})\n      (make-box origin (+ a 1) (* a 2) 1)\n      (make-sphere (xyz a a {i}) 1)))\n" for i in range(1000)) + "(draw (make-box origin 1 1 1))\n")
    expect(reasons, "findings of a large text", len(found), 1000)
    for name, most, act in (("1000 diagnostics in 4000 lines", 0.5, lambda: c.change(large, {"range": {"start": place, "end": place}, "text": " "})), ("diagnostics", 0.2, lambda: c.change(uri, {"range": {"start": place, "end": place}, "text": " "})),
                            ("completion", 0.05, lambda: c.ask("textDocument/completion", {"textDocument": {"uri": uri}, "position": {"line": 1, "character": 23 + 7}})),
                            ("completion of all names", 0.05, lambda: c.ask("textDocument/completion", {"textDocument": {"uri": uri}, "position": {"line": 1, "character": 16}})),
                            ("colours", 0.1, lambda: c.ask("textDocument/semanticTokens/full", {"textDocument": {"uri": uri}}))):
        time_ = spent(act)
        if time_ > most * slow: reasons.append(f"{name} takes {1000 * time_:.0f} ms of processor time, more than {1000 * most:.0f}")
        if os.environ.get("TELL"): print(f"# {name}: {1000 * time_:.0f} ms")
    c.end()
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

# Bytes that no editor sends: headers, lengths, encodings, depths, numbers. The server answers or ends, and never hangs or crashes.
def hostile():
    reasons = []
    def framed(body, head=b"Content-Length: %d\r\n\r\n"): return head % len(body) + body
    first, ask = framed(b'{"jsonrpc":"2.0","id":1,"method":"initialize"}'), framed(b'{"jsonrpc":"2.0","id":2,"method":"no/method"}')
    last = framed(b'{"jsonrpc":"2.0","id":3,"method":"shutdown"}') + framed(b'{"jsonrpc":"2.0","method":"exit"}')
    def open_(text): return framed(b'{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{"textDocument":{"uri":"file:///a.vs","text":' + text + b'}}}')
    cancel = framed(b'{"jsonrpc":"2.0","method":"$/cancelRequest","params":{"id":2}}')
    went_on = {"no JSON": framed(b"\x00\x01"), "bad UTF-8": framed(b'{"jsonrpc":"2.0","id":9,"method":"\xff\xfe"}'), "deep JSON": framed(b"[" * 100000), "deep objects": framed(b'{"a":' * 100000 + b"1" + b"}" * 100000),
        "an empty body": framed(b""), "a number out of range": framed(b'{"id":1e999,"method":"x"}'), "a long whole number": framed(b'{"id":%s,"method":"x"}' % (b"9" * 400)), "no method": framed(b'{"id":{}}'), "an odd method": framed(b'{"id":7,"method":["x"]}'), "NUL": open_(b'"a\\u0000b"'), "half a surrogate": open_(b'"\\ud800"'),
        "deep text": open_(b'"' + b"(" * 200000 + b'"'), "deep quotes": open_(b'"' + b"'" * 200000 + b'"'), "a long word": open_(b'"' + b"x" * 1000000 + b'"'), "a cancelled request": cancel + cancel, "a text twice": open_(b'"1"') + open_(b'"2"'),
        "another header": framed(b'{"jsonrpc":"2.0","method":"x"}', b"Content-Type: application/vscode-jsonrpc; charset=utf-8\r\nContent-Length: %d\r\n\r\n"), "a header in small letters": framed(b'{"jsonrpc":"2.0","method":"x"}', b"content-length: %d\r\n\r\n"), "a long header": framed(b'{"jsonrpc":"2.0","method":"x"}', b"X: " + b"y" * 5000 + b"\r\nContent-Length: %d\r\n\r\n")}
    for what, text in went_on.items():
        done = subprocess.run([vs, "lsp"], input=first + text + ask + last, capture_output=True, timeout=120)
        if done.returncode or done.stderr or b'"id":2,"error"' not in done.stdout or b'"id":3,"result"' not in done.stdout: reasons.append(f"{what}: {done.returncode} {done.stdout[-300:]} {done.stderr[-300:]}")
    for what, text in {"a huge length": b"Content-Length: 99999999999\r\n\r\n{}", "a length below 0": b"Content-Length: -5\r\n\r\n{}", "a length that is no number": b"Content-Length: x\r\n\r\n{}", "no length": b"\r\n\r\n{}", "no header": b"{" * 5000, "zeros": b"\0" * 5000}.items():
        done = subprocess.run([vs, "lsp"], input=first + text, capture_output=True, timeout=60)
        if done.returncode not in (0, 2) or (done.returncode == 2) != bool(done.stderr): reasons.append(f"{what}: {done.returncode} {done.stderr[-300:]}")
    # A file that the text loads is in another encoding: the answers are UTF-8.
    (work / "old.vs").write_bytes(b"; a wall of M\xfcller\n(define (wall w\xe4nde) w\xe4nde)\n")
    c, uri, text = Client(), f"file://{work}/new.vs", '(load "old.vs")\n(draw (wall 1))\n'
    c.open(uri, text)
    for method in ("hover", "definition", "references", "completion", "signatureHelp"): c.at(method, uri, text, "(wa^ll 1")
    c.end()
    # A client that ends without a word ends the server.
    for close in (("stdin",), ("stdout",), ("stdout", "stdin")):
        c = Client()
        for name in close: getattr(c.process, name).close()
        if close == ("stdout",):
            try: c.tell("textDocument/didOpen", {"textDocument": {"uri": uri, "text": text}}); c.tell("textDocument/didOpen", {"textDocument": {"uri": uri, "text": text}})
            except BrokenPipeError: pass
        try: c.process.wait(timeout=30)
        except subprocess.TimeoutExpired: reasons.append(f"the server goes on without its client's {close}"); c.process.kill()
    return reasons

# Names of a package's library, and names of the program while a form is typed. The server runs in another folder.
def libraries():
    reasons, home = [], work / "häuser"
    (home / "shelf/towers").mkdir(parents=True)
    (home / "shelf/towers/spire.sld").write_text("; A library.\n(define-library (towers spire)\n  (export spire height)\n  (import (visualscheme))\n  (begin\n    (define height 3)\n    ; A spire of größe n.\n    ; It stands.\n    (define (spire n)\n      (make-box origin 1 1 (* n height)))))\n")
    done = subprocess.run([vs, "add", "shelf/towers"], cwd=home, capture_output=True)
    if done.returncode: reasons.append(str(done))
    text = "(import (visualscheme) (towers spire))\n(define spices 1)\n(draw (spire spices))\n(display height)\n"
    uri, c = (home / "model.vs").as_uri(), Client()
    expect(reasons, "messages", c.open(uri, text), [])
    hover = c.at("hover", uri, text, "(sp^ire")["contents"]["value"]
    for part in ("(spire n)", "A spire of größe n.\nIt stands."):
        if part not in hover: reasons.append(f"hover lacks {part!r}: {hover!r}")
    expect(reasons, "a comment that is another's", "library" in hover, False)
    place = c.at("definition", uri, text, "(sp^ire")
    expect(reasons, "definition", place and (place["uri"], words((home / ".vs/towers/spire.sld").read_text(), place["range"]), place["range"]["start"]["line"]), ((home / ".vs/towers/spire.sld").resolve().as_uri(), "spire", 8))
    labels = lambda place, text: sorted(i["label"] for i in c.at("completion", uri, text, place))
    expect(reasons, "completion", [n for n in labels("(spi^re", text) if n.startswith("spi")], ["spices", "spire"])
    typed = text + "(draw (spi"
    c.change(uri, {"text": typed})
    expect(reasons, "completion while a form is typed", [i["label"] for i in c.ask("textDocument/completion", {"textDocument": {"uri": uri}, "position": position(typed, len(typed))}) if i["label"].startswith("spi")], ["spices", "spire"])
    typed += "re "
    c.change(uri, {"text": typed})
    help_ = c.ask("textDocument/signatureHelp", {"textDocument": {"uri": uri}, "position": position(typed, len(typed))})
    expect(reasons, "signature while a form is typed", [s["label"] for s in help_["signatures"]], ["(spire n)"])
    (home / ".vs/towers/spire.sld").unlink()
    c.tell("textDocument/didClose", {"textDocument": {"uri": uri}}); c.diagnostics()
    if not c.open(uri, text): reasons.append("a package that has changed is used")
    expect(reasons, "end", c.end(), (0, (b"", b"")))
    return reasons

# A project: a library, programs that import it in every way, files that load others, and a program with a name of its own.
PROJECT = {
    "towers/spire.sld": "; A library.\n(define-library (towers spire)\n  (export spire (rename storey floor) größe)\n  (import (visualscheme))\n  (begin\n    (define größe 3)\n    ; A spire.\n    (define (spire n) (make-box origin 1 1 (* n größe)))\n    (define (storey n) (volume (spire n)))))\n",
    "main.vs": "; 😀\n(import (visualscheme) (towers spire))\n(display (volume (spire größe)))\n(display (floor 2))\n",
    "only.vs": "(import (visualscheme)\n        (only (towers spire) spire größe))\n(define (top spire2) spire2)\n(display (list 'spire (top (volume (spire größe)))))\n",
    "sub/renamed.vs": "(import (visualscheme) (rename (towers spire) (spire tip) (floor flat)))\n(display (volume (tip größe)))\n",
    "own.vs": "(define (spire n) (* 2 n))\n(define größe 7)\n(display (spire größe))\n",
    "parts.vs": "(define (part n)\n  (* n 2))\n(define (whole n) (part n))\n",
    "uses.vs": "(define (uses n) (+ 1 (part n)))\n",
    "loads.vs": '(load "parts.vs")\n(load "uses.vs")\n(display (list (part 1) (uses 2) (whole 3)))\n',
}

# The places of a name in the project, as spelled words of files: asked at any of them, the answer is the same.
PLACES = {
    "spire": {"towers/spire.sld": 3, "main.vs": 1, "only.vs": 2, "sub/renamed.vs": 2},
    "größe": {"towers/spire.sld": 3, "main.vs": 1, "only.vs": 2, "sub/renamed.vs": 1},
    "part": {"parts.vs": 2, "uses.vs": 1, "loads.vs": 1},
    "storey": {"towers/spire.sld": 2, "main.vs": 1},
}

def project():
    reasons, home = [], work / "projekt"
    def write():
        for name, text in PROJECT.items(): (home / name).parent.mkdir(parents=True, exist_ok=True); (home / name).write_text(text)
    def said(): return {name: (lambda d: (d.returncode, d.stdout, d.stderr))(subprocess.run([vs, "-q", "-L", home, name], cwd=home, capture_output=True, text=True)) for name in PROJECT if name.endswith(".vs") and name != "uses.vs"}
    def client(): return Client(root=home.as_uri(), options={"run": False}, words=("-L", home))
    write()
    before = said()
    for name, (code, out, err) in before.items():
        if code: reasons.append(f"{name}: {err}")
    c = client()
    for name, text in PROJECT.items(): c.open((home / name).as_uri(), text)
    outline = c.ask("textDocument/documentSymbol", {"textDocument": {"uri": (home / "towers/spire.sld").as_uri()}})
    expect(reasons, "outline of a library", [o["name"] for o in outline], ["größe", "spire", "storey"])
    for word, where in PLACES.items():
        seen = None
        for name, text in PROJECT.items():
            if name not in where or name == "uses.vs" or (word == "storey" and name != "towers/spire.sld") or (name == "sub/renamed.vs" and word == "spire"): continue
            for m in re.finditer(rf"(?<![\w-]){word}(?![\w-])", text):
                line = text[:m.start()].split("\n")[-1]
                if "'" + word in text[m.start() - 1:m.end()] or "only (towers" in line or ";" in line or line.endswith("(towers ") or line.endswith("-library (towers "): continue
                places = c.ask("textDocument/references", {"textDocument": {"uri": (home / name).as_uri()}, "position": position(text, m.start() + 1), "context": {"includeDeclaration": True}})
                got, found = sorted((p["uri"], p["range"]["start"]["line"], p["range"]["start"]["character"]) for p in places), {}
                for p in places:
                    file = urllib.parse.unquote(p["uri"]).removeprefix(f"file://{home}/")
                    found[file] = found.get(file, 0) + 1
                    if words(PROJECT[file], p["range"]) not in (word, "tip", "floor"): reasons.append(f"{word}: {file} has {words(PROJECT[file], p['range'])}")
                if found != where: reasons.append(f"{word} at {name}:{text[:m.start()].count(chr(10)) + 1}: {found}, not {where}")
                if seen not in (None, got): reasons.append(f"{word} has other places at {name}")
                seen = got
    c.end()
    # After a rename all programs print the same, whichever place it began at; the old name is gone from the files that had it.
    for word, name, place in (("spire", "main.vs", "(sp^ire"), ("spire", "towers/spire.sld", "(define (sp^ire"), ("spire", "only.vs", "(volume (sp^ire"), ("größe", "towers/spire.sld", "(define grö^ße"), ("größe", "sub/renamed.vs", "(tip grö^ße"),
                              ("part", "parts.vs", "(define (pa^rt"), ("part", "loads.vs", "(list (pa^rt"), ("storey", "towers/spire.sld", "(define (sto^rey")):
        write()
        c = client()
        text = PROJECT[name]
        c.open((home / name).as_uri(), text)
        m = c.ask("textDocument/rename", {"textDocument": {"uri": (home / name).as_uri()}, "position": position(text, text.index(place.replace("^", "")) + place.index("^")), "newName": "turm-😀"}, True)
        if "error" in m: reasons.append(f"{word} at {name}: {m['error']}"); c.end(); continue
        for uri, edits in m["result"]["changes"].items():
            file = home / urllib.parse.unquote(uri).removeprefix(f"file://{home}/")
            file.write_text(edited(file.read_text(), sorted(edits, key=lambda e: (e["range"]["start"]["line"], e["range"]["start"]["character"]))))
            expect(reasons, f"{file} is unchanged", file.name == "own.vs", False)
        if said() != before: reasons.append(f"{word} at {name}: {said()}, not {before}")
        if not any("turm-😀" in (home / n).read_text() for n in PROJECT): reasons.append(f"{word} at {name}: no file has the new name")
        expect(reasons, "end", c.end()[0], 0)
    # Renames that are refused, with the file.
    write()
    (home / "prefix.vs").write_text("(import (visualscheme) (prefix (towers spire) t-))\n(display (volume (t-spire 1)))\n")
    c, main_ = client(), (home / "main.vs").as_uri()
    c.open(main_, PROJECT["main.vs"])
    for new, part in (("größe", "already"), ("make-box", "already"), ("top", "already"), ("turm", "prefix"), ("3", "no name"), ("a b", "no name")):
        m = c.ask("textDocument/rename", {"textDocument": {"uri": main_}, "position": position(PROJECT["main.vs"], PROJECT["main.vs"].index("(spire") + 2), "newName": new}, True)
        if part not in m.get("error", {}).get("message", ""): reasons.append(f"spire to {new}: {m}")
    (home / "prefix.vs").unlink()
    c.open((home / "only.vs").as_uri(), PROJECT["only.vs"])
    c.change((home / "only.vs").as_uri(), {"text": PROJECT["only.vs"] + "\n"})
    m = c.ask("textDocument/rename", {"textDocument": {"uri": main_}, "position": position(PROJECT["main.vs"], PROJECT["main.vs"].index("(spire") + 2), "newName": "turm"}, True)
    if "only.vs is not saved" not in m.get("error", {}).get("message", ""): reasons.append(f"a text that is not saved: {m}")
    expect(reasons, "end", c.end()[0], 0)
    return reasons

for test in (answers, findings, actions, colours, lens, runs, pictures, speed, edits, libraries, project, wrong, hostile):
    if only and only not in "lsp/" + test.__name__: continue
    try: result("lsp/" + test.__name__, test())
    except Exception as e: result("lsp/" + test.__name__, [repr(e)])
