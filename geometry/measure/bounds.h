/* Owns the bounds of nodes. */
#ifndef VS_GEOMETRY_MEASURE_BOUNDS_H
#define VS_GEOMETRY_MEASURE_BOUNDS_H

#include "model/mesh.h"
#include "model/node.h"
#include "model/store/nodemap.h"

/* Bounds of the node in its own coordinates; exact for the primitives, moved ones too, and for sets of them under
 * turns; safe (may be larger) where those are very large; those of sweeps and splines are of fine samples. Iterative,
 * each shared node once. */
bool vs_node_bounds(const vs_node *n, vs_bounds *out, vs_error *e);
/* The same for many nodes of one model: what was found is remembered between calls. */
/* { .places.store = s } is an empty one */
typedef struct { vs_nodemap places; vs_bounds *at; size_t count, room, turned; } vs_bounds_memo;
bool vs_bounds_memo_get(vs_bounds_memo *m, const vs_node *n, vs_bounds *out, vs_error *e);
void vs_bounds_memo_free(vs_bounds_memo *m);

/* The part of the line through p along d (a ray: only forwards) that lies in b. False: none. */
bool vs_line_clip(vs_vec3 p, vs_vec3 d, bool ray, const vs_bounds *b, vs_vec3 *from, vs_vec3 *to);

#endif
