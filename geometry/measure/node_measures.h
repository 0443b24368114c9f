/* Owns bounds and measures of nodes, and the analytic answer to "is this point inside?". */
#ifndef VS_GEOMETRY_MEASURE_H
#define VS_GEOMETRY_MEASURE_H

#include "geometry/measure/measure.h"
#include "model/node.h"
#include "model/store/nodemap.h"

/* ---- bounds ---- */

/* Bounds of the node in its own coordinates; exact for the primitives, moved ones too, and for sets of them under
 * turns; safe (may be larger) where those are very large; those of sweeps and splines are of fine samples. Iterative,
 * each shared node once. */
bool vs_node_bounds(const vs_node *n, vs_bounds *out, vs_error *e);
/* The same for many nodes of one model: what was found is remembered between calls. */
/* { .places.store = s } is an empty one */
typedef struct { vs_nodemap places; vs_bounds *at; size_t count, room, turned; } vs_bounds_memo;
bool vs_bounds_memo_get(vs_bounds_memo *m, const vs_node *n, vs_bounds *out, vs_error *e);
void vs_bounds_memo_free(vs_bounds_memo *m);

/* ---- inside ---- */

/* Is p inside (or on) the solid: from formulas, never from the mesh. A sweep is what lies between its sections,
 * linearly (swept.h). */
bool vs_node_contains(const vs_node *n, vs_vec3 p, bool *inside, vs_error *e);
/* The same for many points: prepare once, ask often. A test needs no memory; one asker at a time. */
typedef struct vs_inside vs_inside;
vs_inside *vs_inside_new(const vs_node *n, vs_error *e);
bool vs_inside_test(vs_inside *v, vs_vec3 p);
void vs_inside_free(vs_inside *v);
/* vs_node_contains for one who asks about the same few thousand nodes in any order: what was prepared is kept, up to
 * some 50 MB, with a reference to its node. *cache is NULL at first. */
typedef struct vs_inside_cache vs_inside_cache;
bool vs_inside_cached(vs_inside_cache **cache, const vs_node *n, vs_vec3 p, bool *inside, vs_error *e);
void vs_inside_cache_free(vs_inside_cache *cache);

/* ---- measures ---- */

/* By formula where there is one: primitives and their placements, curves, regions. Splines and curved outlines are
 * measured by fine samples. */
bool vs_node_measure(const vs_node *n, vs_measure *out, vs_error *e);
/* Of a sweep or a round bar as if it did not overlap itself; not known without a formula. No centroid. */
bool vs_sweep_measure(const vs_node *n, vs_measure *out, vs_error *e);

/* The part of the line through p along d (a ray: only forwards) that lies in b. False: none. */
bool vs_line_clip(vs_vec3 p, vs_vec3 d, bool ray, const vs_bounds *b, vs_vec3 *from, vs_vec3 *to);

#endif
