/* Declares results that require a solid's mesh: its section with a plane, its shadow on a plane, its feature edges. */
#ifndef VS_SOLIDS_SECTIONS_H
#define VS_SOLIDS_SECTIONS_H

#include "geometry/plane/outline.h"
#include "model/mesh.h"

/* Computes the section of a closed mesh with the plane through `point`. It consists of the cut, and of the faces that
 * lie in the plane. If the section is empty, o has no loops. */
bool vs_mesh_section(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e);
/* Computes the shadow that a closed mesh casts along the normal on the plane. */
bool vs_mesh_shadow(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e);

/* Computes the outline of a mesh whose triangles lie in one plane. Turns triangles of m that face backwards. Fails with
 * a specific message if the mesh deviates from every plane by more than 1e-6 of its size. If the area is 0, o has no
 * loops. */
bool vs_mesh_flat_outline(vs_mesh *m, vs_outline *o, vs_error *e);

/* Finds the edges where the directions of two faces differ by more than 30 degrees, and the borders of the mesh. Joins
 * them to polylines. A polyline ends where three or more edges meet, or where the direction changes by more than 30
 * degrees. */
typedef struct { vs_polyline *at; size_t count, room; } vs_polylines;
bool vs_mesh_edges(const vs_mesh *m, vs_polylines *out, vs_error *e); /* finds the edges of m; equal points count as a
                                                                       * single vertex */

#endif
