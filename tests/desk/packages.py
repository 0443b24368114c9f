# Tests `vs new`, `vs add` and `vs search`: packages.py VS FOLDER ONLY. Prints `ok NAME`, or `not ok NAME` and its reasons.
import json, os, pathlib, shutil, subprocess, sys

vs, work, only = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
quiet = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@example.org", "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@example.org"}

def run(folder, *words, **more):
    return subprocess.run([vs, *map(str, words)], cwd=folder, capture_output=True, text=True, timeout=120, env={**quiet, **more})

def git(folder, *words):
    return subprocess.run(["git", "-c", "init.defaultBranch=main", "-c", "protocol.file.allow=always", *map(str, words)], cwd=folder, capture_output=True, text=True, check=True, env=quiet).stdout.strip()

def expect(reasons, what, done, code, *texts):
    if done.returncode != code: reasons.append(f"{what}: ended with {done.returncode}, not {code}: {done.stdout}{done.stderr}")
    for text in texts:
        if text not in done.stdout + done.stderr: reasons.append(f"{what} lacks {text!r}: {done.stdout}{done.stderr}")
    if code and len(done.stderr.strip().split("\n")) != 1: reasons.append(f"{what}: {done.stderr}")

# All files below a folder with their contents.
def content(folder):
    return {str(p.relative_to(folder)): (p.read_bytes() if p.is_file() else None) for p in sorted(folder.rglob("*"))}

def library(folder, name, part, body, needs=None, imports=""):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{part}.sld").write_text(f"(define-library ({name} {part}) (export {part}) (import (visualscheme) {imports}) (begin {body}))\n")
    if needs is not None: (folder / "vs-package.json").write_text(json.dumps({"name": name, "needs": needs}))

def place(name):
    folder = work / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder

def new():
    reasons, folder = [], place("new")
    expect(reasons, "vs new", run(folder, "new", "mill"), 0, "mill/mill.vs", "mill/mill/parts.sld")
    made = content(folder)
    expect(reasons, "its model", run(folder, "mill/mill.vs", "-o", "mill.stl"), 0, "4 x 4 x 9 m")
    expect(reasons, "its parameter", run(folder / "mill", "mill.vs", "-D", "storeys=5"), 0, "4 x 4 x 15 m")
    expect(reasons, "its checks", run(folder / "mill", "test", "mill-test.vs"), 0, "2 passed, 0 failed")
    for file in ("mill.vs", "mill/parts.sld", "mill-test.vs"):
        expect(reasons, f"check {file}", run(folder / "mill", "check", file), 0)
        expect(reasons, f"format {file}", run(folder / "mill", "format", "--check", file), 0)
    expect(reasons, "a second time", run(folder, "new", "mill"), 2, "mill")
    if {k: v for k, v in content(folder).items() if k != "mill.stl"} != made: reasons.append("vs new changed a folder that was there")
    for name in ("Mill", "a b", "../x", "", "-x", "x/y", "1x", "scheme", "ü", "x" * 70): expect(reasons, f"vs new {name!r}", run(folder, "new", "--", name), 2)
    for words in (("new",), ("new", "a", "b"), ("new", "a", "-o", "x.stl")): expect(reasons, words, run(folder, *words), 2)
    return reasons

# Copies a project to another folder, and runs it with another HOME, without git and network, and without the packages' sources. Each
# changed byte of the copy is refused.
def alone(reasons, project, to, sources, size):
    shutil.copytree(project, to)
    for s in sources: s.rename(str(s) + ".away")
    cut = [shutil.which("unshare"), "-rn"] if shutil.which("unshare") and subprocess.run(["unshare", "-rn", "true"], capture_output=True).returncode == 0 else []
    def run_alone(*words): return subprocess.run([*cut, vs, *words], cwd=to, capture_output=True, text=True, timeout=120, env={"HOME": "/none", "PATH": "/none"})
    expect(reasons, "moved with its packages", run_alone("model.vs"), 0, size)
    expect(reasons, "moved: vs add", run_alone("add"), 0, "all packages")
    for file in sorted(p for p in (to / ".vs").rglob("*") if p.is_file()):
        text = file.read_bytes()
        file.write_bytes(text[:-1] + bytes([text[-1] ^ 1]))
        expect(reasons, f"moved, with another {file.name}", run_alone("model.vs"), 2, "has changed")
        file.write_bytes(text)
    expect(reasons, "moved, mended", run_alone("model.vs"), 0, size)
    for s in sources: pathlib.Path(str(s) + ".away").rename(s)

PROGRAM = "(import (visualscheme) (towers spire))\n(draw (spire 2))\n"

# A package with a dependency is added, locked, moved and imported; each change of it is refused.
def folders():
    reasons, folder = [], place("folders")
    library(folder / "shelf/towers", "towers", "spire", "(define (spire n) (brick (* 3 n)))", {"bricks": "../bricks"}, "(bricks brick)")
    library(folder / "shelf/bricks", "bricks", "brick", "(define (brick h) (make-box origin 1 1 h))")
    home = folder / "home"
    home.mkdir()
    (home / "model.vs").write_text(PROGRAM)
    if "no library" not in run(home, "model.vs").stderr: reasons.append("there is a library before vs add")
    expect(reasons, "vs add", run(home, "add", "../shelf/towers"), 0, "towers from ../shelf/towers", "bricks from ../shelf/towers/../bricks")
    expect(reasons, "the import", run(home, "model.vs"), 0, "1 x 1 x 6 m")
    expect(reasons, "from elsewhere", run(folder, "home/model.vs"), 0, "1 x 1 x 6 m")
    (home / "deep/er").mkdir(parents=True)
    (home / "deep/er/model.vs").write_text(PROGRAM)
    expect(reasons, "from a folder below", run(home / "deep/er", "model.vs"), 0, "1 x 1 x 6 m")
    expect(reasons, "vs check", run(home, "check", "model.vs"), 0)
    lock = json.loads((home / "vs.lock").read_text())
    if [(p["name"], p["commit"], p["direct"], len(p["hash"])) for p in lock["packages"]] != [("towers", "", True, 64), ("bricks", "", False, 64)]: reasons.append(f"the lock: {lock}")
    expect(reasons, "vs add alone", run(home, "add"), 0, "all packages")
    alone(reasons, home, folder / "alone", [folder / "shelf"], "1 x 1 x 6 m")
    moved = place("folders/moved")
    for name in ("model.vs", "vs.lock"): shutil.copy(home / name, moved / name)
    expect(reasons, "without the packages", run(moved, "model.vs"), 2, "towers", "vs add fetches it")
    expect(reasons, "on another machine", run(moved, "add"), 0, "towers", "bricks")
    expect(reasons, "the import there", run(moved, "model.vs"), 0, "1 x 1 x 6 m")
    if content(moved / ".vs") != content(home / ".vs") or (moved / "vs.lock").read_text() != (home / "vs.lock").read_text(): reasons.append("the other machine has other packages")
    sound = content(moved)
    spire = moved / ".vs/towers/spire.sld"
    text = spire.read_text()
    def swap(): (moved / ".vs/bricks").rename(moved / "b"); (moved / ".vs/towers").rename(moved / ".vs/bricks"); (moved / "b").rename(moved / ".vs/towers")
    changes = {
        "a byte": lambda: spire.write_text(text.replace("3", "4")), "a blank": lambda: spire.write_text(text + " "), "a file more": lambda: (moved / ".vs/towers/more.sld").write_text(""),
        "a file less": spire.unlink, "another name": lambda: spire.rename(moved / ".vs/towers/other.sld"), "a package more": lambda: library(moved / ".vs/evil", "evil", "x", "(define x 1)"),
        "a package less": lambda: shutil.rmtree(moved / ".vs/bricks"), "a link": lambda: (spire.unlink(), spire.symlink_to(folder / "shelf/towers/spire.sld")), "two swapped": swap,
    }
    for what, change in changes.items():
        change()
        for words in (("model.vs",), ("check", "model.vs"), ("test", "model.vs"), ("-e", "1"), ("format", "--check", "model.vs")):
            expect(reasons, f"{what}: {words}", run(moved, *words), 2)
        if what == "a package more": shutil.rmtree(moved / ".vs/evil")
        expect(reasons, f"{what}: fetched again", run(moved, "add"), 0)
        if content(moved) != sound: reasons.append(f"{what}: vs add does not restore the packages")
    library(folder / "shelf/towers", "towers", "spire", "(define (spire n) (brick (* 5 n)))", {"bricks": "../bricks"}, "(bricks brick)")
    shutil.rmtree(moved / ".vs/towers")
    before = content(moved)
    expect(reasons, "another package at the source", run(moved, "add"), 2, "not the one of vs.lock")
    if content(moved) != before: reasons.append("a refused package changed the folder")
    expect(reasons, "vs add renews it", run(home, "add", "../shelf/towers"), 0, "towers")
    expect(reasons, "the new one", run(home, "model.vs"), 0, "1 x 1 x 10 m")
    return reasons

# Sources that are refused, each in one line; the folder stays as it was.
def refused():
    reasons, folder = [], place("refused")
    shelf, home = folder / "shelf", folder / "home"
    home.mkdir()
    library(shelf / "good", "good", "x", "(define x 1)")
    library(shelf / "Bad-Name", "Bad-Name", "x", "(define x 1)")
    library(shelf / "scheme", "scheme", "x", "(define x 1)")
    library(shelf / "other", "another", "x", "(define x 1)", {})
    library(shelf / "wants", "wants", "x", "(define x 1)", {"good": "../none"})
    library(shelf / "misnamed", "misnamed", "x", "(define x 1)", {"good": "../other"})
    library(shelf / "odd", "odd", "x", "(define x 1)", {"good": 5})
    library(shelf / "odder", "odder", "x", "(define x 1)", {"../good": "../good"})
    library(shelf / "linked", "linked", "x", "(define x 1)")
    (shelf / "linked/y.sld").symlink_to("/etc/passwd")
    library(shelf / "piped", "piped", "x", "(define x 1)")
    os.mkfifo(shelf / "piped/y.sld")
    library(shelf / "torn", "torn", "x", "(define x 1)")
    (shelf / "torn/vs-package.json").write_text("{")
    library(shelf / "round", "round", "x", "(define x 1)", {"turn": "../turn"})
    library(shelf / "turn", "turn", "x", "(define x 1)", {"round": "../round"})
    expect(reasons, "good", run(home, "add", "../shelf/good"), 0)
    before = content(home)
    for name in ("Bad-Name", "scheme", "wants", "misnamed", "odd", "odder", "linked", "piped", "torn", "none"):
        for words in ((f"../shelf/{name}",), ("../shelf/other", f"../shelf/{name}")):
            expect(reasons, f"{words}", run(home, "add", *words), 2)
            if content(home) != before: reasons.append(f"{words} changed the folder"); before = content(home)
    (home / "vs.lock").write_text("{}")
    expect(reasons, "no lock", run(home, "add"), 2, "vs.lock")
    expect(reasons, "a program beside it", run(home, "-e", "1"), 2, "vs.lock")
    (home / "vs.lock").write_text('{"schema": 1, "packages": [{"name": "../x", "source": "a", "commit": "", "hash": "' + 64 * "0" + '"}]}')
    expect(reasons, "a lock that leads out", run(home, "add"), 2, "vs.lock")
    shutil.rmtree(home)
    home.mkdir()
    done = run(home, "add", "../shelf/round")
    if done.returncode not in (0, 2): reasons.append(f"packages that need each other: {done}")
    for words in (("add", "-"), ("add", "../shelf/good", "-o", "x"), ("add", "--check", "../shelf/good")): expect(reasons, words, run(home, *words), 2)
    return reasons

# By git: the commit is locked; later commits, names after # and needs.
def by_git():
    reasons, folder = [], place("git")
    if not shutil.which("git"): return print("skip desk/packages:by_git: no git") or None
    def repository(name, *more, **needs):
        path = folder / f"{name}.git"
        library(path, name, "part", f"(define (part n) {more[0]})", {k: f"file://{folder}/{v}" for k, v in needs.items()} or None, more[1] if len(more) > 1 else "")
        git(path, "init", "-q", "."); git(path, "add", "."); git(path, "commit", "-qm", "one"); git(path, "tag", "one")
        return path
    bricks = repository("bricks", "(make-box origin 1 1 n)")
    towers = repository("towers", "(do-scale (list (bricks:part n)) 2)", "(prefix (bricks part) bricks:)", bricks="bricks.git#one")
    marks = folder / "ran"
    hooks = folder / "hooks"
    hooks.mkdir()
    (hooks / "post-checkout").write_text(f"#!/bin/sh\ntouch {marks}\n")
    (hooks / "post-checkout").chmod(0o755)
    (folder / "config").write_text(f"[core]\n\thooksPath = {hooks}\n")
    home = folder / "home"
    home.mkdir()
    (home / "model.vs").write_text("(import (visualscheme) (towers part))\n(draw (part 2))\n")
    expect(reasons, "vs add", run(home, "add", f"file://{towers}", GIT_CONFIG_GLOBAL=str(folder / "config")), 0, "towers", "bricks")
    if marks.exists(): reasons.append("a hook ran")
    expect(reasons, "the import", run(home, "model.vs"), 0, "2 x 2 x 4 m")
    lock = {p["name"]: p for p in json.loads((home / "vs.lock").read_text())["packages"]}
    if lock["towers"]["commit"] != git(towers, "rev-parse", "HEAD"): reasons.append(f"the lock: {lock}")
    alone(reasons, home, folder / "alone", [bricks, towers], "2 x 2 x 4 m")
    (towers / "part.sld").write_text((towers / "part.sld").read_text().replace(") 2)", ") 3)"))
    git(towers, "commit", "-qam", "two")
    git(towers, "checkout", "-qb", "wide")
    (towers / "part.sld").write_text((towers / "part.sld").read_text().replace(") 3)", ") 5)"))
    git(towers, "commit", "-qam", "three")
    git(towers, "checkout", "-q", "main")
    shutil.rmtree(home / ".vs")
    expect(reasons, "fetched again", run(home, "add"), 0, "towers", "bricks")
    expect(reasons, "the locked commit", run(home, "model.vs"), 0, "2 x 2 x 4 m")
    for name, size in (("", "3 x 3 x 6 m"), ("#one", "2 x 2 x 4 m"), ("#wide", "5 x 5 x 10 m"), ("#" + lock["towers"]["commit"], "2 x 2 x 4 m")):
        expect(reasons, f"vs add {name}", run(home, "add", f"file://{towers}{name}"), 0)
        expect(reasons, f"the import {name}", run(home, "model.vs"), 0, size)
    before = content(home)
    for source in (f"file://{towers}#none", f"file://{folder}/none.git", f"file://{towers}#", f"file://{towers}#--help", "ext::sh -c touch% ran", "--upload-pack=x.git"):
        done = run(home, "add", "--", source)
        if done.returncode not in (2, 3) or content(home) != before: reasons.append(f"{source}: {done}")
    library(folder / "sly.git", "sly", "part", "(define (part) 1)", {"bricks": "/etc"})
    git(folder / "sly.git", "init", "-q", "."); git(folder / "sly.git", "add", "."); git(folder / "sly.git", "commit", "-qm", "one")
    expect(reasons, "a need that is a folder", run(home, "add", f"file://{folder}/sly.git"), 2, "only packages by git")
    expect(reasons, "without git", run(home, "add", f"file://{towers}", PATH="/none"), 3, "git is missing")
    if content(home) != before: reasons.append("a refused package changed the folder")
    return reasons

# An index as a file, in a folder and by git: it is searched, its packages are added by name, and faults are refused.
def index():
    reasons, folder = [], place("index")
    shelf, home = folder / "shelf", folder / "home"
    home.mkdir()
    library(shelf / "towers", "towers", "spire", "(define (spire n) (brick (* 3 n)))", {"bricks": "../bricks"}, "(bricks brick)")
    library(shelf / "bricks", "bricks", "brick", "\n; a brick of height h\n(define (brick h) (make-box origin 1 1 h))")
    rows = [{"name": "towers", "address": "towers", "description": "Spires \x1b[31mand\x9b roofs", "version": "2.1"}, {"name": "bricks", "address": "bricks"}]
    def write(rows, **more): (shelf / "vs-index.json").write_text(json.dumps({"schema": 1, "packages": rows, **more}))
    write(rows)
    bricks, towers = "bricks (../shelf/bricks)", "towers 2.1: Spires  [31mand  roofs (../shelf/towers)"
    for words, wanted in (((), [bricks, towers]), (("SPIRES",), [towers]), (("spire", "roof"), [towers]), (("brick",), [bricks]), (("spire", "brick"), ["no package of ../shelf has these words"])):
        for source in ("../shelf", "../shelf/vs-index.json"):
            done = run(home, "search", *words, "--index", source)
            if done.returncode or done.stdout.replace(source, "../shelf").split("\n")[:-1] != wanted: reasons.append(f"search {words}: {done}")
    found = run(home, "search", "tower", "--json", VS_PACKAGE_INDEX="../shelf")
    if json.loads(found.stdout) != {"schema": 1, "packages": [{**rows[0], "address": "../shelf/towers"}]}: reasons.append(f"as JSON: {found}")
    if json.loads(run(home, "search", "none", "--json", VS_PACKAGE_INDEX="../shelf").stdout)["packages"]: reasons.append("JSON of nothing")
    (home / "model.vs").write_text(PROGRAM)
    expect(reasons, "add by name", run(home, "add", "towers", VS_PACKAGE_INDEX="../shelf"), 0, "towers from ../shelf/towers", "bricks from")
    expect(reasons, "the import", run(home, "model.vs"), 0, "1 x 1 x 6 m")
    expect(reasons, "its pages", run(home, "doc", ".vs/bricks/brick.sld", "-o", "site"), 0)
    if "a brick of height h" not in (home / "site/functions.html").read_text(): reasons.append("the pages lack the procedure's comment")
    (home / "bricks").mkdir()
    expect(reasons, "a folder comes first", run(home, "add", "bricks", "--index", "../shelf"), 0, "bricks from bricks")
    shutil.rmtree(home); home.mkdir()
    expect(reasons, "a name that the index lacks", run(home, "add", "domes", "--index", "../shelf"), 2, "domes", "no such package")
    expect(reasons, "a name without an index", run(home, "add", "towers"), 2, "--index")
    expect(reasons, "no index", run(home, "search", "towers"), 2, "VS_PACKAGE_INDEX")
    library(shelf / "wrong", "other", "x", "(define x 1)", {})
    faults = {"no name": [{"address": "x"}], "a bad name": [{"name": "../x", "address": "x"}], "no address": [{"name": "x"}], "an empty address": [{"name": "x", "address": ""}], "twice": [rows[0], rows[1], rows[0]], "no object": [5], "null": [None]}
    for what, bad in faults.items():
        write(bad)
        for words in (("search", "x"), ("add", "towers")): expect(reasons, f"{what}: {words}", run(home, *words, "--index", "../shelf"), 2, "../shelf")
    write(rows, schema=2)
    expect(reasons, "another schema", run(home, "search", "--index", "../shelf"), 2, "no index")
    for text in (b"", b"{", b"[]", b"\xff\xfe{}", b"[" * 100000, b'{"schema": 1}', b'{"schema": 1, "packages": {}}', b'{"schema": 1, "packages": 7}'):
        (shelf / "vs-index.json").write_bytes(text)
        done = run(home, "search", "--index", "../shelf")
        if done.returncode not in (0, 2) or (done.returncode and len(done.stderr.strip().split("\n")) != 1) or (not done.returncode and "packages" not in text.decode()): reasons.append(f"{text[:40]}: {done}")
    for source in ("none", "../shelf/none.json", "/dev/null", "..", "x" * 5000): expect(reasons, source[:20], run(home, "search", "--index", source), 2)
    write([{"name": "other", "address": "towers"}, {"name": "domes", "address": "none"}])
    expect(reasons, "another package at the address", run(home, "add", "other", "--index", "../shelf"), 2, "another name")
    expect(reasons, "no package at the address", run(home, "add", "domes", "--index", "../shelf"), 2, "no such folder")
    for words in (("model.vs", "--index", "x"), ("new", "x", "--index", "x"), ("search", "--index"), ("search", "--index", ""), ("search", "x", "-o", "y")): expect(reasons, words, run(home, *words), 2)
    if any(home.iterdir()): reasons.append(f"refused words left {list(home.iterdir())}")
    if not shutil.which("git"): return reasons
    git_index, kept = folder / "index.git", {"TMPDIR": str(folder / "temporary")}
    (folder / "temporary").mkdir()
    for path in (folder / "posts.git", git_index): path.mkdir()
    library(folder / "posts.git", "posts", "post", "(define (post h) (make-cylinder origin 1 h))")
    (git_index / "vs-index.json").write_text(json.dumps({"schema": 1, "packages": [{"name": "posts", "address": f"file://{folder}/posts.git#one", "description": "Round posts"}]}))
    for path in (folder / "posts.git", git_index):
        git(path, "init", "-q", "."); git(path, "add", "."); git(path, "commit", "-qm", "one"); git(path, "tag", "one")
    expect(reasons, "search by git", run(home, "search", "ROUND", "--index", f"file://{git_index}", **kept), 0, f"posts: Round posts (file://{folder}/posts.git#one)")
    expect(reasons, "add by git", run(home, "add", "posts", VS_PACKAGE_INDEX=f"{git_index}#one", **kept), 0, "posts")
    lock = json.loads((home / "vs.lock").read_text())["packages"][0]
    if lock["source"] != f"file://{folder}/posts.git#one" or lock["commit"] != git(folder / "posts.git", "rev-parse", "HEAD"): reasons.append(f"the lock: {lock}")
    expect(reasons, "no git", run(home, "search", "--index", f"file://{git_index}", PATH="/none", **kept), 3, "git is missing")
    if run(home, "search", "--index", f"file://{folder}/none.git", **kept).returncode != 3: reasons.append("no repository")
    (git_index / "vs-index.json").write_text(json.dumps({"schema": 1, "packages": [{"name": "etc", "address": "/etc"}]}))
    git(git_index, "commit", "-qam", "two")
    expect(reasons, "a folder in an index by git", run(home, "search", "--index", f"file://{git_index}", **kept), 2, "only packages by git")
    if any((folder / "temporary").iterdir()): reasons.append("a fetched index remains")
    return reasons

for test in (new, folders, refused, by_git, index):
    name = "desk/packages:" + test.__name__
    if only and only not in name: continue
    try: reasons = test()
    except Exception as e: reasons = [repr(e)]
    if reasons is None: continue
    print(f"not ok {name}" if reasons else f"ok {name}")
    for reason in reasons[:8]: print("    " + str(reason)[:900])
