"""Owns the proof that the Python package runs models, hands over meshes, holds a scene, and turns every fault into an
exception. Its lines are the test's."""
import contextlib
import io
import math
import os
import signal
import subprocess
import sys
import threading
import unicodedata
from fractions import Fraction

import numpy
from visualscheme import Scheme, SchemeError, Symbol, Vector

failures = 0


def check(what, holds):
    global failures
    failures += not holds
    print(("ok" if holds else "not ok") + " embed:python " + what)


def raises(function, text, kind=SchemeError):
    try:
        function()
    except kind as error:
        return text in str(error)
    return False


def volume(mesh):
    """By the divergence theorem, over all places."""
    total = 0
    for place in mesh.places:
        corners = (mesh.points @ place[:, :3].T + place[:, 3])[mesh.triangles]
        total += abs(numpy.einsum("ij,ij->i", corners[:, 0], numpy.cross(corners[:, 1], corners[:, 2])).sum() / 6)
    return total


said = []
with Scheme(output=said.append) as s:
    s.run('(display "hello") (define (area a b) (* a b)) (define here (xyz 1 2 3))')
    check("output", said == ["hello"])
    check("a call", s["area"](3, 4.5) == 13.5 and s.call("area", 2, 3) == 6)
    there = [1, "two", True, [4]]
    check("values", numpy.array_equal(s["here"], [1, 2, 3]) and s.call("list", *there) == there)
    check("an error has its place", raises(lambda: s.run("(+ 1 1)\n(car 5)", "model.vs"), "model.vs:2:1: car"))
    check("an unknown name", raises(lambda: s["no-such-name"], "not defined"))
    s["weight"] = lambda v: v * 7.85
    s.run("(define w (weight 2))")
    check("the value of a text", s.value("(define n 6) (* n 7)") == 42 and s.value("(list 1/2 \"a\" (expt 10 30))") == [
        Fraction(1, 2), "a", 10 ** 30])
    check("an error of a value", raises(lambda: s.value("1 (car 5)"), "car"))
    check("a procedure of Python's", abs(s["w"] - 15.7) < 1e-12)
    s["broken"] = lambda: 1 / 0
    check("Python's error is the program's", raises(lambda: s.run("(broken)"), "broken: division by zero"))
    check("an empty drawing", raises(s.meshes, "nothing is drawn"))

    s.run("(draw (with-material 'gold (make-sphere (xyz 0 0 0) 1)))")
    ball, = s.meshes()
    check("a mesh", ball.change == "added" and ball.points.shape[1] == 3 and ball.triangles.dtype == numpy.uint32)
    check("its volume", abs(volume(ball) / (4 * math.pi / 3) - 1) < 0.01)
    check("its normals", numpy.allclose(numpy.linalg.norm(ball.normals, axis=1), 1) and
          ball.normal_corners.shape == ball.triangles.shape)
    paint = ball.parts[0]
    check("its paint and origin", (paint.material, paint.file, paint.line) == ("gold", "python", 1))
    asked = []
    s.forget_meshes()
    s.materials(lambda name: asked.append(name) or 77)
    again, = s.meshes(segments=12)
    check("materials by their numbers", again.parts[0].material_id == 77 and asked == ["gold"])
    check("coarser", again.change == "added" and len(again.points) < len(ball.points))
    s.meshes()
    check("nothing changed", s.meshes() == [])
    s.clear()  # what is round is made anew where the drawing's size changes how fine that is
    s.run("(define part (subtract (make-box (xyz 0 0 0) (xyz 4 4 4)) (make-box (xyz 1 1 2) (xyz 3 3 5))))")
    rows = [s.node("row%d" % i, s.root, s["part"], translate=(10 * i, 0, 0)) for i in range(3)]
    parts, = [m for m in s.meshes() if len(m.places) == 3]
    check("one shape in three places", parts.places.shape == (3, 3, 4) and abs(volume(parts) - 3 * 56) < 1e-9)
    s.place(rows[2], translate=(0, 0, 50))
    moved, = s.meshes()
    check("moved", (moved.change, moved.id, len(moved.points), moved.places[2, 2, 3]) == ("changed", parts.id, 0, 50))
    hits = s.pick((10.5, 0.5, 100), (0, 0, -1))
    check("picked", len(hits) == 1 and hits[0].node == rows[1] and hits[0].distance == 96)
    check("its path", [s.name(n) for n in hits[0].path] == ["root", "row1"])
    check("a matrix", s.matrix(rows[1])[0, 3] == 10 and s.find("row1") == rows[1] and s.find("none") is None)

    heard = []
    s.put(rows[0], "width", 4)
    s.subscribe(rows[0], "width", heard.append)
    for width in range(5, 1005):
        s.post(rows[0], "width", width)
    s.update()
    s.put(rows[0], "width", 1004)
    check("1,000 changes, each told once", heard == list(range(5, 1005)) and s.get(rows[0], "width") == 1004)
    check("misuse", raises(lambda: s.call("node-addchild", rows[0], rows[0]), "cannot hang below itself"))
    s.write("out.stl")
    check("a file", len(open("out.stl", "rb").read()) > 84)
    for row in rows:
        s.draw(row, [])
    gone = s.meshes()
    check("removed", len(gone) == 1 and all(m.change == "removed" and not len(m.places) for m in gone))

with Scheme(limit_steps=10000) as s:
    check("limits", raises(lambda: s.run("(let loop () (loop))"), "the limit"))

# the tree, its events, focus, programs of nodes
with Scheme() as s:
    told = []
    for event in ("Node.create", "Node.addChild"):
        number = s.subscribe(s.controller, event, lambda node, event=event: told.append(event))
    shelf, lamp = s.node("shelf"), s.node("lamp")
    s.add(s.root, shelf)
    s.add(shelf, lamp)
    check("events", told == ["Node.create", "Node.create", "Node.addChild", "Node.addChild"])
    s.unsubscribe(s.controller, "Node.addChild", number)
    s.remove(shelf, lamp)
    s.add(shelf, lamp)
    check("unsubscribed", len(told) == 4)
    check("the tree", s.parent(lamp) == shelf and s.children(shelf) == [lamp] and s.parent(s.root) is None and
          s.name(lamp) == "lamp")
    check("a loop is refused", raises(lambda: s.add(lamp, shelf), "cannot hang below itself"))
    with s.within(lamp):
        check("the focus", s.focus == lamp)
        s.run("(draw (make-box (xyz 0 0 0) (xyz 1 2 3)))")
    check("the root again", s.focus == s.root and s.call("volume", s.object(shelf)) == 6)
    check("a program of its own", s.run_in(lamp, "(define height 7) (+ height 1)") == 8 and
          raises(lambda: s["height"], "not defined"))
    s.run("(define turned 0) (node-on (node-find \"lamp\") 'turn (lambda (node) (set! turned (+ 1 turned))))")
    s.action("turn", s.root)
    check("an action", s["turned"] == 1)
    check("a summary", s.summary()["solids"] == 1 and s.summary()["bounds"][1][2] == 3)

    # gizmos: set, dragged, followed
    s.run("(define width (make-slider (xyz 0 0 50) (xyz 10 0 50) 0 20 #:value 8 #:step 2 #:size 1 #:name \"width\""
          "                           #:parent (node-getroot)))"
          "(make-tripod (xyz 0 90 0) (vxyz 1 0 2) #:parent (node-getroot))")
    slider, tripod = s.gizmos()
    check("a slider's data", slider[1] == "slider" and slider[4:8] == (8, 0, 20, 2) and
          numpy.array_equal(slider.handles, [[4, 0, 50]]) and numpy.array_equal(slider.axes, [[10, 0, 0]]))
    check("a tripod's data", tripod.kind == "tripod" and numpy.array_equal(tripod.high, [1, 0, 2]) and
          tripod.axes.shape == (2, 3))
    moves, down = [], (0, 0, -1)
    s.subscribe(slider.node, "value", moves.append)
    check("taken hold of", s.input("press", "left", (4, 0, 99), down) == slider.node)
    s.input("drag", "left", (8.6, 0, 99), down)
    s.input("release", "left", (8.6, 0, 99), down)
    s.put(slider.node, "value", 4)
    check("dragged in steps, and put", moves == [18, 4] and s.gizmos()[0].value == 4)
    check("out of range", raises(lambda: s.put(slider.node, "value", 3), "from 0 to 20 by steps of 2"))
    check("no such event", raises(lambda: s.input("wink"), "an event is one of"))
    s.run("(define key #f) (node-on (node-getroot) 'key (lambda (node k) (set! key k)))")
    check("a key", s.input("key", key="g") == s.root and s["key"] == "g" and s.input("move") is None)

# parameters, files as bytes, statistics, and values after their program has ended
with Scheme() as s:
    s.parameter("n", 5)
    s.parameter("nobody", True)
    text = ('(define-parameter n 3 #:min 1 #:max 9 #:label "how many")'
            " (define-parameter kind 'thin #:choices '(thin thick))"
            " (draw (make-box (xyz 0 0 0) (xyz n 1 1)))")
    s.run(text)
    n, kind = s.parameters()
    check("parameters", n[:8] == ("n", "how many", "", "integer", "5", "3", 1, 9) and
          kind.choices == ["thin", "thick"] and s.unused_parameters() == ["nobody"])
    check("a file as bytes", len(s.bytes("stl")) == 84 + 12 * 50 and b"make-box" not in s.bytes("obj"))
    check("no such format", raises(lambda: s.bytes("nothing"), "nothing"))
    held = s["n"], s["+"]
    s.parameter("n", None)
    s.restart()
    check("a value from before", raises(lambda: held[1](1, 2), "vs_restart"))
    s.run(text)
    check("restarted", s["n"] == 3 and s.summary()["bounds"][1][0] == 3)
    check("statistics", s.statistics()["objects.drawn"] == (1, "") and s.statistics()["time.total"][1] == "s")
    gold, = s.call("list", Symbol("gold"))
    check("a symbol", gold == "gold" and isinstance(gold, Symbol))

    # an error has its calls; Ctrl-C stops a program; a function that it calls may not call back
    try:
        s.run("(define (f x)\n  (+ 1 (car x)))\n(f 5)", "m.vs")
    except SchemeError as error:
        calls = any("m.vs:3:1" in note for note in error.notes)
        check("an error has its calls", (error.line, error.column) == (2, 8) and calls)
    threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
    try:
        s.run("(let loop () (loop))")
        check("Ctrl-C", False)
    except KeyboardInterrupt:
        check("Ctrl-C", s.call("+", 1, 2) == 3)
    try:
        s.call("make-sphere", numpy.zeros(3), "wide")
    except SchemeError as error:
        check("a call from outside stands in no text", error.file is None and "r must be" in error.message)
    s.run("(define up (vxyz 0 0 2)) (define turn (rotation-matrix 'z pi/2)) (define h (make-hash))")
    up, turn = s["up"], s["turn"]
    check("vectors stay vectors", isinstance(up, Vector) and s.call("vlength", up) == 2)
    check("vectors from arrays", s.call("vlength", Vector(numpy.array([0, 3, 4]))) == 5)
    check("matrices go back", numpy.allclose(s.call("matrix*", turn, turn), numpy.diag([-1, -1, 1, 1]), atol=1e-12))
    moved = numpy.ones(3) + up
    check("sums are points", not isinstance(moved, Vector) and numpy.array_equal(s.call("list", moved)[0], [1, 1, 3]))
    ball = s.call("make-sphere", numpy.zeros(3), 2)
    check("values are shown", repr(ball).startswith("<visualscheme.Value (make-sphere ") and "+" in repr(s["+"]))
    check("an array of no kind", raises(lambda: s.call("list", numpy.zeros(7)), "has no like", TypeError))
    s["again"] = lambda: s.run("(+ 1 2)")
    check("re-entry", raises(lambda: s.run("(again)"), "running"))
    s["end"] = s.close
    check("closed while at work", raises(lambda: s.run("(end)"), "running") and s.call("+", 1, 2) == 3)
check("closed", raises(lambda: s.run("1"), "was closed") and raises(lambda: held[1](1, 2), "was closed"))
with contextlib.redirect_stdout(io.StringIO()) as printed, Scheme() as s:
    s.run('(display "naïve – ") (display 1/3)')
check("what is printed", printed.getvalue() == "naïve – 1/3")


def count(text, results):
    with Scheme() as s:
        s.run(text)
        results.append(sum(len(m.triangles) for m in s.meshes()))


# ---- values pass unchanged, or not at all ----

def classes():
    """A character of each class of Unicode, and all controls."""
    found = {unicodedata.category(chr(i)): chr(i) for i in range(0x110000)}
    return [c for kind, c in sorted(found.items()) if kind != "Cs"] + [chr(i) for i in range(0xA0)] + ["\uFFFE", "\u2028"]


whole = sorted({sign * (2 ** k + d) for k in list(range(70)) + [1000] for d in (-1, 0, 1) for sign in (1, -1)})
whole += [10 ** 400, -10 ** 400, 10 ** 5000 + 7, -10 ** 20000 - 3]
broken = [Fraction(1, 3), Fraction(-2 ** 70, 3 ** 50), Fraction(10 ** 5000, 7), Fraction(10 ** 40 + 1, 10 ** 20)]
real = [0.0, -0.0, 1.0, -2.5, 2.0 ** 53, 1e308, 5e-324, math.inf, -math.inf, math.pi]
said = ["a%sb" % x for x in classes()] + ["", "\0", "\0\0a", "".join(classes())]
symbols = [Symbol("a%sb" % x) for x in classes() if x != "\0"]
every = whole + broken + real + said + symbols + [True, False, [], [[]], [1, [2.0, ["x", [Fraction(1, 2)]]]]]


def alike(a, b):
    if isinstance(a, list):
        return isinstance(b, list) and len(a) == len(b) and all(map(alike, a, b))
    return type(a) is type(b) and a == b and (not isinstance(a, float) or math.copysign(1, a) == math.copysign(1, b))


with Scheme(output=lambda text: None) as s:
    node, heard = s.node("n", s.root), []
    s["echo"] = lambda v: heard.append(v) or v
    wrong = []
    for v in every:
        s["held"] = v
        s.put(node, "value", v)
        ways = s.call("list", v)[0], s.call("echo", v), heard.pop(), s["held"], s.get(node, "value"), s.call("list", [v])[0][0]
        wrong += [v for way in ways if not alike(v, way)]
    check("values of every kind cross as they are", not wrong and len(every) > 700)
    check("not a number", math.isnan(s.call("+", math.nan, 1)))
    check("kinds of numbers", alike(s.call("+", 1, 2), 3) and alike(s.call("+", 1, 2.0), 3.0) and
          alike(s.call("/", 1, 3), Fraction(1, 3)) and alike(s.call("*", 2 ** 40, 2 ** 40), 2 ** 80) and
          alike(s.call("string->number", "1e3"), 1000.0) and s.call("exact?", numpy.int64(5)) is True)
    s.run("(define pair (cons 1 2)) (define open '(1 2 . 3)) (define ring (list 1 2)) (set-cdr! (cdr ring) ring)")
    check("pairs stay pairs", s.call("car", s["pair"]) == 1 and s.call("cdr", s["pair"]) == 2 and
          s.call("equal?", s["open"], s["open"]) is True and s.call("caddr", s["ring"]) == 1 and
          s.call("car", s.call("list", s["pair"])[0]) == 1)
    check("what does not fit raises", all(raises(lambda v=v: s.call("list", v), "", kind) for v, kind in (
        (None, TypeError), (1j, TypeError), ({}, TypeError), (b"x", TypeError), ("\ud800", UnicodeError),
        (Symbol("a\0b"), ValueError), (numpy.array([2 ** 53 + 1, 0, 0]), OverflowError),
        (numpy.array([Fraction(1, 3), 0, 0], object), OverflowError))))
    check("names with NUL raise", all(raises(f, "code 0", ValueError) for f in (
        lambda: s["+\0x"], lambda: s.call("+\0x"), lambda: s.run_file("a\0b"), lambda: s.find("n\0"), lambda: s.node("a\0b"),
        lambda: s.write("a\0.stl"), lambda: s.put(node, "a\0b", 1), lambda: s.parameter("a\0b", 1), lambda: s.parameter("a", "b\0"))))
    s["cries"] = lambda: (_ for _ in ()).throw(ValueError("a\0b\ud800c"))
    check("an error with NUL is told", raises(lambda: s.run("(cries)"), "a\\0b\\ud800c"))
    s.run("(define-parameter p 0)")
    for v in [x for x in whole + broken if abs(x) < 10 ** 900] + real:
        s.parameter("p", v)
        s.restart()
        s.run("(define-parameter p %s)" % ("0.5" if isinstance(v, float) else "0" if isinstance(v, int) else "1/2"))
        wrong += [v] if not alike(v, s["p"]) else []
    check("parameters take numbers as they are", not wrong and raises(lambda: s.parameter("p", [1]), "is no value", TypeError))

missing = subprocess.run([sys.executable, "-c", "import visualscheme\ntry: visualscheme.Scheme()\nexcept OSError as e: print(e)"],
                         env=dict(os.environ, VISUALSCHEME_LIBRARY="/nowhere/libvisualscheme.so"), capture_output=True, text=True)
check("a library that is missing is told", "/nowhere/libvisualscheme.so" in missing.stdout and
      "VISUALSCHEME_LIBRARY" in missing.stdout and not missing.stderr)
other = subprocess.run([sys.executable, "-c", "import visualscheme\ntry: visualscheme.Scheme()\nexcept OSError as e: print(e)"],
                       env=dict(os.environ, VISUALSCHEME_LIBRARY="libm.so.6"), capture_output=True, text=True)
check("a library of another version is told", "it has no vs_" in other.stdout and not other.stderr)

results = []
many = [threading.Thread(target=count, args=("(draw (make-sphere (xyz 0 0 0) 1))", results)) for _ in range(4)]
for t in many:
    t.start()
for t in many:
    t.join()
check("four interpreters in four threads", len(results) == 4 and len(set(results)) == 1)
raise SystemExit(failures != 0)
