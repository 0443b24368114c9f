# A notebook in cells (Jupyter, VS Code and Spyder read the marks): a parametric table, studied from Python.
# %%
import numpy
from visualscheme import Scheme

s = Scheme()
s.run_file(__file__.replace("notebook.py", "table.vs"))
print("nodes:", [s.name(n) for n in s.children(s.root)])

# %% How much wood is in it, by its slider?
slider = next(g for g in s.gizmos() if g.kind == "slider")
print("a slider from %g to %g, by steps of %g" % (slider.low, slider.high, slider.step))


def wood():
    return s.call("volume", s.object(s.find("table")))


for value in numpy.linspace(slider.low, slider.high, 6):
    s.put(slider.node, "value", value)
    print("%5.2f m: %.4f m3" % (value, wood()))


# %% Its meshes, as arrays: the same volume by the divergence theorem
def volume(mesh):
    corners = mesh.points[mesh.triangles]
    once = numpy.einsum("ij,ij->i", corners[:, 0], numpy.cross(corners[:, 1], corners[:, 2])).sum() / 6
    return sum(abs(once * numpy.linalg.det(place[:, :3])) for place in mesh.places)


meshes = s.meshes()
print("%d meshes at %d places, %.4f m3" % (len(meshes), sum(len(m.places) for m in meshes), sum(map(volume, meshes))))
print("of everything: %.4f m3" % s.call("volume", s.object(s.root)))

# %% The points that rays from above meet
for hit in s.pick((0, 0, 9), (0, 0, -1)):
    print("%s at %.2f m, made at line %d" % (s.name(hit.node), hit.point[2], hit.line))

# %% A mistake reports its place
try:
    s.run("(draw (make-spere (xyz 0 0 0) 1))", name="cell")
except Exception as error:
    print(error)
s.close()
