/* Declares cuts of polylines, regions and surfaces by a plane. The part on the side of the normal is kept. */
#ifndef VS_GEOMETRY_PLANE_SLICE_H
#define VS_GEOMETRY_PLANE_SLICE_H

#include "geometry/plane/plane.h"
#include "geometry/plane/outline.h"
#include "model/mesh.h"

/* Calls `put` for each piece of p on the side of the plane's normal, in order. If all of p is on that side, it is one
 * piece, closed if p is closed. Returns false if `put` has returned false, or memory is out. */
bool vs_slice_polyline(const vs_polyline *p, vs_vec3 point, vs_vec3 normal,
                       bool (*put)(void *context, const vs_polyline *piece), void *context);
/* Appends the parts of m's triangles on the side of the plane's normal to out. Returns false when memory is out. */
bool vs_slice_mesh(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_mesh *out);
/* Cuts a region, which lies in the plane `flat` and within the bounds b. Returns the kept part as a new reference: the
 * region itself, the empty object, or an intersection with a rectangle. Returns NULL when memory is out. */
vs_node *vs_slice_region(vs_ref region, const vs_shape_plane *flat, const vs_bounds *b, vs_vec3 point, vs_vec3 normal);

#endif
