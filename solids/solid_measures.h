/* Owns measures of solids that no single formula has: sums over parts that stand apart, sweeps, and what is left from
 * meshes. */
#ifndef VS_SOLIDS_SOLID_MEASURES_H
#define VS_SOLIDS_SOLID_MEASURES_H

#include "geometry/measure/node_measures.h"
#include "kernel/evaluate.h"

typedef enum { VS_ASK_VOLUME, VS_ASK_AREA, VS_ASK_CENTROID } vs_ask;

/* Fills in volume and centroid, and for VS_ASK_AREA the area too, of a solid without sections and the like
 * (solids/resolve.h). Parts are measured by formula where nothing else of the object touches them and there is one;
 * only what is left goes through the kernel, at `tolerance`, or where that is 0 at the drawing's own, finer as long as
 * that costs little. options may be NULL. */
bool vs_solid_measure(vs_ref ref, vs_ask ask, double tolerance, const vs_kernel_options *options, vs_measure *out,
                      vs_error *e);

#endif
