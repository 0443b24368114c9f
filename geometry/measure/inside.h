/* Declares the test by formulas whether a point is inside a solid. */
#ifndef VS_GEOMETRY_MEASURE_INSIDE_H
#define VS_GEOMETRY_MEASURE_INSIDE_H

#include "model/node.h"

/* Sets *inside to true if p is inside solid n or on its surface. Uses formulas, not the kernel's mesh. A sweep is the
 * space between its sections, with linear interpolation (swept.h). */
bool vs_node_contains(const vs_node *n, vs_vec3 p, bool *inside, vs_error *e);
/* Tests for many points: vs_inside_new prepares a node once, and vs_inside_test tests a point. A test allocates no
 * memory. Only one thread at a time may test. */
typedef struct vs_inside vs_inside;
vs_inside *vs_inside_new(const vs_node *n, vs_error *e);
/* Prepares node n as vs_inside_new does. The sampled shapes in it differ from the solid by at most the tolerance. */
vs_inside *vs_inside_within(const vs_node *n, double tolerance, vs_error *e);
bool vs_inside_test(vs_inside *v, vs_vec3 p);
void vs_inside_free(vs_inside *v);
/* A cache of prepared nodes, for callers that test a few thousand nodes in any order. It takes at most some 50 MB, and
 * holds a reference to each of its nodes. */
typedef struct vs_inside_cache vs_inside_cache;
bool vs_inside_cached(vs_inside_cache **cache, const vs_node *n, vs_vec3 p, bool *inside, vs_error *e);
void vs_inside_cache_free(vs_inside_cache *cache);
/* Sets *inside to true if p is in the plane of the region, and inside the region or on its border. Curved borders are
 * sampled finely. */
bool vs_region_contains(const vs_node *region, vs_vec3 p, bool *inside, vs_error *e);

#endif
