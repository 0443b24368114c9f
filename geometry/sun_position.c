/* Implements the formula of the Astronomical Almanac for the direction to the sun. */
#include "geometry/sun_position.h"

#include <math.h>

static double degrees(double radians) { return radians * 57.29577951308232; }
static double radians(double deg) { return deg / 57.29577951308232; }

bool vs_sun_is_day(int year, int month, int day) {
  static const int length[] = { 31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
  bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return month >= 1 && month <= 12 && day >= 1 && day <= length[month - 1] && (month != 2 || day != 29 || leap);
}

/* Returns the number of days from 2000-01-01 12:00 UT to the given day and time; hours: hours since 0:00 UT. */
static double days_since_j2000(int year, int month, int day, double hours) {
  int a = (14 - month) / 12, y = year + 4800 - a, m = month + 12 * a - 3;
  long jdn = day + (153 * m + 2) / 5 + 365L * y + y / 4 - y / 100 + y / 400 - 32045;
  return (double)(jdn - 2451545) + (hours - 12) / 24;
}

vs_sun_direction vs_sun_position(const vs_sun_moment *m) {
  double days = days_since_j2000(m->year, m->month, m->day, m->hours);
  double mean = fmod(280.460 + 0.9856474 * days, 360), anomaly = radians(fmod(357.528 + 0.9856003 * days, 360));
  double ecliptic = radians(mean + 1.915 * sin(anomaly) + 0.020 * sin(2 * anomaly));
  double tilt = radians(23.439 - 4e-7 * days), ascension = atan2(cos(tilt) * sin(ecliptic), cos(ecliptic));
  double declination = asin(sin(tilt) * sin(ecliptic));
  double sidereal = 6.697375 + 0.0657098242 * days + m->hours; /* Greenwich mean sidereal time in hours */
  double hour_angle = radians(fmod(sidereal * 15 + m->longitude, 360)) - ascension, phi = radians(m->latitude);
  double altitude = degrees(asin(sin(phi) * sin(declination) + cos(phi) * cos(declination) * cos(hour_angle)));
  double from_south = atan2(sin(hour_angle), cos(hour_angle) * sin(phi) - tan(declination) * cos(phi));
  return (vs_sun_direction){ fmod(degrees(from_south) + 180 + 360, 360), altitude };
}
