/* Declares the bounds of nodes. */
#ifndef VS_GEOMETRY_MEASURE_BOUNDS_H
#define VS_GEOMETRY_MEASURE_BOUNDS_H

#include "model/mesh.h"
#include "model/node.h"
#include "model/store/nodemap.h"

/* Sets the bounds of the node in its own coordinates. They are exact for primitives, also placed ones, and for sets of
 * these under rotations. For very large sets they are safe, but may be larger. For sweeps and splines they are those of
 * fine samples. Iterative; visits each shared node once. */
bool vs_node_bounds(const vs_node *n, vs_bounds *out, vs_error *e);
/* Does the same for many nodes of one model: results are kept between calls. */
/* { .places.store = s } is an empty memo */
typedef struct { vs_nodemap places; vs_bounds *at; size_t count, room, turned; } vs_bounds_memo;
bool vs_bounds_memo_get(vs_bounds_memo *m, const vs_node *n, vs_bounds *out, vs_error *e);
void vs_bounds_memo_free(vs_bounds_memo *m);

/* Sets the part of the line through p along d (ray: only forwards) that lies in b. Returns false if there is none. */
bool vs_line_clip(vs_vec3 p, vs_vec3 d, bool ray, const vs_bounds *b, vs_vec3 *from, vs_vec3 *to);

#endif
