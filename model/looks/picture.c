/* Implements pictures on surfaces (picture.h): computes the direction of a face, and the position of a point on a
 * picture. */
#include "model/looks/picture.h"
#include "model/assert.h"

#include <math.h>
#include <stdbool.h>

static const double pi = 3.14159265358979323846;
enum { TILTS = VS_PICTURE_STEPS / 2 }; /* TILTS: number of steps in which a face's normal is tilted, from straight up
                                        * (step 0) to straight down */

int vs_picture_direction(double x, double y, double z) {
  const double step = 2 * pi / VS_PICTURE_STEPS;
  int tilt = (int)lround(atan2(hypot(x, y), z) / step);
  if (tilt <= 0 || tilt >= TILTS) return tilt <= 0 ? 0 : TILTS * VS_PICTURE_STEPS;
  int turn = (int)lround(atan2(y, x) / step);
  return tilt * VS_PICTURE_STEPS + (turn + VS_PICTURE_STEPS) % VS_PICTURE_STEPS;
}

void vs_picture_axes(int direction, double across[3], double up[3]) {
  const double step = 2 * pi / VS_PICTURE_STEPS;
  int turn = direction % VS_PICTURE_STEPS, tilt = direction / VS_PICTURE_STEPS;
  double t = tilt * step, a = turn * step;
  bool level = tilt == 0 || tilt == TILTS;
  VS_ASSERT(direction >= 0 && direction <= TILTS * VS_PICTURE_STEPS);
  if (level) a = -pi / 2; /* pictures on a horizontal face have the axes of a wall that faces south */
  across[0] = -sin(a), across[1] = cos(a), across[2] = 0;
  up[0] = -cos(t) * cos(a), up[1] = -cos(t) * sin(a), up[2] = sin(t);
}

void vs_picture_place(double width, double height, double angle, int direction, const double point[3], double out[2]) {
  double across[3], up[3], x = 0, y = 0, a = angle * pi / 180;
  VS_ASSERT(width > 0 && height > 0);
  vs_picture_axes(direction, across, up);
  for (int i = 0; i < 3; i++) x += across[i] * point[i], y += up[i] * point[i];
  out[0] = (cos(a) * x + sin(a) * y) / width;
  out[1] = (cos(a) * y - sin(a) * x) / height;
}
