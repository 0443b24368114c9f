/* Declares the analytic test whether a point is inside a solid. */
#ifndef VS_GEOMETRY_MEASURE_INSIDE_H
#define VS_GEOMETRY_MEASURE_INSIDE_H

#include "model/node.h"

/* Sets *inside: whether p is inside or on the solid, by formulas, never by the mesh. A sweep is the space between its
 * sections, linearly interpolated (swept.h). */
bool vs_node_contains(const vs_node *n, vs_vec3 p, bool *inside, vs_error *e);
/* Does the same for many points: prepare once, test often. A test needs no memory; only one thread may test at a
 * time. */
typedef struct vs_inside vs_inside;
vs_inside *vs_inside_new(const vs_node *n, vs_error *e);
bool vs_inside_test(vs_inside *v, vs_vec3 p);
void vs_inside_free(vs_inside *v);
/* vs_node_contains for a caller that tests the same few thousand nodes in any order: prepared data are kept, up to some
 * 50 MB, with a reference to their node. *cache is NULL at first. */
typedef struct vs_inside_cache vs_inside_cache;
bool vs_inside_cached(vs_inside_cache **cache, const vs_node *n, vs_vec3 p, bool *inside, vs_error *e);
void vs_inside_cache_free(vs_inside_cache *cache);
/* Sets *inside: whether p is in the region's plane, and in the region or on its border. Curved borders are sampled
 * finely. */
bool vs_region_contains(const vs_node *region, vs_vec3 p, bool *inside, vs_error *e);

#endif
