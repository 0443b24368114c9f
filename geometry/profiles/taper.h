/* Owns, for geometry/ alone, extrusions whose walls lean. */
#ifndef VS_GEOMETRY_PROFILES_TAPER_H
#define VS_GEOMETRY_PROFILES_TAPER_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Appends the mesh of an extrusion with a taper: plane walls as far as they go, closed and oriented. */
bool vs_taper_mesh(const vs_node *extrude, const vs_fineness *f, vs_mesh *out, vs_error *e);
/* Its parts: along a vector in the place of the node's own; along a bent curve, the second child (taper_path.c). */
bool vs_taper_straight(const vs_node *extrude, vs_vec3 way, const vs_fineness *f, vs_mesh *out, vs_error *e);

#endif
