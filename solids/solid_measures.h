/* Declares measures of solids for which no single formula exists: sums over separate parts, sweeps, and meshes for all
 * others. */
#ifndef VS_SOLIDS_SOLID_MEASURES_H
#define VS_SOLIDS_SOLID_MEASURES_H

#include "geometry/measure/node_measures.h"
#include "kernel/evaluate.h"

typedef enum { VS_ASK_VOLUME, VS_ASK_AREA, VS_ASK_CENTROID } vs_ask;

/* Computes the volume and centroid of a resolved solid (solids/resolve.h), and for VS_ASK_AREA also its area, by
 * formulas where possible and by meshes with the given tolerance otherwise. If it is 0, uses the drawing's tolerance or
 * a finer one. options may be NULL. Returns false and sets e on failure. */
bool vs_solid_measure(vs_ref ref, vs_ask ask, double tolerance, const vs_kernel_options *options, vs_measure *out,
                      vs_error *e);

#endif
