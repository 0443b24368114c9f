/* Declares the sun's position in the sky. */
#ifndef VS_GEOMETRY_SUN_POSITION_H
#define VS_GEOMETRY_SUN_POSITION_H

#include <stdbool.h>

/* A place on the earth and a time. latitude, longitude: in degrees, north and east positive; year, month, day, hours:
 * time in UT. */
typedef struct { double latitude, longitude; int year, month, day; double hours; } vs_sun_moment;
/* Direction to the sun, in degrees. azimuth: from north towards east; altitude: above the horizon. */
typedef struct { double azimuth, altitude; } vs_sun_direction;

/* Returns true if the day exists in the proleptic Gregorian calendar. */
bool vs_sun_is_day(int year, int month, int day);
/* Returns the sun's position by the low-precision formula of the Astronomical Almanac. The error is about 0.01 degrees
 * between 1950 and 2050. The altitude ignores refraction. */
vs_sun_direction vs_sun_position(const vs_sun_moment *m);

#endif
