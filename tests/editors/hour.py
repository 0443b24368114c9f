# An hour of editing, in minutes: hour.py VS FOLDER EDITOR STEPS. Emacs with eglot, or Vim with ALE, runs the steps that a
# seed makes: it types, deletes, undoes, completes, renames, looks up, formats, saves and changes files. After each step the
# server's text equals the editor's. Prints `ok NAME`, or `not ok NAME` and its reasons.
# With the arguments `--between SERVER FOLDER` it is the program between the editor and the server, which asks for the text.
import json, os, pathlib, random, select, signal, subprocess, sys, time, urllib.parse

# ---- between the editor and the server ----

class Stream:
    def __init__(self, fd): self.fd, self.bytes, self.ended = fd, b"", False

    def ready(self, seconds=0): return not self.ended and bool(select.select([self.fd], [], [], seconds)[0])

    # The messages that have arrived whole.
    def messages(self):
        more = os.read(self.fd, 1 << 16)
        self.ended = not more
        self.bytes += more
        while b"\r\n\r\n" in self.bytes:
            head, _, rest = self.bytes.partition(b"\r\n\r\n")
            size = int([l for l in head.split(b"\r\n") if l.lower().startswith(b"content-length:")][0].split(b":")[1])
            if len(rest) < size: return
            self.bytes = rest[size:]
            yield rest[:size]

def write(fd, body):
    data = b"Content-Length: %d\r\n\r\n" % len(body) + body
    while data: data = data[os.write(fd, data):]

class Between:
    def __init__(self, server, folder):
        self.folder, self.number = folder, 0
        for name in ("SIGHUP", "SIGINT", "SIGTERM", "SIGPIPE"): signal.signal(getattr(signal, name), signal.SIG_IGN) # an editor may end it before the server
        self.log = open(folder / "log", "a")
        self.server = subprocess.Popen([server, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=open(folder / "said", "ab"))
        self.editor, self.answers = Stream(0), Stream(self.server.stdout.fileno())
        self.asked, self.changed, self.texts = {}, {}, {}

    def note(self, **what): print(json.dumps(what), file=self.log, flush=True)

    def from_editor(self):
        for body in self.editor.messages():
            m = json.loads(body)
            method, now = m.get("method", ""), time.monotonic()
            if "id" in m and method: self.asked[json.dumps(m["id"])] = (method, now)
            if method in ("textDocument/didOpen", "textDocument/didChange"): self.changed[m["params"]["textDocument"]["uri"]] = now
            if method == "textDocument/didOpen": self.note(opened=m["params"]["textDocument"]["uri"])
            write(self.server.stdin.fileno(), body)
        if self.editor.ended: self.server.stdin.close()

    def from_server(self):
        for body in self.answers.messages():
            m = json.loads(body)
            if isinstance(m.get("id"), str) and m["id"].startswith("between-"): self.texts[m["id"]] = m.get("result"); continue
            if m.get("method") == "textDocument/publishDiagnostics":
                begun = self.changed.pop(m["params"]["uri"], None)
                if begun: self.note(method="diagnostics", seconds=time.monotonic() - begun, sound=all(d.get("code") != "unreadable" for d in m["params"]["diagnostics"]))
            elif "id" in m and "method" not in m:
                method, begun = self.asked.pop(json.dumps(m["id"]), ("", 0))
                self.note(method=method, seconds=time.monotonic() - begun, error=m.get("error"), empty=not m.get("result"))
            try: write(1, body)
            except BrokenPipeError: pass

    # Compares the editor's text, which it has written into the file `step`, with the server's.
    def compare(self, path):
        while self.editor.ready(): self.from_editor()
        name, _, text = path.read_bytes().decode().partition("\n")
        path.unlink()
        self.number += 1
        id_, uri = f"between-{self.number}", pathlib.Path(name).as_uri()
        write(self.server.stdin.fileno(), json.dumps({"jsonrpc": "2.0", "id": id_, "method": "visualscheme/text", "params": {"textDocument": {"uri": uri}}}).encode())
        while id_ not in self.texts and not self.answers.ended: self.from_server()
        got = self.texts.pop(id_, None)
        if got != text: self.note(step=self.number, differs=[got, text])
        self.note(step=self.number)
        (self.folder / "compared").write_text(str(self.number))

    def run(self):
        step = self.folder / "step"
        while not self.answers.ended:
            ready = select.select([s.fd for s in (self.editor, self.answers) if not s.ended], [], [], 0.002)[0]
            if 0 in ready and not self.editor.ended: self.from_editor()
            if self.answers.fd in ready: self.from_server()
            if step.exists(): self.compare(step)
        self.note(ended=self.server.wait(), unasked=list(self.asked.values()))

# ---- the steps ----

STOREY = """(define (storey-{0} width [turn any? 0])
  (let* ([foot (make-box origin width width {0})] ; größe
         [band (make-box (xyz 0 0 {0}) width width 0.1)])
    (do-rotate (unite foot band) 'z turn)))
(draw (do-move (storey-{0} 4) (vxyz 0 0 (* 3 {0}))))
"""
FORMS = ["(draw (make-sphere (xyz 0 0 9) 2))\n", "(define λ 3) ; 😀 größe\n", "; a comment — mit Ümläuten\n", "(define (f x)\n  (* x 2))\n", "(draw\n  (make-cylinder origin 1 4))\n"]
BITS = ["(", ")", "\"", "#|", "\n", "  ", "x", "😀", "ü", "'", ";", "[", "]", "(draw (", "\\n", "\t"]

def program(first, count): return "".join(STOREY.format(i) for i in range(first, first + count))

# Steps as lists of a word and its arguments. A place is a number from 0 to 1 of the text's length.
def steps(seed, count):
    r, broken = random.Random(seed), 0
    for n in range(count):
        if n % 12 == 11:
            yield ["all", program(r.randrange(1, 5), r.randrange(20, 100))]
            broken = 0
            continue
        if broken and r.random() < 0.7:
            yield ["undo", 1]
            broken -= 1
            continue
        kind = r.choices(["type", "form", "break", "delete", "line", "replace", "undo", "complete", "hover", "definition", "references", "rename", "outline", "action", "format", "save", "other"],
                         [6, 4, 3, 3, 2, 1, 2, 4, 2, 2, 1, 4, 1, 1, 1, 2, 2])[0]
        at = round(r.random(), 6)
        if kind == "type": yield ["type", at, r.choice(["a", "storey ", "(f 1)", "ü", "😀", "3", "\n"])]; broken += 1
        elif kind == "form": yield ["form", at, r.choice(FORMS)]
        elif kind == "break": yield ["type", at, "".join(r.choice(BITS) for _ in range(r.randrange(1, 5)))]; broken += 1
        elif kind == "delete": yield ["delete", at, r.randrange(1, 30)]; broken += 1
        elif kind == "line": yield ["line", at]; broken += 1
        elif kind == "replace": yield ["replace", f"storey-{r.randrange(1, 20)}", f"storey-{r.randrange(1, 20)}"]; broken += 1
        elif kind == "undo": yield ["undo", r.randrange(1, 4)]
        elif kind == "complete": yield ["complete", r.choice(["make-sph", "stor", "do-mo", "width"])]
        elif kind == "rename": yield ["rename", f"storey-{r.randrange(1, 20)}", f"turm-{n}"]
        elif kind in ("hover", "definition", "references"): yield [kind, f"storey-{r.randrange(1, 20)}"]
        else: yield [kind]

def main(vs, work, editor, count):
    name, reasons = f"editors/{editor}:hour", []
    work.mkdir(parents=True, exist_ok=True)
    for file, first in (("one.vs", 1), ("two.vs", 101)):
        (work / file).write_text(program(first, 100 if file == "one.vs" else 10))
    (work / "steps").write_text("".join("\t".join(json.dumps(w, ensure_ascii=False) if isinstance(w, str) else str(w) for w in s) + "\n" for s in steps(59, count)))
    (work / "bin").mkdir(exist_ok=True)
    between = work / "bin/vs"
    between.write_text(f'#!/bin/sh\n[ "$1" = lsp ] || exec "{vs}" "$@"\nexec "{sys.executable}" "{pathlib.Path(__file__).resolve()}" --between "{vs}" "{work}"\n')
    between.chmod(0o755)
    here = pathlib.Path(__file__).resolve().parent
    if editor == "emacs": words = ["emacs", "--batch", "-q", "-L", here.parents[1] / "editors/emacs", "-l", "visualscheme", "-l", here / "hour.el", "--eval", "(hour)"]
    else: words = ["vim", "-es", "-u", "NONE", "-i", "NONE", "--cmd", "set nocompatible", "--cmd", "set rtp^=/usr/share/vim-ale", "--cmd", f"set rtp^={here.parents[1]}/editors/vim", "--cmd", "filetype plugin on", "--cmd", "runtime plugin/ale.vim", "-S", here / "hour.vim"]
    process = subprocess.Popen(list(map(str, words)), cwd=work, env={**os.environ, "PATH": f"{work}/bin:{os.environ['PATH']}", "EMACSNATIVELOADPATH": "/dev/null"}, stdin=subprocess.DEVNULL, stdout=open(work / "editor", "wb"), stderr=subprocess.STDOUT, start_new_session=True)
    try: code = process.wait(timeout=120 + count * 2)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        code = "too long"
    said = (work / "editor").read_text(errors="replace")
    if code: reasons.append(f"the editor ended with {code}: {said[-600:]}")
    end = time.time() + 20
    while time.time() < end and '"ended"' not in (work / "log").read_text(): time.sleep(0.05)
    log = [json.loads(line) for line in (work / "log").read_text().splitlines()]
    server = (work / "said").read_text()
    if server: reasons.append(f"the server printed {server[-600:]}")
    done = [m["step"] for m in log if "step" in m and "differs" not in m]
    if len(done) != count: reasons.append(f"{len(done)} of {count} steps were compared: {said[-600:]}")
    if not any("ended" in m for m in log): reasons.append("the server did not end")
    for m in log:
        if "differs" in m: reasons.append(f"step {m['step']}: the server has {m['differs'][0]!r}, the editor {m['differs'][1]!r}")
        if m.get("error") and m["method"] not in ("textDocument/rename", "textDocument/semanticTokens/full"): reasons.append(f"{m['method']}: {m['error']}")
        if m.get("ended"): reasons.append(f"the server ended with {m['ended']}")
        if m.get("unasked"): reasons.append(f"no answer to {m['unasked']}")
    opened = {m["opened"] for m in log if "opened" in m}
    if len(opened) < 2 and count > 100: reasons.append(f"only {opened} was opened")
    times = {}
    for m in log:
        if "seconds" in m: times.setdefault(m["method"], []).append(1000 * m["seconds"])
    wanted = {"textDocument/completion", "textDocument/hover", "textDocument/definition", "textDocument/references", "textDocument/rename", "diagnostics"}
    if count > 100 and wanted - set(times): reasons.append(f"nobody asked for {wanted - set(times)}")
    sound = sum(m["sound"] for m in log if "sound" in m)
    if sound < count / 3: reasons.append(f"only {sound} texts could be read")
    if not any(m.get("method") == "textDocument/rename" and not m["error"] for m in log) and count > 100: reasons.append("no rename had edits")
    if os.environ.get("TELL"):
        print(f"# {editor}: {len(done)} steps, {sound} sound texts")
        for method, t in sorted(times.items()): print(f"# {editor} {method}: {len(t)} times, median {sorted(t)[len(t) // 2]:.0f} ms, 95 % {sorted(t)[len(t) * 19 // 20]:.0f}, most {max(t):.0f} ms")
    print(f"not ok {name}" if reasons else f"ok {name}")
    for reason in reasons[:8]: print("    " + reason[:600].replace("\n", "\\n"))

if sys.argv[1] == "--between": Between(sys.argv[2], pathlib.Path(sys.argv[3])).run()
else: main(os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3], int(sys.argv[4]))
