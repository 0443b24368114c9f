/* Declares extrusions with inclined walls (a taper), for use in geometry/ alone. */
#ifndef VS_GEOMETRY_PROFILES_TAPER_H
#define VS_GEOMETRY_PROFILES_TAPER_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Appends the mesh of an extrusion with inclined walls. Each wall is planar up to the height where it vanishes. The
 * mesh is closed and oriented. Returns false and sets e on failure. */
bool vs_taper_mesh(const vs_node *extrude, const vs_fineness *f, vs_mesh *out, vs_error *e);
/* Appends the mesh of an extrusion with inclined walls in the direction and length of `way`, instead of the node's own.
 * taper_path.c needs it for extrusions along a bent curve. Returns false and sets e on failure. */
bool vs_taper_straight(const vs_node *extrude, vs_vec3 way, const vs_fineness *f, vs_mesh *out, vs_error *e);

#endif
