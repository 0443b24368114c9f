/* Declares the functions of sunlight.c: a moment by place, date and time. */
#ifndef VS_BIND_WORKSHOP_SUNLIGHT_H
#define VS_BIND_WORKSHOP_SUNLIGHT_H

#include "geometry/sun_position.h"
#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;

/* Reads the latitude, the longitude (0 if it is not given), the date and the time (noon, if it is not given) from four
 * arguments. Returns false with the error set. */
bool vs_bind_moment(vs_args *f, const vs_arg *place, vs_sun_moment *out);

#endif
