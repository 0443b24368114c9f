/* Implements the unknowns of a fit (fit_unknowns.h). It converts the model's numbers and the motion to the solver's
 * variables, and computes the distances of the points and their derivatives. */
#include "geometry/fitting/fit_unknowns.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DIFFERENCE 1e-3 /* change of a number for the computation of a derivative, as a fraction of the number's size */

/* ---- the unknowns of the solver ----
 *
 * Each number is an unknown u without bounds: x = start + scale u. A number with bounds is mapped as in Minuit (F.
 * James, M. Roos, 1975): by a sine between two bounds, by a root above or below one bound. */

double vs_fit_number_scale(const vs_fit_number *n) {
  double width = n->high - n->low;
  if (fabs(n->start) > 1e-9) return fabs(n->start);
  return isfinite(width) && width > 0 ? width / 2 : 1;
}

double vs_fit_number_outer(const vs_fit_number *n, double u) {
  bool low = isfinite(n->low), high = isfinite(n->high);
  double scale = vs_fit_number_scale(n);
  if (low && high) return n->low + (n->high - n->low) * (1 + sin(u)) / 2;
  if (low) return n->low + scale * (sqrt(u * u + 1) - 1);
  if (high) return n->high - scale * (sqrt(u * u + 1) - 1);
  return scale * u;
}

double vs_fit_number_inner(const vs_fit_number *n, double x) {
  bool low = isfinite(n->low), high = isfinite(n->high);
  double scale = vs_fit_number_scale(n), width = n->high - n->low;
  if (low && high) { /* At a bound itself, the derivative would be 0, and the solver would never change the number.
                      * Therefore the number is first moved slightly inside its bounds. */
    double share = width > 0 ? (x - n->low) / width : .5;
    return asin(2 * fmin(fmax(share, .01), .99) - 1);
  }
  if (low || high) {
    double off = 1 + fmax(low ? x - n->low : n->high - x, .01 * scale) / scale;
    return sqrt(off * off - 1);
  }
  return x / scale;
}

static double outer_slope(const vs_fit_number *n, double u) {
  double h = 1e-6;
  return (vs_fit_number_outer(n, u + h) - vs_fit_number_outer(n, u - h)) / (2 * h);
}

/* ---- distances and their derivatives ---- */

bool vs_fit_going(vs_fit_search *f) {
  bool stopped = f->out->stopped; /* the caller has already asked to stop; its function `going` is not called again, and
                                   * the rest of the work is small */
  f->out->stopped = !f->p->model->going(f->p->model->context) || stopped;
  return stopped || !f->out->stopped;
}

bool vs_fit_make_field(vs_fit_search *f, const double *numbers, vs_mesh_distance **out, bool *refused) {
  vs_mesh mesh = { 0 };
  vs_error e = { 0 };
  *out = NULL, *refused = false;
  f->out->models++;
  bool ok = f->p->model->make(f->p->model->context, numbers, f->tolerance, &mesh, &e);
  if (ok && !mesh.triangle_count) ok = vs_error_set(&e, VS_ERROR_MODEL, NULL, "the model has no solid");
  if (ok && !(*out = vs_mesh_distance_new(&mesh))) ok = vs_error_memory(&e, NULL);
  vs_mesh_free(&mesh);
  if (ok) return true;
  if (e.kind == VS_ERROR_MODEL) return *refused = true, false;
  if (e.kind == VS_ERROR_INTERRUPT) return f->out->stopped = true, false;
  *f->e = e;
  f->failed = true;
  return false;
}

bool vs_fit_measure(vs_fit_search *f, const vs_mesh_distance *field, double *distances, vs_vec3 *slopes) {
  for (size_t i = 0; i < f->count; i++) {
    if (!(i & 1023) && !vs_fit_going(f)) return false;
    distances[i] = vs_mesh_distance_at(field, f->places[i], slopes ? &slopes[i] : NULL);
  }
  return true;
}

void vs_fit_numbers_at(const vs_fit_search *f, const double *unknowns, double *out) {
  for (size_t j = 0; j < f->numbers; j++) out[j] = vs_fit_number_outer(&f->p->numbers[j], unknowns[j]);
}

static const double *motion_of(const vs_fit_search *f, const double *unknowns) {
  static const double none[VS_RIGID_UNKNOWNS] = { 0 };
  return f->p->placed ? none : unknowns + f->numbers;
}

bool vs_fit_evaluate(vs_fit_search *f, const double *unknowns, bool *refused) {
  *refused = false;
  if (f->known && !memcmp(f->at, unknowns, f->unknowns * sizeof *unknowns)) return true;
  if (!vs_fit_going(f)) return false;
  f->known = false;
  vs_fit_numbers_at(f, unknowns, f->trial);
  if (!f->field || memcmp(f->trial, f->made_at, f->numbers * sizeof *f->trial)) {
    vs_mesh_distance *fresh;
    if (!vs_fit_make_field(f, f->trial, &fresh, refused)) return false;
    vs_mesh_distance_free(f->field);
    f->field = fresh;
    memcpy(f->made_at, f->trial, f->numbers * sizeof *f->trial);
  }
  vs_rigid_motion moved = vs_rigid_moved(&f->motion, motion_of(f, unknowns));
  for (size_t i = 0; i < f->count; i++) f->places[i] = vs_rigid_point(&moved, f->points[i]);
  if (!vs_fit_measure(f, f->field, f->distances, f->slopes)) return false;
  memcpy(f->at, unknowns, f->unknowns * sizeof *unknowns);
  return f->known = true;
}

void vs_fit_motion_slopes(const vs_fit_search *f, const double *unknowns, double *out) {
  const double *w = unknowns + f->numbers;
  double jacobian[3][3];
  vs_rigid_motion moved = vs_rigid_moved(&f->motion, w);
  vs_rigid_jacobian(w, moved.size, jacobian);
  for (size_t i = 0; i < f->count; i++) {
    vs_vec3 turn = vs_v3_cross(vs_v3_sub(f->places[i], moved.to), f->slopes[i]);
    const double by[3] = { turn.x, turn.y, turn.z }, shift[3] = { f->slopes[i].x, f->slopes[i].y, f->slopes[i].z };
    for (size_t k = 0; k < 3; k++) {
      out[k * f->count + i] = (by[0] * jacobian[0][k] + by[1] * jacobian[1][k] + by[2] * jacobian[2][k]) / moved.size;
      out[(3 + k) * f->count + i] = shift[k];
    }
  }
}

bool vs_fit_number_slopes(vs_fit_search *f, size_t j, double *out) {
  const vs_fit_number *n = &f->p->numbers[j];
  double x = f->made_at[j], step = DIFFERENCE * fmax(fabs(x), .1 * vs_fit_number_scale(n));
  if (x + step > n->high) step = -step;
  for (int side = 0; side < 2; side++, step = -step) {
    vs_mesh_distance *field;
    bool refused;
    memcpy(f->trial, f->made_at, f->numbers * sizeof *f->trial);
    f->trial[j] = x + step;
    if (f->trial[j] < n->low || f->trial[j] > n->high) continue;
    bool ok = vs_fit_make_field(f, f->trial, &field, &refused);
    if (!ok && refused) continue;
    ok = ok && vs_fit_measure(f, field, f->other, NULL);
    vs_mesh_distance_free(field);
    for (size_t i = 0; ok && i < f->count; i++) out[i] = (f->other[i] - f->distances[i]) / step;
    return ok;
  }
  memset(out, 0, f->count * sizeof *out);
  return true;
}

/* Computes residuals or derivatives for the solver (a vs_residuals_fn). If the numbers do not make a solid, sets all
 * distances to the model's diagonal, so that the solver tries a shorter step. */
static bool residuals(void *context, const double *unknowns, double *out, double *slopes) {
  vs_fit_search *f = context;
  bool refused;
  if (!vs_fit_evaluate(f, unknowns, &refused)) {
    for (size_t i = 0; refused && i < f->count; i++) out[i] = f->diagonal;
    return refused && !slopes;
  }
  memcpy(out, f->distances, f->count * sizeof *out);
  if (!slopes) {
    f->out->iterations++;
    f->p->model->progress(f->p->model->context, f->out->iterations, f->out->spread);
    return true;
  }
  for (size_t j = 0; j < f->numbers; j++) {
    if (!vs_fit_number_slopes(f, j, slopes + j * f->count)) return false;
    double by = outer_slope(&f->p->numbers[j], unknowns[j]);
    for (size_t i = 0; i < f->count; i++) slopes[j * f->count + i] *= by;
  }
  if (!f->p->placed) vs_fit_motion_slopes(f, unknowns, slopes + f->numbers * f->count);
  return true;
}

/* ---- spreads of distances ---- */

int vs_fit_compare(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return a < b ? -1 : a > b;
}

double vs_fit_median_size(const double *distances, size_t count, double *scratch) {
  VS_ASSERT(count > 0);
  for (size_t i = 0; i < count; i++) scratch[i] = fabs(distances[i]);
  qsort(scratch, count, sizeof *scratch, vs_fit_compare);
  return count % 2 ? scratch[count / 2] : (scratch[count / 2 - 1] + scratch[count / 2]) / 2;
}

double vs_fit_spread(vs_fit_search *f) {
  f->out->spread = 1.4826 * vs_fit_median_size(f->distances, f->count, f->other);
  return fmax(f->out->spread, f->tolerance);
}

/* ---- fitting of all unknowns ---- */

bool vs_fit_improve(vs_fit_search *f, const vs_fit_effort *effort, double *unknowns) {
  bool refused;
  f->count = effort->points < f->point_count ? effort->points : f->point_count;
  f->known = false;
  for (unsigned round = 0; round < effort->rounds; round++) {
    if (!vs_fit_evaluate(f, unknowns, &refused)) return false;
    vs_robust_problem problem = { .count = f->count, .unknowns = f->unknowns, .residuals = residuals, .context = f };
    problem.loss = VS_LOSS_TUKEY, problem.most = effort->most, problem.tolerance = effort->tolerance;
    double before = problem.spread = vs_fit_spread(f), mean;
    bool wide = round == 0 && effort->rounds > 2;
    if (wide) problem.spread *= 3;
    vs_robust_end end;
    if (!vs_robust_solve(&problem, unknowns, &mean, &end, f->e)) return f->failed = true, false;
    if (end == VS_ROBUST_STOPPED) return false;
    f->out->converged = end == VS_ROBUST_DONE;
    f->out->used = f->count;
    if (!vs_fit_evaluate(f, unknowns, &refused)) return false;
    double spread = vs_fit_spread(f);
    if (!wide && end == VS_ROBUST_DONE && fabs(spread - before) < 1e-3 * before) break;
  }
  return true;
}

void vs_fit_settle(vs_fit_search *f, double *unknowns) {
  if (f->p->placed) return;
  f->motion = vs_rigid_moved(&f->motion, unknowns + f->numbers);
  memset(unknowns + f->numbers, 0, VS_RIGID_UNKNOWNS * sizeof *unknowns);
  f->known = false;
}

void vs_fit_take_points(vs_fit_search *f, bool core) {
  f->points = core ? f->core : f->p->points, f->point_count = core ? f->core_count : f->p->count;
}
