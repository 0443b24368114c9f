/* Owns where the sun stands. */
#ifndef VS_GEOMETRY_SUN_POSITION_H
#define VS_GEOMETRY_SUN_POSITION_H

#include <stdbool.h>

/* Is there such a day, in the proleptic Gregorian calendar? */
bool vs_sun_is_day(int year, int month, int day);
/* The low-precision position of the Astronomical Almanac: right to about 0.01 degrees between 1950 and 2050. Degrees,
 * north and east positive; hours UT. azimuth from north by east, altitude without the air's refraction. */
void vs_sun_position(double latitude, double longitude, int year, int month, int day, double hours, double *azimuth,
                     double *altitude);

#endif
