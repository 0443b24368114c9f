/* Owns the analytic answer to "is this point inside?". */
#ifndef VS_GEOMETRY_MEASURE_INSIDE_H
#define VS_GEOMETRY_MEASURE_INSIDE_H

#include "model/node.h"

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
/* Is p in the region's plane and in it or on its border? Of fine samples where it is round. */
bool vs_region_contains(const vs_node *region, vs_vec3 p, bool *inside, vs_error *e);

#endif
