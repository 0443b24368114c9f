# Tests `vs profile`: profile.py VS FOLDER ONLY. Prints `ok NAME`, or `not ok NAME` and its reasons.
import json, os, pathlib, random, re, subprocess, sys, xml.etree.ElementTree as tree

vs, work, only = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
root = pathlib.Path.cwd()

def run(*words, folder=work):
    return subprocess.run([vs, *map(str, words)], cwd=folder, capture_output=True, text=True, timeout=120)

def result(name, reasons):
    print(f"not ok {name}" if reasons else f"ok {name}")
    for reason in reasons[:8]: print("    " + str(reason)[:900])

# Each line of `spin` does the same work; line i of the program calls it `weight` times. The shares follow the weights.
def shares():
    reasons, weights = [], [1, 3, 0, 6]
    text = "(define (spin n)\n  (let loop ([i 0] [s 0])\n    (if (< i n)\n        (loop (+ i 1) (+ s (sqrt i)))\n        s)))\n(define (deep n w) (if (= n 0) (spin (* w 40000)) (+ 1 (deep (- n 1) w))))\n"
    text += "".join(f"(display (deep {10 * i} {w}))\n" for i, w in enumerate(weights))
    (work / "shares.vs").write_text(text)
    done = run("profile", "shares.vs", "--json")
    p = json.loads(done.stdout)
    lines = {l["line"]: l for l in p["lines"]}
    for i, w in enumerate(weights):
        share = lines.get(7 + i, {"total": 0})["total"] / p["seconds"]
        if abs(share - w / sum(weights)) > 0.15: reasons.append(f"line {7 + i} has {share:.2f} of the time, not {w / sum(weights):.2f}")
    loop = sum(lines[n]["own"] for n in (2, 3, 4) if n in lines) / p["seconds"]
    if loop < 0.8: reasons.append(f"the loop has {loop:.2f} of the time: {p['lines']}")
    if lines[6]["total"] > p["seconds"] * 1.001: reasons.append("a recursive line has more than all of the time")
    table = run("profile", "shares.vs").stdout
    if not re.search(r"^ *\d+\.\d % +\d+ % +\d+\.\d MB  shares.vs:4 +\(loop \(\+ i 1\) \(\+ s \(sqrt i\)\)\)$", table, re.M): reasons.append(f"the table: {table}")
    result("desk/profile:shares", reasons)

# Sums of the tree, for examples of every kind; the flame graph has its bars within those of the callers.
def sums():
    reasons = []
    paths = sorted(p for p in root.glob("examples/*.vs"))
    for path in paths if os.environ.get("LONG") else paths[::10]:
        done = run("profile", path, "--json", "-o", work / "flames.svg", "--limit-time", 20, folder=path.parent)
        if not done.stdout:
            reasons.append(f"{path.name}: {done.stderr}")
            continue
        try: p = json.loads(done.stdout[done.stdout.index('{"schema"'):])
        except ValueError: reasons.append(f"{path.name}: no JSON: {done.stdout[:300]}"); continue
        near = lambda a, b: abs(a - b) <= 1e-9 + 1e-6 * p["seconds"]
        if not near(sum(l["own"] for l in p["lines"]), p["seconds"]): reasons.append(f"{path.name}: the lines have another sum")
        if not near(sum(c["own"] for c in p["calls"]), p["seconds"]): reasons.append(f"{path.name}: the calls have another sum")
        whole = [c["own"] for c in p["calls"]]
        for i in range(len(whole) - 1, -1, -1):
            caller = p["calls"][i]["caller"]
            if caller > i: reasons.append(f"{path.name}: call {i} comes before its caller")
            elif caller: whole[caller - 1] += whole[i]
        for i, c in enumerate(p["calls"]):
            if not near(whole[i], c["total"]): reasons.append(f"{path.name}: call {i} has {c['total']}, not {whole[i]}")
        for l in p["lines"]:
            if l["own"] > l["total"] + 1e-9 or l["total"] > p["seconds"] + 1e-6: reasons.append(f"{path.name}: {l}")
            if l["file"].endswith(".vs") and l["line"] > len((path.parent / l["file"]).read_text().split("\n")): reasons.append(f"{path.name} has no line {l['line']}")
        if p["samples"]: flames(reasons, path.name, p)
    result("desk/profile:sums", reasons)

def flames(reasons, name, p):
    bars = [(float(r.get("x")), float(r.get("y")), float(r.get("width"))) for r in tree.parse(work / "flames.svg").getroot().iter("{http://www.w3.org/2000/svg}rect") if r.get("x")]
    bottom = max(y for _, y, _ in bars)
    wide = sum(c["total"] for c in p["calls"] if not c["caller"]) / p["seconds"]
    if abs(sum(w for _, y, w in bars if y == bottom) / 1180 - wide) > 0.02: reasons.append(f"{name}: the bars at the bottom have another sum")
    for x, y, w in bars:
        if x < 9.99 or x + w > 1190.01: reasons.append(f"{name}: a bar from {x} to {x + w}")
        if y < bottom and not any(abs(below - y - 18) < 0.1 and bx - 0.02 <= x and x + w <= bx + bw + 0.02 for bx, below, bw in bars): reasons.append(f"{name}: a bar without its caller below")

# A run that ends early is reported; bad uses are refused, and no input is lost.
def wrong():
    reasons = []
    (work / "endless.vs").write_text("(define (turn i)\n  (turn (+ i 1)))\n(turn 0)\n")
    done = run("profile", "endless.vs", "--limit-time", "0.3")
    if done.returncode != 4 or "endless.vs:2" not in done.stdout: reasons.append(f"a run past its limit: {done}")
    (work / "broken.vs").write_text("(define (f i) (if (< i 300000) (f (+ i 1)) (car i)))\n(f 0)\n")
    done = run("profile", "broken.vs")
    if done.returncode != 1 or "broken.vs:1" not in done.stdout or "car" not in done.stderr: reasons.append(f"a run with an error: {done}")
    for words in (("profile",), ("profile", "a.vs", "b.vs"), ("profile", "endless.vs", "-o", "a.stl"), ("profile", "endless.vs", "-o", "a.svg", "-o", "b.svg"), ("profile", "none.vs")):
        done = run(*words)
        if done.returncode != 2 or len(done.stderr.strip().split("\n")) != 1: reasons.append(f"{words}: {done}")
    (work / "own.svg").write_text("<svg/>")
    (work / "reads.vs").write_text('(display (string-length (file->string "own.svg")))\n(let loop ([i 0]) (if (< i 100000) (loop (+ i 1))))\n')
    done = run("profile", "reads.vs", "-o", "own.svg")
    if done.returncode != 2 or (work / "own.svg").read_text() != "<svg/>": reasons.append(f"an output onto an input: {done}")
    done = run("profile", "reads.vs", "-o", "-", "--format", "svg")
    if done.returncode or not done.stdout.startswith("<svg"): reasons.append(f"standard output: {done}")
    done = run("profile", "reads.vs", "-o", "none/a.svg")
    if done.returncode != 2: reasons.append(f"a folder that is not there: {done}")
    (work / "empty.vs").write_text("")
    done = run("profile", "empty.vs", "-o", "empty.svg")
    if done.returncode or "too short" not in done.stdout or tree.parse(work / "empty.svg") is None: reasons.append(f"an empty program: {done}")
    result("desk/profile:wrong", reasons)

# A random program counts its own forms: (at K body) adds 1 to counter K. Each count of --coverage equals the counter.
def program(r, depth, forms):
    def form(d):
        kind = r.choice(["if", "cond", "when", "and", "or", "let", "loop", "call", "leaf", "leaf"]) if d else "leaf"
        k = len(forms)
        forms.append(None)
        forms[k] = {"leaf": lambda: "(* i 2)", "if": lambda: f"(if {test(d)} {form(d - 1)} {form(d - 1)})", "cond": lambda: f"(cond [{test(d)} {form(d - 1)}] [{test(d)} {form(d - 1)}] [else {form(d - 1)}])",
            "when": lambda: f"(when {test(d)} {form(d - 1)} {form(d - 1)})", "and": lambda: f"(and {test(d)} {form(d - 1)})", "or": lambda: f"(or {test(d)} {form(d - 1)})",
            "let": lambda: f"(let ([i (+ i {r.randrange(3)})]) {form(d - 1)})", "loop": lambda: f"(do ([j 0 (+ j 1)]) ((= j {r.randrange(4)})) {form(d - 1)})", "call": lambda: f"((lambda (i #:k [k any? 1]) {form(d - 1)}) (- i 1))"}[kind]()
        return f"\n(at {k} {forms[k]}\n)"
    test = lambda d: r.choice(["(even? i)", f"(> i {r.randrange(9)})", f"(< 2 i {r.randrange(9)})"]) if r.random() < 0.6 or not d else f"(not {form(d - 1)})"
    return "".join(f"(define (f{n} i) {form(depth)})\n(for-each f{n} (iota {r.randrange(6)}))\n" for n in range(3))

def coverage():
    reasons, r = [], random.Random(59)
    for step in range(200 if os.environ.get("LONG") else 12):
        forms = []
        body = program(r, 5, forms)
        (work / "lib").mkdir(exist_ok=True)
        (work / "lib/at.sld").write_text("(define-library (at)\n  (export at counters)\n  (import (visualscheme))\n  (begin\n    (define counters (make-vector 10000 0))\n    (define-syntax at (syntax-rules () [(_ k body) (begin (vector-set! counters k (+ 1 (vector-ref counters k))) body)]))))\n")
        text = "(import (visualscheme) (at))\n" + body + f"(display (list \"counters\" (take (vector->list counters) {len(forms)})))\n"
        (work / "counts.vs").write_text(text)
        done = run("profile", "--coverage", "--json", "-L", work / "lib", "counts.vs")
        plain = run("profile", "--json", "-L", work / "lib", "counts.vs")
        said = re.search(r"\(counters \(([\d ]*)\)\)", done.stdout + done.stderr)
        if done.returncode or not said: reasons.append(f"step {step}: {done}"); continue
        if said[0] not in plain.stdout + plain.stderr: reasons.append(f"step {step}: the program has another result with --coverage")
        counters = [int(n) for n in said[1].split()]
        p = json.loads(done.stdout[done.stdout.index('{"schema"'):])
        counted = {f["line"]: f["count"] for f in sorted(p["forms"], key=lambda f: -f["column"]) if f["file"] == "counts.vs"}
        for number, line in enumerate(text.splitlines(), 1):
            k = re.match(r"\(at (\d+)", line)
            if k and counted.get(number) != counters[int(k[1])]: reasons.append(f"step {step}: line {number} ran {counters[int(k[1])]} times, not {counted.get(number)}: {line}")
        told = run("profile", "--coverage", "-L", work / "lib", "counts.vs").stdout
        for number, line in enumerate(text.splitlines(), 1):
            shown = re.search(rf"^ *(\d+|never)?( \*)? +{number}  {re.escape(line)}$", told, re.M)
            if not shown: reasons.append(f"step {step}: line {number} is not in the table: {line}")
            elif re.match(r"\(at", line) and (shown[1] == "never") != (counted[number] == 0): reasons.append(f"step {step}: the table has {shown[0]!r}")
    # Each example and each test of the language says the same with and without --coverage.
    for path in sorted([*root.glob("examples/*.vs"), *root.glob("tests/lang/*.vs")])[::1 if os.environ.get("LONG") else 40]:
        a, b = (run("profile", *words, path.name, "-q", "--limit-time", 60, folder=path.parent) for words in ((), ("--coverage",)))
        if a.returncode != b.returncode or (a.returncode != 4 and a.stderr != b.stderr): reasons.append(f"{path.name}: {a.returncode} {a.stderr[-300:]}, with --coverage {b.returncode} {b.stderr[-300:]}")
        if b.returncode == 0 and not re.search(r"^.*: \d+ of \d+ forms? ran|no form that could run", b.stdout, re.M): reasons.append(f"{path.name}: {b.stdout[-300:]}")
    (work / "half.vs").write_text("(define (f i) (if (< i 3)\n  (f (+ i 1))\n  (car i)))\n(f 0)\n(f 1)\n")
    done = run("profile", "--coverage", "half.vs")
    if done.returncode != 1 or "ended early" not in done.stdout or "half.vs: 7 of 7 forms ran" not in done.stdout: reasons.append(f"a run that ends early: {done.stdout}")
    for words in (("--coverage", "half.vs"), ("check", "--coverage", "half.vs"), ("profile", "--coverage")):
        done = run(*words)
        if done.returncode != 2 or len(done.stderr.strip().split("\n")) != 1: reasons.append(f"{words}: {done}")
    result("desk/profile:coverage", reasons)

for test in (shares, sums, coverage, wrong):
    if only and only not in "desk/profile:" + test.__name__: continue
    try: test()
    except Exception as e: result("desk/profile:" + test.__name__, [repr(e)])
