/* Owns the interface of along_curves.c: the stations of a curve, for the natives of this folder. */
#ifndef VS_BIND_SHAPES_ALONG_CURVES_H
#define VS_BIND_SHAPES_ALONG_CURVES_H

#include "vm/machine/native.h"
#include "geometry/plane/stations.h"

typedef struct vs_args vs_args;

/* Opens argument i, a curve, sampled to a millionth of its size. Returns VS_ERROR with the error set, and with nothing
 * to close. */
vs_status vs_bind_stations(vs_args *f, int i, vs_stations *out);

#endif
