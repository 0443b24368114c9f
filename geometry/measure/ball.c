/* Computes balls that contain nodes (ball.h). */
#include "geometry/measure/ball.h"

#include <float.h>
#include <math.h>

#include "model/assert.h"

#define BALL_ROUNDING 1e-6 /* part of its radius by which a ball is enlarged before it limits a box: far more than the
                            * rounding errors of its radius in a million maps, so exact boxes stay exact */

/* Returns a bound of the rounding error of a middle. terms: the sum of the sizes of the terms that are added. */
static double middle_error(double terms) { return 4 * DBL_EPSILON * terms; }
static double size_of(vs_vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

vs_ball vs_ball_empty(void) { return (vs_ball){ { 0, 0, 0 }, -1 }; }

vs_ball vs_ball_of_box(const vs_bounds *b) {
  double diagonal = vs_bounds_diagonal(b);
  if (vs_bounds_is_empty(b)) return vs_ball_empty();
  if (!isfinite(diagonal)) return (vs_ball){ { 0, 0, 0 }, INFINITY };
  vs_vec3 middle = vs_v3_scale(vs_v3_add(b->min, b->max), 0.5);
  return (vs_ball){ middle, diagonal / 2 + middle_error(size_of(middle)) };
}

/* Returns a bound of the factor by which a lengthens a vector; exact if a keeps angles. The factor's square is the
 * largest eigenvalue of the products of the columns, and no eigenvalue exceeds the largest sum of a row. */
static double lengthens_most(const vs_affine *a) {
  double most = 0;
  for (int i = 0; i < 3; i++) {
    double sum = 0;
    for (int k = 0; k < 3; k++)
      sum += fabs(a->m[0][i] * a->m[0][k] + a->m[1][i] * a->m[1][k] + a->m[2][i] * a->m[2][k]);
    most = fmax(most, sum);
  }
  return sqrt(most);
}

vs_ball vs_ball_mapped(const vs_ball *ball, const vs_affine *a) {
  if (ball->radius < 0 || !isfinite(ball->radius)) return *ball;
  double terms = 0;
  for (int i = 0; i < 3; i++)
    terms += fabs(a->m[i][0] * ball->middle.x) + fabs(a->m[i][1] * ball->middle.y) + fabs(a->m[i][2] * ball->middle.z) +
             fabs(a->m[i][3]);
  return (vs_ball){ vs_affine_point(a, ball->middle), ball->radius * lengthens_most(a) + middle_error(terms) };
}

void vs_ball_unite(vs_ball *all, const vs_ball *more) {
  vs_vec3 way = vs_v3_sub(more->middle, all->middle);
  double apart = vs_v3_length(way);
  if (more->radius < 0 || !(apart + more->radius > all->radius)) return;
  if (all->radius < 0 || !(apart + all->radius > more->radius)) {
    *all = *more;
    return;
  }
  double radius = (apart + all->radius + more->radius) / 2;
  VS_ASSERT(radius >= all->radius && radius >= more->radius);
  all->middle = vs_v3_add(all->middle, vs_v3_scale(way, (radius - all->radius) / apart));
  all->radius = radius + middle_error(size_of(all->middle) + radius);
}

void vs_ball_limit(const vs_ball *ball, vs_bounds *b) {
  double r = ball->radius * (1 + BALL_ROUNDING);
  if (ball->radius < 0 || !isfinite(r)) return;
  vs_bounds box = { vs_v3_sub(ball->middle, vs_v3(r, r, r)), vs_v3_add(ball->middle, vs_v3(r, r, r)) };
  vs_bounds_meet(b, &box);
}
