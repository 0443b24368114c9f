/* Owns what is read off a solid's mesh: its section with a plane, its shadow on one, its feature edges. */
#ifndef VS_SOLIDS_SECTIONS_H
#define VS_SOLIDS_SECTIONS_H

#include "geometry/plane/outline.h"
#include "model/mesh.h"

/* The section of a closed mesh with the plane through point: what the plane cuts, and faces that lie in it. o has no
 * loops where there is none. */
bool vs_mesh_section(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e);
/* The shadow that a closed mesh casts along the normal on the plane */
bool vs_mesh_shadow(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e);

/* Edges where faces meet at more than 30 degrees, and borders, put together to polylines that end where three or more
 * meet or a corner turns by more than that. */
typedef struct { vs_polyline *at; size_t count, room; } vs_polylines;
bool vs_mesh_edges(const vs_mesh *m, vs_polylines *out, vs_error *e); /* equal points count as one vertex */

#endif
