# A client of `vs mcp`: mcp.py VS FOLDER ONLY. Prints `ok NAME`, or `not ok NAME` and its reasons.
import base64, json, os, pathlib, re, shutil, signal, struct, subprocess, sys, time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from patience import patience

vs, work, only = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
here, root = pathlib.Path(__file__).parent.resolve(), pathlib.Path.cwd()
temporary = work / "temporary"
temporary.mkdir()

class Client:
    def __init__(self, folder, *options):
        folder.mkdir(exist_ok=True)
        self.process = subprocess.Popen([vs, "mcp", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, cwd=folder, env={**os.environ, "TMPDIR": str(temporary)})
        self.number = 0
        self.info = self.ask("initialize", {"protocolVersion": "2025-03-26", "capabilities": {}, "clientInfo": {"name": "test", "version": "1"}})["result"]
        self.send({"jsonrpc": "2.0", "method": "notifications/initialized"})

    def send(self, message):
        self.process.stdin.write((message if isinstance(message, bytes) else json.dumps(message).encode()) + b"\n")
        self.process.stdin.flush()

    def receive(self): return json.loads(self.process.stdout.readline().decode())

    def ask(self, method, parameters):
        self.number += 1
        self.send({"jsonrpc": "2.0", "id": self.number, "method": method, "params": parameters})
        answer = self.receive()
        assert answer["jsonrpc"] == "2.0" and answer["id"] == self.number, answer
        return answer

    # The text of the answer, whether it is an error, and its pictures.
    def call(self, tool, **arguments):
        answer = self.ask("tools/call", {"name": tool, "arguments": arguments})["result"]
        text = "".join(c["text"] for c in answer["content"] if c["type"] == "text")
        return text, answer["isError"], [base64.b64decode(c["data"], validate=True) for c in answer["content"] if c["type"] == "image"]

    def end(self):
        out, err = self.process.communicate(timeout=60)
        return self.process.returncode, out, err

def result(name, reasons):
    print(f"not ok {name}" if reasons else f"ok {name}")
    for reason in reasons[:8]: print("    " + str(reason)[:900])

def expect(reasons, what, is_, want):
    if is_ != want: reasons.append(f"{what}: {is_!r}, not {want!r}")

def has(reasons, what, text, *wanted):
    for want in wanted:
        if not re.search(want, text): reasons.append(f"{what} lacks {want!r}: {text!r}")

def lacks(reasons, what, text, *unwanted):
    for word in unwanted:
        if word in text: reasons.append(f"{what} has {word!r}: {text!r}")

painter = shutil.which("povray")

def size_of(picture):
    return struct.unpack(">II", picture[16:24]) if picture[:8] == b"\x89PNG\r\n\x1a\n" and picture[-8:-4] == b"IEND" else None

# The recorded session.
def house():
    reasons, folder = [], work / "house"
    c = Client(folder)
    for row in re.split(r"^## ", (here / "house.txt").read_text(), flags=re.M)[1:]:
        lines = row.rstrip("\n").split("\n")
        tool, arguments = lines[0].split(" ", 1)
        arguments = json.loads(arguments)
        program = [line for line in lines[1:] if not line.startswith("=> ")]
        if program: arguments["program"] = "\n".join(program) + "\n"
        text, fault, pictures = c.call(tool, **arguments)
        at = 0
        wants = [line[3:] for line in lines[1:] if line.startswith("=> ")]
        if not painter and any(w.startswith("image") for w in wants): continue
        expect(reasons, f"{lines[0]}: an error in {text!r}", fault, "fault" in wants)
        expect(reasons, f"{lines[0]}: pictures", [size_of(p) for p in pictures], [tuple(map(int, w.split()[1:])) for w in wants if w.startswith("image ")])
        for want in wants:
            if want == "fault" or want.startswith("image "): continue
            found = re.compile(want).search(text, at)
            if not found: reasons.append(f"{lines[0]}: the answer lacks {want!r}: {text}")
            else: at = found.end()
    expect(reasons, "the export", ((folder / "house.stl").stat().st_size - 84) % 50, 0)
    expect(reasons, "end", c.end(), (0, b"", b""))
    expect(reasons, "files that are left", list(temporary.iterdir()), [])
    return reasons

# Each tool is listed with its arguments, and answers without any.
def tools():
    reasons, c = [], Client(work / "tools")
    table = (root / "cli/mcp/mcp_tools.def").read_text()
    listed = {t["name"]: t for t in c.ask("tools/list", {})["result"]["tools"]}
    expect(reasons, "the tools", sorted(listed), sorted(re.findall(r"^MCP_TOOL\((\w+),", table, re.M)))
    for name, tool in listed.items():
        if len(tool["description"]) < 40: reasons.append(f"{name}: {tool['description']!r}")
        for n, p in tool["inputSchema"]["properties"].items():
            if p.get("type") not in ("string", "number", "object") or len(p["description"]) < 20: reasons.append(f"{name} {n}: {p}")
        if not set(tool["inputSchema"]["required"]) <= set(tool["inputSchema"]["properties"]): reasons.append(f"{name} requires what it lacks")
        for arguments in ({}, {n: 5 for n in tool["inputSchema"]["properties"]}, {n: [{}] for n in tool["inputSchema"]["properties"]}):
            text, fault, _ = c.call(name, **arguments)
            if not fault or not text.strip(): reasons.append(f"{name} {arguments}: {text!r}")
    has(reasons, "instructions", c.info["instructions"], "radians", "help")
    expect(reasons, "version", c.info["protocolVersion"], "2025-03-26")
    expect(reasons, "an unknown version", c.ask("initialize", {"protocolVersion": "1999-01-01"})["result"]["protocolVersion"], "2025-06-18")
    text, fault, _ = c.call("run", program="(define-parameter n 2.0) (define-parameter name \"x\") (define-parameter deep #f) (write (list n name deep))",
                            parameters={"n": 2.5, "name": "a b", "deep": True})
    has(reasons, "parameters", text, r'\(2\.5 "a b" #t\)')
    text, fault, _ = c.call("run", parameters={"nn": 1})
    has(reasons, "an unknown parameter", text, "no parameter nn|nn")
    expect(reasons, "is an error", fault, True)
    text, fault, _ = c.call("measure", program="(define (volume o) 'mine) (define printf 5) (draw (make-box origin (xyz 1 2 3)))")
    has(reasons, "measures of a program that redefines names", text, "volume 6")
    text, fault, _ = c.call("measure", program="(make-circle origin 1) (make-region (make-circle origin 1))")
    has(reasons, "measures of returned objects", text, r"object 1: circle, line 1, length 6\.283185", r"object 2: region, line 1, area 3\.14")
    text, fault, _ = c.call("measure", program="(define x 1)")
    has(reasons, "measures of nothing", text, "nothing is drawn")
    text, fault, pictures = c.call("section", program="(draw (make-sphere origin 1))", at=5, size="64x48")
    has(reasons, "a plane beside", text, "cuts no solid", "-1 -1 -1")
    if painter:
        seen = {}
        for arguments in ({"view": "top"}, {"view": "front"}, {"view": "mine"}, {"camera": "5,5,5,0,0,0"}, {"camera": "-5,5,5,0,0,0", "size": "80x60"}):
            text, fault, pictures = c.call("picture", program='(view "mine" #:from (xyz 9 1 1) #:to origin) (draw (make-box origin (xyz 1 2 3)))', **{"size": "64x48", **arguments})
            if fault or len(pictures) != 1: reasons.append(f"picture {arguments}: {text}")
            else: seen[pictures[0]] = arguments
        expect(reasons, "different pictures", len(seen), 5)
        text, fault, pictures = c.call("picture", view="none")
        expect(reasons, "an unknown view", (fault, pictures), (True, []))
    (work / "tools" / "own.vs").write_text("(draw (make-box origin 1 2 3))\n")
    text, fault, _ = c.call("run", file="own.vs")
    has(reasons, "a file", text, r"own\.vs: 1 object, 1 x 2 x 3 m")
    text, fault, _ = c.call("export", path="own.vs")
    expect(reasons, "an export onto the program", (fault, (work / "tools" / "own.vs").read_text()), (True, "(draw (make-box origin 1 2 3))\n"))
    for path in ("../x.stl", "/tmp/x.stl", "a/../../x.stl", "", ".", "none/x.stl", "-", "x.none"):
        text, fault, _ = c.call("export", path=path)
        expect(reasons, f"export to {path!r}: {text!r}", fault, True)
    for file in ("../house/house.stl", "/etc/passwd", "none.vs", "./own.vs", "-"):
        text, fault, _ = c.call("run", file=file)
        expect(reasons, f"file {file!r}: {text!r}", fault, True)
    expect(reasons, "end", c.end(), (0, b"", b""))
    return reasons

# A program sees no file but those of its folder, and reaches its limits.
def confined():
    reasons, folder = [], work / "confined"
    folder.mkdir()
    (work / "secret.vs").write_text('(define secret "SECRET-7")')
    c = Client(folder, "--limit-time", "1", "--limit-memory", "60", "--limit-output", "1")
    for path in ("../secret.vs", str(work / "secret.vs"), "/etc/passwd", "/proc/self/environ"):
        for tool in ("run", "check", "measure"):
            for program in (f'(load "{path}") (display secret)', f'(display (file->string "{path}"))', f'(include "{path}")'):
                text, _, _ = c.call(tool, program=program)
                lacks(reasons, f"{tool} {program}", text, "SECRET", "root:", "PATH=")
    text, fault, _ = c.call("run", program='(call-with-output-file "made" (lambda (p) (write 1 p)))')
    expect(reasons, f"a program that writes: {text!r}", (fault, (folder / "made").exists()), (True, False))
    for program, want in (("(let loop () (loop))", "1 second"), ("(let loop ([l '()]) (loop (cons (make-vector 1000 0) l)))", "memory|megabytes"),
                          ("(let loop () (display (make-string 1000 #\\x)) (loop))", "output|printed|megabyte")):
        text, fault, _ = c.call("run", program=program)
        has(reasons, program, text[-600:], want, "reached a limit")
        expect(reasons, f"{program}: an error", fault, True)
    text, fault, _ = c.call("run", program="(display 1)")
    expect(reasons, f"after the limits: {text!r}", fault, False)
    expect(reasons, "end", c.end()[0], 0)
    expect(reasons, "files that are left", list(temporary.iterdir()), [])
    return reasons

# A client that cancels, asks several things at once, writes nonsense, goes away, or ends the server by a signal.
def wrong():
    reasons, c = [], Client(work / "wrong")
    begin = time.time()
    c.send({"jsonrpc": "2.0", "id": "long", "method": "tools/call", "params": {"name": "run", "arguments": {"program": "(let loop () (loop))"}}})
    c.send({"jsonrpc": "2.0", "id": 77, "method": "ping"})
    c.send({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": 3}})
    c.send({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": "long"}})
    m = c.receive()
    expect(reasons, "a cancelled call", (m["id"], m["result"]["isError"], m["result"]["content"][0]["text"]), ("long", True, "The request was cancelled.\n"))
    expect(reasons, "the request after it", c.receive(), {"jsonrpc": "2.0", "id": 77, "result": {}})
    if time.time() - begin > 8 * patience(): reasons.append("the cancelled call went on")
    for line, code in ((b"{no json", -32700), (b"5", -32600), (b"[]", -32600), (b'{"jsonrpc":"2.0","id":1}', -32600), (b'{"jsonrpc":"2.0","id":1,"method":"none"}', -32601),
                       (b'{"jsonrpc":"2.0","id":1,"method":"tools/call","params":{"name":"none"}}', -32602), (b'{"jsonrpc":"2.0","id":1,"method":"tools/call"}', -32602), (b"\xff\xfe", -32700)):
        c.send(line)
        expect(reasons, line, c.receive()["error"]["code"], code)
    for line in (b"", b"  \r", b'{"jsonrpc":"2.0","method":"none"}', b'{"jsonrpc":"2.0","id":9,"result":{}}', b'{"jsonrpc":"2.0","method":"notifications/cancelled","params":7}'): c.send(line)
    expect(reasons, "a ping", c.ask("ping", {})["result"], {})
    text, fault, _ = c.call("run", program='(display "ü😀\\n\\x1;")')
    has(reasons, "a text with every kind of character", text, "ü😀\n\x01")
    expect(reasons, "end", c.end()[0], 0)
    done = subprocess.run([vs, "mcp"], input=b'{"jsonrpc":"2.0","id":1,"method":"ping"}', capture_output=True, timeout=60)
    expect(reasons, "a last line without its end", json.loads(done.stdout), {"jsonrpc": "2.0", "id": 1, "result": {}})
    c = Client(work / "wrong")
    c.call("run", program="(display 1)")
    c.process.send_signal(signal.SIGTERM)
    expect(reasons, "a signal", c.process.wait(timeout=20), 130)
    c = Client(work / "wrong")
    c.send({"jsonrpc": "2.0", "id": 5, "method": "tools/call", "params": {"name": "run", "arguments": {"program": "(display 1)"}}})
    c.process.stdout.close()
    c.process.stdin.close()
    expect(reasons, "a client that is gone", c.process.wait(timeout=20) in (0, 2), True)
    expect(reasons, "files that are left", list(temporary.iterdir()), [])
    done = subprocess.run([vs, "mcp", "house.vs"], capture_output=True, timeout=60)
    expect(reasons, "a file on the command line", done.returncode, 2)
    return reasons

# Lines that no assistant sends, and a client that dies: the server answers or ends, and its command ends with it.
def hostile():
    reasons, c = [], Client(work / "hostile")
    lines = {"no JSON": b"\x00\x01", "bad UTF-8": b'{"jsonrpc":"2.0","id":9,"method":"\xff"}', "deep JSON": b"[" * 100000, "deep objects": b'{"a":' * 100000 + b"1" + b"}" * 100000, "a number out of range": b'{"id":1e999,"method":"ping"}', "a batch": b'[{"jsonrpc":"2.0","id":1,"method":"ping"}]',
        "an odd method": b'{"id":7,"method":["ping"]}', "a number": b"17", "NUL": b'{"jsonrpc":"2.0","id":9,"method":"tools/call","params":{"name":"run","arguments":{"program":"a\\u0000b"}}}', "a long word": b'{"jsonrpc":"2.0","id":9,"method":"' + b"x" * 1000000 + b'"}'}
    for what, line in lines.items():
        c.send(line)
        m = c.receive()
        if "error" not in m: reasons.append(f"{what}: {m}")
    expect(reasons, "afterwards", c.ask("ping", {})["result"], {})
    for what, arguments in {"deep": {"program": "(" * 200000}, "no program": {"program": 5}, "odd parameters": {"program": "1", "parameters": {"a": [1]}}, "a name with =": {"program": "1", "parameters": {"a=b": 1}}, "no name": {"program": "1", "parameters": {"": 1}}, "many": {"program": "1", "parameters": {f"p{i}": i for i in range(500)}}}.items():
        text, failed, _ = c.call("run", **arguments)
        if not failed or len(text) > 10000: reasons.append(f"{what}: {failed} {text[:300]}")
    code, out, err = c.end()
    expect(reasons, "the end", (code, err), (0, b""))
    for close in (("stdout",), ("stdout", "stdin")):
        c = Client(work / "hostile", "--limit-time", "300")
        c.number += 1
        c.send({"jsonrpc": "2.0", "id": c.number, "method": "tools/call", "params": {"name": "run", "arguments": {"program": "(let loop () (loop))"}}})
        time.sleep(0.3)
        for name in close: getattr(c.process, name).close()
        try: c.process.wait(timeout=20)
        except subprocess.TimeoutExpired: reasons.append(f"the command goes on without its client's {close}"); c.process.kill()
    if any(temporary.iterdir()): reasons.append(f"files remain: {list(temporary.iterdir())}")
    return reasons

for test in (house, tools, confined, wrong, hostile):
    name = "mcp/" + test.__name__
    if only and only not in name: continue
    try: result(name, test())
    except Exception as e: result(name, [repr(e)])
