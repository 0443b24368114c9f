"""Owns the proof that the Python package runs models, hands over meshes, holds a scene, and turns every fault into an
exception. Its lines are the test's."""
import math

import numpy
from visualscheme import Scheme, SchemeError

failures = 0


def check(what, holds):
    global failures
    failures += not holds
    print(("ok" if holds else "not ok") + " embed:python " + what)


def raises(function, text):
    try:
        function()
    except SchemeError as error:
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
raise SystemExit(failures != 0)
