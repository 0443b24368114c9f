/* Declares functions of sunlight.c that read a moment: a place on the earth, a date and a time. */
#ifndef VS_BIND_WORKSHOP_SUNLIGHT_H
#define VS_BIND_WORKSHOP_SUNLIGHT_H

#include "geometry/sun_position.h"
#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;

/* Reads a moment from four arguments: latitude, longitude (default 0), date, and time (default noon). If it fails, sets
 * the error and returns false. */
bool vs_bind_moment(vs_args *f, const vs_arg *place, vs_sun_moment *out);

#endif
