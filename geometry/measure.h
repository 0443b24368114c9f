/* Owns bounds and measures of nodes, and the analytic answer to "is this point inside?". */
#ifndef VS_GEOMETRY_MEASURE_H
#define VS_GEOMETRY_MEASURE_H

#include "model/node.h"

/* Bounds of the node in its own coordinates; exact for the primitives, safe (may be larger) for CSG. Iterative and memoised. */
bool vs_node_bounds(const vs_node *n, vs_bounds *out, vs_error *e);
/* Is p inside (or on) the solid: from formulas, never from the mesh. on_error false: no formula for this kind. */
bool vs_node_contains(const vs_node *n, vs_vec3 p, bool *inside, vs_error *e);

#endif
