/* Declares the bounding boxes of nodes. */
#ifndef VS_GEOMETRY_MEASURE_BOUNDS_H
#define VS_GEOMETRY_MEASURE_BOUNDS_H

#include "geometry/measure/ball.h"
#include "model/mesh.h"
#include "model/node.h"
#include "model/store/nodemap.h"

/* Sets *out to the bounds of the node in its own coordinates. They are exact for primitives and placed primitives. For
 * sweeps and splines they are the bounds of fine samples; for very large sets they may be larger than necessary. */
bool vs_node_bounds(const vs_node *n, vs_bounds *out, vs_error *e);
typedef struct { vs_bounds box; vs_ball ball; } vs_reach; /* a box and a ball: both contain the node */
/* A memo: it stores the bounds of many nodes of one model, so that later calls need not compute them. Initial value: {
 * .places.store = s } */
typedef struct { vs_nodemap places; vs_reach *at; size_t count, room, turned; } vs_bounds_memo;
bool vs_bounds_memo_get(vs_bounds_memo *m, const vs_node *n, vs_bounds *out, vs_error *e);
void vs_bounds_memo_free(vs_bounds_memo *m);

/* Clips a line to the box b: sets *from and *to to the ends of the part in b. The line goes through p in the direction
 * d; if `ray` is true, it begins at p. Returns false if no part lies in b. */
bool vs_line_clip(vs_vec3 p, vs_vec3 d, bool ray, const vs_bounds *b, vs_vec3 *from, vs_vec3 *to);

#endif
