/* Owns, for geometry/ alone, the superellipsoid (|x/s|^(2/e) + |y/s|^(2/e))^(e/n) + |z/s|^(2/n) = 1: its triangles and its formulas. */
#ifndef VS_GEOMETRY_SUPERELLIPSOID_H
#define VS_GEOMETRY_SUPERELLIPSOID_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

bool vs_superellipsoid_mesh(vs_mesh *out, const struct vs_superellipsoid *s, const vs_facets *f); /* false: out of memory */
bool vs_superellipsoid_holds(const struct vs_superellipsoid *s, vs_vec3 p);
double vs_superellipsoid_reach(const struct vs_superellipsoid *s, vs_vec3 direction); /* the greatest direction . p over it */
double vs_superellipsoid_volume(const struct vs_superellipsoid *s);
double vs_superellipsoid_area(const struct vs_superellipsoid *s); /* by quadrature, to some ten digits */

#endif
