/* Declares the stations (points with a frame) of a curve for other natives of bind/shapes, implemented in
 * along_curves.c. */
#ifndef VS_BIND_SHAPES_ALONG_CURVES_H
#define VS_BIND_SHAPES_ALONG_CURVES_H

#include "vm/machine/native.h"
#include "geometry/plane/stations.h"

typedef struct vs_args vs_args;

/* Samples the curve in argument i, with an error below a millionth of its size. The caller frees *out. If it fails,
 * sets the error and returns VS_ERROR; there is then nothing to free. */
vs_status vs_bind_stations(vs_args *f, int i, vs_stations *out);

#endif
