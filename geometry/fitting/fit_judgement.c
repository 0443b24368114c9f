/* Computes how accurate a fit's result is (fit_judgement.h).
 *
 * Confidence intervals follow from Huber's covariance of an M-estimate, K^2 s^2 [sum psi^2 / (m - n)] / [mean psi']^2
 * (J'J)^-1. Unknowns are in natural scales: numbers in units of their size, the motion in units of the scan's size. The
 * shift that the facets' tolerance would cause is added. A number is not determined if a change by its own scale
 * changes no distance by a hundred-thousandth of the scan's size. */
#include "geometry/fitting/fit_judgement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

/* ---- confidence intervals ---- */

double vs_student_quantile(double confidence, double freedom) {
  /* First computes the quantile of the normal distribution, by bisection of erf. Then adds the terms of the
   * Cornish-Fisher expansion for Student's distribution. */
  double low = 0, high = 40;
  VS_ASSERT(confidence > 0 && confidence < 1);
  for (int i = 0; i < 100; i++) {
    double middle = (low + high) / 2;
    if (erf(middle / sqrt(2)) < confidence)
      low = middle;
    else
      high = middle;
  }
  double z = low, z3 = z * z * z, z5 = z3 * z * z;
  return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom);
}

bool vs_fit_judge(vs_fit_search *f, const double *unknowns) {
  size_t n = f->unknowns, m = f->count;
  double *work = NULL;
  size_t room = 0;
  bool refused;
  if (!vs_fit_evaluate(f, unknowns, &refused)) return !f->failed;
  if (!VS_GROW(work, room, n * m + 2 * n * n + 4 * n)) return f->failed = true, vs_error_memory(f->e, NULL);
  double *jacobian = work, *normal = work + n * m, *vectors = normal + n * n, *values = vectors + n * n,
         *scales = values + n;
  double *common = scales + n; /* common: for each unknown, its change if all distances shift by one unit of length, as
                                * the facets of a round shape make them do */
  double spread = vs_fit_spread(f), psi = 0, curvature = 0, curvature_square = 0, freedom = (double)m - (double)n;
  bool ok = true;
  for (size_t j = 0; ok && j < f->numbers; j++) {
    ok = vs_fit_number_slopes(f, j, jacobian + j * m);
    scales[j] = fmax(fabs(f->made_at[j]), .01 * vs_fit_number_scale(&f->p->numbers[j]));
  }
  if (ok && !f->p->placed) vs_fit_motion_slopes(f, unknowns, jacobian + f->numbers * m);
  for (size_t j = f->numbers; j < n; j++) scales[j] = f->out->size;
  memset(normal, 0, n * n * sizeof *normal);
  for (size_t i = 0; ok && i < m; i++) {
    double r = f->distances[i] / spread, slope, weight, bend = vs_loss_curvature(VS_LOSS_TUKEY, r);
    vs_loss_root(VS_LOSS_TUKEY, r, &slope, &weight);
    psi += weight * weight * r * r, curvature += bend, curvature_square += bend * bend;
  }
  for (size_t j = 0; ok && j < n; j++)
    for (size_t k = j; k < n; k++) {
      double sum = 0;
      for (size_t i = 0; i < m; i++) sum += jacobian[j * m + i] * jacobian[k * m + i];
      normal[j * n + k] = normal[k * n + j] = sum / (double)m * scales[j] * scales[k] / (f->out->size * f->out->size);
    }
  for (size_t j = 0; ok && j < n; j++) {
    common[j] = 0;
    for (size_t i = 0; i < m; i++) common[j] += jacobian[j * m + i] * f->tolerance;
    common[j] *= scales[j] / ((double)m * f->out->size * f->out->size);
  }
  if (ok) {
    double mean = curvature / (double)m, variance = curvature_square / (double)m - mean * mean;
    double correction = 1 + (double)n / (double)m * variance / (mean * mean);
    double factor = mean > 0 ? correction * correction * spread * spread * psi / freedom / (mean * mean) : INFINITY;
    double reach = vs_student_quantile(f->p->confidence, freedom);
    vs_symmetric_eigen(normal, vectors, values, n);
    for (size_t j = 0; j < n; j++) {
      double square = 0, lost = 0, shift = 0;
      for (size_t k = 0; k < n; k++) {
        double part = vectors[j * n + k] * vectors[j * n + k], along = 0;
        for (size_t i = 0; i < n; i++) along += vectors[i * n + k] * common[i];
        if (values[k] > 1e-10)
          square += part / values[k], shift += vectors[j * n + k] * along / values[k];
        else
          lost += part;
      }
      if (j >= f->numbers) continue;
      vs_fitted_number *out = &f->out->numbers[j];
      const vs_fit_number *b = &f->p->numbers[j];
      out->error = lost > .01 ? INFINITY : hypot(sqrt(factor * square / (double)m) / f->out->size, shift) * scales[j];
      if (!(reach * out->error < .5 * scales[j]))
        out->verdict = VS_FIT_NUMBER_LOOSE;
      else if (out->value - b->low < 1e-3 * scales[j] || b->high - out->value < 1e-3 * scales[j])
        out->verdict = VS_FIT_NUMBER_BOUND;
      out->low = out->value - reach * out->error, out->high = out->value + reach * out->error;
    }
  }
  free(work);
  return !f->failed;
}

/* ---- correlation of neighbours ---- */

typedef struct {
  uint64_t key;
  double distance;
} neighbour;
static int compare_neighbours(const void *p, const void *q) {
  uint64_t a = ((const neighbour *)p)->key, b = ((const neighbour *)q)->key;
  return a < b ? -1 : a > b;
}

/* Returns the position of a point on Morton's space-filling curve through the box b. */
static uint64_t curve_key(vs_vec3 p, const vs_bounds *b, double side) {
  const double at[3] = { (p.x - b->min.x) / side, (p.y - b->min.y) / side, (p.z - b->min.z) / side };
  uint64_t key = 0;
  for (int k = 0; k < 3; k++) {
    uint64_t cell = (uint64_t)fmin(fmax(at[k], 0) * 2097151, 2097151);
    for (int bit = 0; bit < 21; bit++) key |= (cell >> bit & 1) << (3 * bit + k);
  }
  return key;
}

bool vs_fit_summarise(vs_fit_search *f) {
  const vs_fit_problem *p = f->p;
  neighbour *near = NULL;
  double *scratch = NULL;
  size_t room = 0, scratch_room = 0, kept = 0;
  vs_bounds b = vs_bounds_empty();
  if (!VS_GROW(near, room, p->count) || !VS_GROW(scratch, scratch_room, p->count)) {
    free(near);
    return f->failed = true, vs_error_memory(f->e, NULL);
  }
  for (size_t i = 0; i < p->count; i++) {
    if (!(i & 1023)) vs_fit_going(f);
    f->out->distances[i] = vs_mesh_distance_at(f->field, vs_rigid_point(&f->out->motion, p->points[i]), NULL);
    vs_bounds_add(&b, p->points[i]);
  }
  f->out->median = vs_fit_median_size(f->out->distances, p->count, scratch);
  f->out->spread = 1.4826 * f->out->median;
  double reach = VS_TUKEY_REACH * fmax(f->out->spread, f->tolerance), sum = 0, square = 0, product = 0, squares = 0;
  double side = fmax(fmax(b.max.x - b.min.x, b.max.y - b.min.y), b.max.z - b.min.z);
  for (size_t i = 0; i < p->count; i++) {
    double d = f->out->distances[i];
    square += d * d;
    if (fabs(d) > reach) continue;
    near[kept++] = (neighbour){ curve_key(p->points[i], &b, side > 0 ? side : 1), d };
    sum += d;
  }
  f->out->outliers = p->count - kept;
  f->out->root_mean_square = sqrt(square / (double)p->count);
  if (kept) qsort(near, kept, sizeof *near, compare_neighbours);
  for (size_t i = 0; i < kept; i++) {
    double d = near[i].distance - sum / (double)kept;
    squares += d * d;
    if (i) product += d * (near[i - 1].distance - sum / (double)kept);
  }
  f->out->correlation = squares > 0 ? product / squares : 0;
  free(near), free(scratch);
  return true;
}

vs_fit_doubt vs_fit_doubt_of(const vs_fit_search *f) {
  const vs_model_fit *o = f->out;
  const double(*turn)[3] = (const double(*)[3])o->motion.turn;
  if (o->median > .02 * o->size) return VS_FIT_DOUBT_FAR;
  if (!f->p->placed && !f->p->any_pose && !(turn[2][2] > VS_FIT_UPRIGHT)) return VS_FIT_DOUBT_TILTED;
  if (o->outliers * 5 > f->p->count) return VS_FIT_DOUBT_STRAYS;
  if (o->correlation > .5 && o->spread > 1e-3 * o->size) return VS_FIT_DOUBT_SHAPE;
  for (size_t j = 0; o->rival_unlike && j < f->numbers; j++) {
    const vs_fitted_number *n = &o->numbers[j];
    bool other = fabs(n->value - n->rival) > .05 * fmax(fabs(n->value), fabs(n->rival));
    if (other && n->verdict != VS_FIT_NUMBER_LOOSE) return VS_FIT_DOUBT_RIVAL;
  }
  return VS_FIT_DOUBT_NONE;
}
