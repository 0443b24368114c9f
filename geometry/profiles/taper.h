/* Owns, for geometry/ alone, extrusions whose walls lean. */
#ifndef VS_GEOMETRY_TAPER_H
#define VS_GEOMETRY_TAPER_H

#include "geometry/tessellate.h"

/* Appends the mesh of an extrusion with a taper: plane walls as far as they go, closed and oriented. */
bool vs_taper_mesh(const vs_node *extrude, const vs_facets *f, vs_mesh *out, vs_error *e);

#endif
