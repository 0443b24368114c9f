"""Owns the models that are full of unusual characters, and what is asked of the files that come of them.

texts.py VS FOLDER [ONLY]. A format that is new in backends.def is written and must be text that a reader of lines understands; `readers` has what is
asked of formats beyond that: each text comes back whole, or with U+FFFD or a blank where the format holds no such character."""
import json, os, re, shutil, struct, subprocess, sys, unicodedata, zipfile
from html.parser import HTMLParser
from xml.etree import ElementTree

vs, folder, only = sys.argv[1], sys.argv[2], sys.argv[3] if len(sys.argv) > 3 else ""
top = os.getcwd()


def result(name, reasons):
    name = "texts/" + name
    if only and only not in name:
        return
    print(("not ok " if reasons else "ok ") + name)
    for reason in reasons[:12]:
        print("    " + ascii(reason)[1:-1][:300])


# ---- the characters ----

def noncharacter(c):
    return c & 0xFFFE == 0xFFFE or 0xFDD0 <= c < 0xFDF0


def control(c):
    return c < 0x20 or 0x7F <= c < 0xA0 or noncharacter(c)


def characters():
    """The first and the last character of each class, all that end lines, all controls, and what programs are known to trip over."""
    first, last = {}, {}
    for c in range(1, 0x110000):
        kind = unicodedata.category(chr(c))
        if kind == "Cs":  # surrogates are no characters: Scheme and UTF-8 have none
            continue
        if noncharacter(c):
            kind = "noncharacter of plane %d" % (c >> 16)
        first.setdefault(kind, c)
        last[kind] = c
    chosen = set(first.values()) | set(last.values()) | set(range(1, 0x20)) | set(range(0x7F, 0xA0))
    chosen |= {ord(c) for c in "\"'\\<>&%#${}()[]|;/*^`,-?:@!=+~. 0aZ_éß漢"} | {0x2028, 0x2029, 0xFEFF, 0x200B, 0x200E, 0x202E, 0xFFFD, 0x1F600, 0xD7FF, 0xE000}
    return sorted(chosen)


chosen = characters()
# A marker around each character: the test finds texts by it, and a character that escapes its string makes the marker a
# call.
texts = ["a%shack(%d)" % (chr(c), c) for c in chosen]


def scheme(text):
    return '"' + "".join("\\x%x;" % ord(c) if control(ord(c)) or c in '"\\' or ord(c) > 0x7E else c for c in text) + '"'


def same(got, text):
    """Has the text come back, with U+FFFD or a blank at most for what is no character or ends a line?"""
    return len(got) == len(text) and all(g == c or (g in "\uFFFD " and (control(ord(c)) or c in "\u2028\u2029")) for g, c in zip(got, text))


def run(*words, **more):
    done = subprocess.run([vs, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, **more)
    return done.returncode, done.stdout, done.stderr


# ---- the formats ----

def formats():
    """Suffix, name and whether it is binary, of each format that needs no worker."""
    for line in open(top + "/backends/backends.def", encoding="utf-8"):
        row = re.match(r'VS_(FORMAT|NOTATION)\((\w+), \w+, "([^"]+)", (NULL|"[^"]*"), (true|false),', line)
        if row and row[4] == "NULL":
            yield row[2], row[3], row[5] == "true"


LINE_ENDS = re.compile("\r\n|[\n\v\f\r\x1c-\x1e\x85\u2028\u2029]")


def lost(wanted, got, what):
    """The texts that did not come back."""
    got = set(got)
    return ["%s: %a is not there" % (what, text) for text in wanted if text not in got and not any(same(g, text) for g in got)]


# A label is a text for each of its lines.
def lines_of(labels):
    return [line for t in labels for line in t.split("\n")]


def xml_texts(data):
    root = ElementTree.fromstring(data)
    return [v for e in root.iter() for v in [e.text or "", e.tail or "", *e.attrib.values()]]


def read_svg(path, data):
    return lost(lines_of(texts), [t for t in xml_texts(data)], "svg") if "labels" in path else []


def read_x3d(path, data):
    xml_texts(data)
    return []


def read_3mf(path, data):
    with zipfile.ZipFile(path) as z:
        got = [t for n in z.namelist() if n.endswith((".model", ".rels", ".xml")) for t in xml_texts(z.read(n))]
    return lost(texts, got, "3mf") if "materials" in path else []


def read_glb(path, data):
    length, = struct.unpack_from("<I", data, 12)
    scene = json.loads(data[20:20 + length].decode())
    want = {"materials": scene["materials"], "layers": scene["nodes"]}
    got = [row.get("name", "") for row in next((rows for kind, rows in want.items() if kind in path), [])]
    return ["glb: %a is not there" % t for t in texts if got and t not in got]


def read_html(path, data):
    seen = []

    class Reader(HTMLParser):
        def handle_starttag(self, tag, attributes):
            seen.append(tag)
    Reader().feed(data.decode())
    return [] if seen.count("title") == 1 and seen.count("canvas") <= 1 else ["html: its tags are %s" % seen[:20]]


def read_dxf(path, data):
    lines = data.decode("ascii").split("\n")
    if len(lines) % 2 == 0 or any(not re.fullmatch(r" *\d+", code) for code in lines[:-1:2]):
        return ["dxf: its lines are no pairs of code and value"]
    got = [re.sub(r"\\U\+([0-9A-F]{4})", lambda m: chr(int(m[1], 16)), t).replace("^ ", "^") for t in lines[1::2]]
    want = [t for t in texts if ord(t[1]) < 0x10000]  # four digits
    return lost(lines_of(want), got, "dxf") if "labels" in path else []


def read_tree(path, data):
    strings = [re.sub(r"\\(.)", lambda m: {"n": "\n"}.get(m[1], m[1]), s, flags=re.S)
               for s in re.findall(r'"((?:[^"\\]|\\.)*)"', data.decode(), re.S)]
    return ["tree: %a is not there" % t for t in texts if ("materials" in path or "layers" in path) and t not in strings]


def read_obj(path, data):
    reasons = []
    for line in LINE_ENDS.split(data.decode()):
        words = line.split()
        if words and words[0] not in ("#", "v", "vt", "vn", "f", "l", "g", "usemtl", "mtllib"):
            reasons.append("obj: a line begins with " + words[0])
        if words and words[0] in ("g", "usemtl") and len(words) != 2:
            reasons.append("obj: %a is not one word" % line)
        if words and words[0] == "mtllib" and not os.path.exists(os.path.join(os.path.dirname(path), line[7:])):
            reasons.append("obj: there is no %a" % line)
    return reasons


readers = {"svg": read_svg, "x3d": read_x3d, "3mf": read_3mf, "glb": read_glb, "html": read_html, "dxf": read_dxf, "tree": read_tree, "obj": read_obj}


def judge(path, name, binary):
    """Reasons why the file is not what its format says."""
    data = open(path, "rb").read()
    reasons = []
    if not data:
        reasons.append(name + ": nothing is in it")
    if not binary:
        try:
            text = data.decode()
        except UnicodeDecodeError as e:
            return ["%s: %s" % (name, e)]
        odd = {c for c in text if control(ord(c)) and c not in "\t\n"} | ({"\u2028", "\u2029"} & set(text) if name not in ("svg", "x3d", "html", "tree") else set())
        if odd and name != "tree":  # which is read back by its own reader, and keeps texts as they are
            reasons.append("%s: holds %a" % (name, sorted(odd)))
        for line in LINE_ENDS.split(text) if name in ("povray", "openscad") else []:
            if "hack(" in line and not re.match(r'[^"]*//|.*"', line):
                reasons.append("%s: %a is code" % (name, line))
    if not reasons and name in readers:
        try:
            reasons += readers[name](path, data)
        except Exception as e:
            reasons.append("%s: cannot be read: %s" % (name, e))
    return reasons


def model(kind):
    box = "(make-box (xyz %d 0 0) (xyz %d.5 1 1))"
    lines = []
    for i, t in enumerate(texts):
        if kind == "materials":
            lines.append("(draw (with-material (make-material #:name %s #:color \"#%06x\") %s))" % (scheme(t), i * 997, box % (i, i)))
        elif kind == "layers":
            lines.append("(draw (layer %s %s))" % (scheme(t), box % (i, i)))
        else:
            lines.append("(label (xyz %d 0 0) %s)" % (i, scheme(t)))
    if kind == "labels":
        lines.append("(draw (make-box (xyz -1 -1 0) (xyz %d 1 1)))" % len(texts))
        lines += ["(level %d %s)" % (i, scheme(t)) for i, t in enumerate(texts)] + ["(view \"front\" 'front)"]
    return "\n".join(lines) + "\n"


def format_tests():
    all_formats = list(formats())
    for kind in ("materials", "layers", "labels"):
        source = "%s/%s.vs" % (folder, kind)
        open(source, "w", encoding="utf-8").write(model(kind))
        for suffix, name, binary in all_formats:
            out = "%s/%s-%s.%s" % (folder, kind, name, suffix)
            code, _, err = run("-q", source, "-o", out, "--format", name)
            result("%s: %s" % (name, kind), judge(out, name, binary) if code == 0 else ["ends with %d: %s" % (code, err.decode(errors="replace"))])
    # The sheet contains names of views, too. They contain no control character and no /, since they are names of files.
    views = [t for t in texts if not (ord(t[1]) < 0x20 or ord(t[1]) == 0x7F or t[1] == "/")]
    for i in range(0, len(views), 32):
        with open(folder + "/views.vs", "w", encoding="utf-8") as f:
            f.write("(draw (make-box (xyz 0 0 0) (xyz 1 1 1)))\n" + "".join("(view %s 'plan)\n" % scheme(v) for v in views[i:i + 32]))
        for suffix, name, binary in all_formats:
            if suffix in ("svg", "dxf", "pdf"):
                out = "%s/views-%s.%s" % (folder, name, suffix)
                code, _, err = run("-q", folder + "/views.vs", "-o", out)
                reasons = judge(out, name, binary) if code == 0 else ["ends with %d: %s" % (code, err.decode(errors="replace"))]
                if i == 0 or reasons:
                    result("%s: views from %d on" % (name, i), reasons)


# ---- names of files ----

def file_names():
    """Names of files as bytes: one for every character that a name can hold, in a few names, and bytes that are no UTF-8."""
    fit = [chr(c) for c in chosen if chr(c) not in "/"]
    for i in range(0, len(fit), 12):
        yield "".join(fit[i:i + 12]).lstrip("-.").encode()
    yield b"\xff\xfe"
    yield b"a\xc3"
    yield b"\xed\xa0\x80"      # a surrogate
    yield b"\xc0\xaf\xf5\x80"  # too long, and past the end
    yield b"caf\xe9"           # Latin-1


def file_tests():
    model = b"(draw (layer \"a\" (make-box (xyz 0 0 0) (xyz 1 1 1)))) (label (xyz 0 0 0) \"x\")\n"
    reasons = {}
    for n, name in enumerate(file_names()):
        place = os.path.join(folder.encode(), b"names%d" % n)
        os.mkdir(place)
        source = os.path.join(place, name + b".vs")
        open(source, "wb").write(model)
        for suffix, kind, binary in formats():
            out = os.path.join(place, name + b"." + suffix.encode())
            code, _, err = run(b"-q", b"--format", kind.encode(), b"-o", out, b"--", source)
            why = judge(os.fsdecode(out), kind, binary) if code == 0 else ["ends with %d: %s" % (code, err.decode(errors="replace"))]
            reasons.setdefault(kind, []).extend("%a: %s" % (name, w) for w in why)
        for title, words in (("check --json", ["check", "--json"]), ("ast --json", ["ast", "--json"]), ("ast --xml", ["ast", "--xml"]), ("--stats=json", ["-q", "--stats=json", "-o", "-", "--format", "tree"])):
            code, out, err = run(*words, source)
            data = err if "stats" in title else out
            why = []
            try:
                xml_texts(data) if "xml" in title else json.loads(data.decode())
            except Exception as e:
                why = ["%a: ends with %d, and %s" % (name, code, e)]
            reasons.setdefault(title, []).extend(why)
    for kind, why in reasons.items():
        result("names of files: " + kind, why)


# ---- vs translate ----

def targets():
    return re.findall(r'^TR_TARGET\("(\w+)"', open(top + "/languages/targets/translate_targets.def", encoding="utf-8").read(), re.M)


def judged_by(target, path, text):
    """What the language's own program says of the text."""
    words = {"javascript": ["node", "--check", path], "openscad": ["openscad", "-o", path + ".off", path],
             "povray": ["povray", "+I" + path, "-D", "+W4", "+H4", "-F", "-GA"]}.get(target)
    if not words or not shutil.which(words[0]):
        return []
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=folder)
    return ["%s ends with %d: %s" % (words[0], done.returncode, done.stdout.decode(errors="replace")[-600:])] if done.returncode else []


def translated_texts(text):
    """The texts of the program's variables t0, t1 ..., as scripts read them."""
    said = re.findall(r'^(?:const|let) t\d+ = ("(?:[^"\\]|\\.)*");', text, re.M)
    done = subprocess.run(["node", "-e", "process.stdout.write(JSON.stringify([%s]))" % ",".join(said)], stdout=subprocess.PIPE)
    return json.loads(done.stdout.decode("utf-8", "surrogatepass"))


def translate_tests():
    lines = []
    for i, t in enumerate(texts):
        c = t[1]
        if c not in "\n\r":
            lines += ["; " + t]
        lines += ["#| %s |#" % t if c != "|" and c != "#" else "", "(define t%d %s)" % (i, scheme(t))]
        lines += ["(define n%d %d)%s" % (i, i, " ; " + t if c not in "\n\r" else "")]
        lines += ["(define (f%d x) %s x)" % (i, "#| %s |#" % t if c not in "|#" else "")]
        name = unicodedata.category(c)
        if name[0] in "LMNSPC" and ord(c) > 0x9F and c not in "\u200b\ufeff":
            lines += ["(define a%sz%d %d)" % (c, i, i)]
        lines += ["(define-parameter p%d %d #:min 0 #:max 999 #:label %s)" % (i, i, scheme(t))]
        # unescaped: the string spans lines
        if c not in '"\\':
            lines += ['(define-parameter q%d %d #:min 0 #:max 999 #:label "%s")' % (i, i, t)]
    lines += ["(draw (make-sphere (xyz 0 0 0) n3))"]
    source = folder + "/program.vs"
    open(source, "w", encoding="utf-8", newline="").write("\n".join(lines) + "\n")
    for target in targets():
        path = "%s/program.%s" % (folder, {"javascript": "mjs", "openscad": "scad", "povray": "pov"}.get(target, target))
        code, out, err = run("translate", source, "--to", target)
        reasons = [] if code == 0 else ["ends with %d: %s" % (code, err.decode(errors="replace"))]
        open(path, "wb").write(out)
        try:
            text = out.decode()
        except UnicodeDecodeError as e:
            text, reasons = "", reasons + [str(e)]
        odd = {c for c in text if control(ord(c)) and c != "\n" and ord(c) < 0x10000} | {"\u2028", "\u2029"} & set(text)
        if odd:
            reasons.append("holds %a" % sorted(odd))
        for line in LINE_ENDS.split(text):
            if "hack(" in line and not re.match(r'[^"]*//|.*"', line):
                reasons.append("%a is code" % line)
        if text.count("hack(") < 4 * len(texts):
            reasons.append("only %d texts are left" % text.count("hack("))
        if target == "javascript" and shutil.which("node") and not reasons:
            reasons += ["%a became %a" % pair for pair in zip(texts, translated_texts(text)) if pair[0] != pair[1]]
        result("translate to " + target, reasons + (judged_by(target, path, text) if not reasons else []))
    # Characters that no text of these languages can hold are refused with a message, never dropped.
    open(source, "w", encoding="utf-8").write('(define t "a\\x0;b")\n(draw (make-sphere origin 1))\n')
    for target in targets():
        code, out, err = run("translate", source, "--to", target)
        result("translate to %s: NUL" % target, [] if code == 1 and b"program.vs:1:11: " in err else ["ends with %d: %s" % (code, err)])


def message_tests():
    """No program is run by what only reads it, and no message is empty."""
    source = folder + "/mark.vs"
    reasons = []
    for c in chosen:
        if c in (0x0A, 0x0D):
            continue
        open(source, "w", encoding="utf-8", newline="").write("(define t \"%s\")\n(display \"was run\")\n(draw (make-sphere origin 1))\n" % (chr(c) if chr(c) not in '"\\' else "x"))
        for words in (["check"], ["ast"], ["translate", "--to", "javascript"]):
            code, out, err = run(*words, source)
            if b"was run" in out and words[0] == "check" or b"vs: -" in err or (code and not err and not out):
                reasons.append("%s with U+%04X ends with %d: %s %s" % (words[0], c, code, out[:60], err))
    result("check, ast, translate: one line of a program", reasons)


format_tests()
file_tests()
translate_tests()
message_tests()
