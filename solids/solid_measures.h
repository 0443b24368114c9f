/* Owns measures of solids for which no single formula exists: sums over separate parts, sweeps, and meshes for the
 * rest. */
#ifndef VS_SOLIDS_SOLID_MEASURES_H
#define VS_SOLIDS_SOLID_MEASURES_H

#include "geometry/measure/node_measures.h"
#include "kernel/evaluate.h"

typedef enum { VS_ASK_VOLUME, VS_ASK_AREA, VS_ASK_CENTROID } vs_ask;

/* Computes volume and centroid, and for VS_ASK_AREA the area too, of a resolved solid (solids/resolve.h). Parts that
 * nothing else touches are measured by formula if there is one. Only the rest goes through the kernel, at `tolerance`,
 * or if that is 0 at the drawing's, finer as long as that costs little. options may be NULL. */
bool vs_solid_measure(vs_ref ref, vs_ask ask, double tolerance, const vs_kernel_options *options, vs_measure *out,
                      vs_error *e);

#endif
