/* Declares the sun's position in the sky. */
#ifndef VS_GEOMETRY_SUN_POSITION_H
#define VS_GEOMETRY_SUN_POSITION_H

#include <stdbool.h>

/* A place on the earth, in degrees, north and east positive, and a time: a day, and hours in UT. */
typedef struct { double latitude, longitude; int year, month, day; double hours; } vs_sun_moment;
/* Degrees: the azimuth from north towards east, the altitude above the horizon. */
typedef struct { double azimuth, altitude; } vs_sun_direction;

/* Returns true if the day exists in the proleptic Gregorian calendar. */
bool vs_sun_is_day(int year, int month, int day);
/* Returns the low-precision position of the Astronomical Almanac, right to about 0.01 degrees between 1950 and 2050.
 * The altitude ignores refraction. */
vs_sun_direction vs_sun_position(const vs_sun_moment *m);

#endif
