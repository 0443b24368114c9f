/* Owns cutting what is thin with a plane: of polylines, regions and surfaces what lies on the normal's side is kept. */
#ifndef VS_GEOMETRY_PLANE_SLICE_H
#define VS_GEOMETRY_PLANE_SLICE_H

#include "geometry/plane/plane.h"
#include "geometry/plane/outline.h"
#include "model/mesh.h"

/* The pieces of p on the plane's normal's side, in order, handed to put; one that lies there as a whole is itself,
 * closed or not. False: put's, or out of memory. */
bool vs_slice_polyline(const vs_polyline *p, vs_vec3 point, vs_vec3 normal,
                       bool (*put)(void *context, const vs_polyline *piece), void *context);
/* Appends the parts of m's triangles that lie there to out. Returns false if memory ran out. */
bool vs_slice_mesh(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_mesh *out);
/* Cuts a region in the plane `flat`, within b: returns itself, the empty object, or its intersection with a rectangle,
 * as a new reference; NULL if memory ran out. */
vs_node *vs_slice_region(vs_ref region, const vs_shape_plane *flat, const vs_bounds *b, vs_vec3 point, vs_vec3 normal);

#endif
