# The gyroid of gyroid.vs by scikit-image's marching cubes, on a grid that NumPy computes; fewer than 2 cells: imports
# only.
import sys
import numpy
from skimage.measure import marching_cubes
cells = int(sys.argv[1])
if cells > 1:
    step = 2 * numpy.pi / cells
    x = numpy.linspace(-step, 2 * numpy.pi + step, cells + 3)  # a layer around the box, which closes the surface at its sides
    x, y, z = x[:, None, None], x[None, :, None], x[None, None, :]
    value = numpy.sin(x) * numpy.cos(y) + numpy.sin(y) * numpy.cos(z) + numpy.sin(z) * numpy.cos(x)
    for a in (x, y, z):
        value = numpy.maximum(value, numpy.maximum(-a, a - 2 * numpy.pi))
    points, faces, _, _ = marching_cubes(value, 0, spacing=(step,) * 3, gradient_direction='descent')
    p = points[faces].astype(float)
    volume = numpy.einsum('ij,ij->i', p[:, 0], numpy.cross(p[:, 1], p[:, 2])).sum() / 6
    print(len(faces), abs(volume))
