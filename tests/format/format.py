# Runs `vs format` on the repository's programs and on generated ones: format.py VS FOLDER ONLY COUNT.
# Prints `ok NAME`, or `not ok NAME` and its reasons.
import os, pathlib, random, re, resource, stat, subprocess, sys

vs, work, only, count = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], int(sys.argv[4])

def run(*words, text=None):
    done = subprocess.run([vs, *map(str, words)], input=text, capture_output=True)
    return done.returncode, done.stdout, done.stderr.decode(errors="replace")

def result(name, reasons):
    if only and only not in name: return
    print(f"not ok {name}" if reasons else f"ok {name}")
    for reason in reasons[:8]: print("    " + str(reason).replace("\n", "\n    ")[:600])

# ---- what must stay ----

# Splits a text into comments, strings, characters and the rest. It shares nothing with the formatter.
PARTS = re.compile(r'''(?P<datum>\#;)|(?P<block>\#\|)|(?P<line>;[^\n\r]*)|(?P<string>"(?:\\.|[^"\\])*")|(?P<bars>\|(?:\\.|[^|\\])*\|)|(?P<char>\#\\(?:[^\w\s]|\w+|\s))''', re.S)

def comments(text):
    found, at = [], 0
    while (m := PARTS.search(text, at)):
        at = m.end()
        if m.lastgroup == "line": found.append(m.group().rstrip())
        if m.lastgroup == "block":
            depth, at = 1, m.end()
            while depth and at < len(text):
                if text.startswith("|#", at): depth, at = depth - 1, at + 2
                elif text.startswith("#|", at): depth, at = depth + 1, at + 2
                else: at += 1
            found.append(text[m.start():at])
    return found

SAME = '''
(define (data path)
  (call-with-input-file path
    (lambda (port)
      (let loop ([all '()])
        (let ([datum (read port)]) (if (eof-object? datum) (reverse all) (loop (cons datum all))))))))
(define (compare before after) (if (not (equal? (data before) (data after))) (begin (display before) (newline))))
'''

# Formats the files, names and texts, and returns the reasons why the style does not hold for them.
def check_all(name, texts):
    before, after = work / name / "before", work / name / "after"
    for folder in (before, after): folder.mkdir(parents=True, exist_ok=True)
    for file, text in texts.items():
        (before / file).write_bytes(text)
        (after / file).write_bytes(text)
    files, reasons = list(texts), []
    for i in range(0, len(files), 500):
        some = [after / f for f in files[i:i + 500]]
        code, out, err = run("format", *some)
        if code or out or err: reasons.append(f"vs format: {code} {out} {err}")
        code, out, err = run("format", "--check", *some)
        if code or out or err: reasons.append(f"not idempotent: {code} {out.decode()} {err}")
    for file, text in texts.items():
        one, two = comments(text.decode()), comments((after / file).read_bytes().decode())
        if one != two: reasons.append(f"comments of {file} differ: {[p for p in zip(one, two) if p[0] != p[1]][:2]}")
    program = work / name / "same.vs"
    program.write_text(SAME + "".join(f'(compare "{before / f}" "{after / f}")\n' for f in files
                                     if b"#lang" not in texts[f]))  # (read) of a port knows no #lang
    code, out, err = run("--quiet", program)
    if code or out: reasons.append(f"data differ: {code} {out.decode()} {err}")
    return reasons

# ---- the repository's programs ----

def repository():
    texts = {}
    for folder in ("examples", "tests", "library", "bind", "."):
        for path in sorted(pathlib.Path(folder).glob("*" if folder == "." else "**/*")):
            if path.suffix not in (".vs", ".scm") or not path.is_file() or "node_modules" in path.parts: continue
            text = path.read_bytes()
            if run("format", "--check", "-", text=text)[2]: continue  # not readable: a fixture of a mistake
            texts[str(path).replace("/", "_")] = text
    return texts if len(texts) > 300 else {}

# ---- generated programs ----

HEADS = ("define lambda let let* letrec do case cond if when unless begin for/list for/fold match guard syntax-rules "
         "define-record-type define-parameter with-material call-with-values list xyz unite make-box + f "
         "case-lambda parameterize receive define-library a-procedure-with-quite-a-long-name").split()
ATOMS = ('x y 12 -3/4 1.5e3 +inf.0 #t #false "text" "a ; b" "two\nlines" "\\" (" #\\( #\\) #\\; #\\space #\\x41 #\\" |a ; b| '
         "#:width #:material a.b ... 1+ - λ größe ünï 'sym `(a ,b ,@c) #(1 2) #u8(1 2) () '() #;(gone 1) #;x")
ATOMS = re.findall(r'#\\.\w*|"(?:\\.|[^"\\])*"|\|[^|]*\||[^\s]+\([^()]*\)|[^\s]+', ATOMS, re.S)

class Program:
    def __init__(self, seed):
        self.r, self.tokens, self.comments = random.Random(seed), [], 0

    def blank(self):                               # a line end, or none, and then perhaps a comment
        r = self.r.random()
        if r < 0.12: self.tokens.append("\n")
        elif r < 0.14: self.tokens.append("\n\n")
        elif r < 0.17: self.comment("\n;" + self.r.choice(["", ";", " "]))
        elif r < 0.19: self.comment(";")
        elif r < 0.2:
            self.comments += 1
            self.tokens.append(f"#| {self.comments} #| ( |# {self.r.choice(['', chr(10) + '  ; '])}|#")

    def comment(self, start):
        self.comments += 1
        self.tokens.append(f"{start} {self.comments} ( \" |#")
        self.tokens.append("\n")

    def datum(self, depth):
        self.blank()
        if depth == 0 or self.r.random() < 0.45:
            self.tokens.append(self.r.choice(ATOMS))
            if self.tokens[-1].startswith("#;"): self.tokens.append(self.r.choice("abc"))
            return
        mark = self.r.choice(["", "", "", "", "'", "`", "#;"])
        open_, close = self.r.choice([("(", ")"), ("(", ")"), ("[", "]"), ("#(", ")")])
        self.tokens.append(mark + open_)
        if self.r.random() < 0.8: self.tokens.append(self.r.choice(HEADS))
        for _ in range(self.r.choice([0, 1, 2, 3, 4, 4, 12])): self.datum(depth - 1)
        self.blank()
        self.tokens.append(close)
        if mark == "#;": self.tokens.append("kept")

    def text(self, seed):                          # the tokens with blanks between them
        r, out = random.Random(seed), ""
        for token in self.tokens:
            space = r.choice([" ", " ", "  ", "\t", "      "])
            if out.endswith("\n") and token != "\n": space = r.choice(["", " ", "       ", "\t"])
            if token.startswith("\n"): space = r.choice(["", "", "  "])
            elif out[-1:] in ("(", "[") and not out.endswith("\\" + out[-1:]) or token in ")]": space = r.choice(["", "", " "])
            if re.search(r"#\\.\w*$", out): space = space or " "
            out += space + token
        return out

def programs(first, n):
    texts, twins = {}, {}
    for seed in range(first, first + n):
        p = Program(seed)
        for _ in range(p.r.choice([1, 2, 5])):
            p.datum(p.r.choice([1, 3, 5, 7]))
            p.tokens.append("\n")
        trailing = any(re.match(";", t) for t in p.tokens)
        texts[f"{seed}.vs"] = p.text(1).encode()
        if not trailing: twins[f"{seed}.vs"] = p.text(2).encode()
    return texts, twins

def generated():
    reasons = []
    for first in range(0, count, 1000):
        texts, twins = programs(first, min(1000, count - first))
        reasons += check_all(f"texts{first}", texts)
        reasons += check_all(f"twins{first}", twins)
        for file in twins:
            one, two = ((work / f"{kind}{first}" / "after" / file).read_bytes() for kind in ("texts", "twins"))
            if one != two: reasons.append(f"blanks change the style of {file}")
    return reasons

# ---- files ----

def files():
    reasons, folder = [], work / "files"
    folder.mkdir()
    def expect(what, is_, want):
        if is_ != want: reasons.append(f"{what}: {is_!r}, not {want!r}")
    bad, good, link, other = folder / "bad.vs", folder / "good.vs", folder / "link.vs", folder / "other.vs"
    bad.write_bytes(b"(define x\n  (f 1)\n")
    good.write_bytes(b"( define   x 1 )")
    os.chmod(good, 0o640)
    link.symlink_to("good.vs")
    other.write_bytes(b"(f  1)\r\n\r\n\r\n\r\n(g)\r\n")
    code, out, err = run("format", "--check", bad, link, other)
    expect("--check: code, names", (code, out.decode()), (1, f"{link}\n{other}\n"))
    expect("--check: the place", err.startswith(f"{bad}:1:1: "), True)
    code, out, err = run("format", bad, link, other, folder / "none.vs")
    expect("code", code, 1)
    expect("the file that does not read", bad.read_bytes(), b"(define x\n  (f 1)\n")
    expect("a link's file", good.read_bytes(), b"(define x 1)\n")
    expect("the link and the permissions", (link.is_symlink(), stat.S_IMODE(os.stat(good).st_mode)), (True, 0o640))
    expect("line ends of Windows", other.read_bytes(), b"(f 1)\r\n\r\n(g)\r\n")
    untidy = b"(f   1)"
    other.write_bytes(untidy)
    full = subprocess.run([vs, "format", other], capture_output=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0)))
    expect("a full disk", (full.returncode, b"File too large" in full.stderr, other.read_bytes()), (2, True, untidy))
    expect("no other file", sorted(os.listdir(folder)), ["bad.vs", "good.vs", "link.vs", "other.vs"])
    stamp = os.stat(good).st_mtime_ns
    expect("a file in the style", run("format", good)[0], 0)
    expect("its time", os.stat(good).st_mtime_ns, stamp)
    expect("no file", run("format", folder / "none.vs")[0], 2)
    expect("a folder", run("format", folder)[0], 2)
    expect("JavaScript", run("format", "tests/javascript/none.js")[0], 2)
    expect("no word", run("format")[0], 2)
    expect("standard input", run("format", "-", text=b"(f\n 1 )"), (0, b"(f\n  1)\n", ""))
    expect("an empty text", run("format", "-", text=b" \n \n"), (0, b"", ""))
    expect("no text", run("format", "-", text=b"(f \xff)")[0], 1)
    deep = b"(f " * 5000 + b")" * 5000
    expect("a deep text", run("format", "-", text=deep)[0], 0)
    expect("a long line of data", run("format", "-", text=b"'(" + b"12345 " * 100000 + b")")[0], 0)
    return reasons

texts = repository()
result("format/files", files())
result("format/repository", check_all("repository", texts) if texts else ["fewer than 300 programs were found"])
result(f"format/generated", generated())
