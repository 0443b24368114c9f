/* Declares measures of nodes (volume, area, length, centroid) by formula. */
#ifndef VS_GEOMETRY_MEASURE_NODE_MEASURES_H
#define VS_GEOMETRY_MEASURE_NODE_MEASURES_H

#include "geometry/measure/bounds.h"
#include "geometry/measure/inside.h"
#include "geometry/measure/measure.h"
#include "model/node.h"

/* Sets *out to the measures of node n by formula, if there is one. Splines and curved outlines are measured by fine
 * samples. Returns false on failure. */
bool vs_node_measure(const vs_node *n, vs_measure *out, vs_error *e);
/* Measures a sweep or a round bar n by formula, as if it did not overlap itself. Sets out->known to false if there is
 * no formula. Sets no centroid. Returns false on failure. */
bool vs_sweep_measure(const vs_node *n, vs_measure *out, vs_error *e);

#endif
