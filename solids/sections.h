/* Declares results that require a solid's mesh: its section with a plane, its shadow on a plane, its feature edges. */
#ifndef VS_SOLIDS_SECTIONS_H
#define VS_SOLIDS_SECTIONS_H

#include "geometry/plane/outline.h"
#include "model/mesh.h"

/* Sets o to the outlines of the section of a closed mesh with the plane through `point`: the cut surface, and faces of
 * the mesh in the plane. If the section is empty, o has no loops. Returns false and sets e on failure. */
bool vs_mesh_section(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e);
/* Sets o to the outlines of the shadow that a closed mesh casts in the direction of the normal, on the plane through
 * `point`. Returns false and sets e on failure. */
bool vs_mesh_shadow(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_outline *o, vs_error *e);

/* Sets o to the outline of a mesh whose triangles lie in one plane. Reverses triangles of m that face the other way.
 * Returns false and sets e if the mesh deviates from every plane by more than 1e-6 of its size. If its area is 0, o has
 * no loops. */
bool vs_mesh_flat_outline(vs_mesh *m, vs_outline *o, vs_error *e);

/* A list of polylines along feature edges: borders of a mesh, and edges whose two faces differ in direction by more
 * than 30 degrees. A polyline ends where three or more such edges meet, or where it turns by more than 30 degrees. */
typedef struct { vs_polyline *at; size_t count, room; } vs_polylines;
bool vs_mesh_edges(const vs_mesh *m, vs_polylines *out, vs_error *e); /* finds the feature edges of m as polylines;
                                                                       * vertices with equal positions count as one;
                                                                       * returns false on failure */

#endif
