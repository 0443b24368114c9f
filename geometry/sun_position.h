/* Owns where the sun stands. */
#ifndef VS_GEOMETRY_SUN_POSITION_H
#define VS_GEOMETRY_SUN_POSITION_H

#include <stdbool.h>

/* A place on the earth, in degrees, north and east positive, and a time there: a day and hours, UT. */
typedef struct { double latitude, longitude; int year, month, day; double hours; } vs_sun_moment;
/* In degrees: from north by east, and above the horizon. */
typedef struct { double azimuth, altitude; } vs_sun_direction;

/* Is there such a day, in the proleptic Gregorian calendar? */
bool vs_sun_is_day(int year, int month, int day);
/* The low-precision position of the Astronomical Almanac: right to about 0.01 degrees between 1950 and 2050. altitude
 * without the air's refraction. */
vs_sun_direction vs_sun_position(const vs_sun_moment *m);

#endif
