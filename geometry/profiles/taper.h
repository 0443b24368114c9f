/* Declares, for use in geometry/ alone, extrusions with inclined walls. */
#ifndef VS_GEOMETRY_PROFILES_TAPER_H
#define VS_GEOMETRY_PROFILES_TAPER_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Appends the mesh of an extrusion with a taper: its walls are plane until they vanish; closed and oriented. */
bool vs_taper_mesh(const vs_node *extrude, const vs_fineness *f, vs_mesh *out, vs_error *e);
/* Does the same along the vector `way`, in place of the node's own vector. taper_path.c: along a bent curve, the second
 * child. */
bool vs_taper_straight(const vs_node *extrude, vs_vec3 way, const vs_fineness *f, vs_mesh *out, vs_error *e);

#endif
