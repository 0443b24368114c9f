/* Owns the order of steps of a fit, and what its result is worth (model_fit.h). */
#include "geometry/fitting/model_fit.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/fitting/robust_squares.h"
#include "model/store/array.h"

enum {
  TRIED = 300,  /* points of step 1 */
  FIRST = 1000, /* of step 2 */
  STARTS = 5,   /* of all points, and of the core, that step 2 goes on with */
  MOST_STARTS = 2 * STARTS,
  PLACES = 24,  /* that step 1 improves */
  AXES_TURNS = 48,
  PLAN_TURNS = 12,
  SHIFTS = 4,
  PLACES_TRIED = 1 + SHIFTS * (1 + AXES_TURNS + PLAN_TURNS),
  UNKNOWNS_MOST = 200
};
#define COARSE (1. / 2000) /* facets of step 2, in diagonals of the model */
#define FINE (1. / 50000)
#define NEAR .1 /* of the scan's size: how far a point may say that a place is wrong */
#define CORE 2.5 /* times the square reach of three quarters of the points */
#define DOUBTED .16 /* cost of a candidate above which its numbers are moved: a twentieth of the points are off */
#define MOVED .08   /* by this share */
#define UPRIGHT .7 /* cosine of the angle by which up may differ */
#define DIFFERENCE 1e-3 /* of a number, for its derivative */

/* ---- the unknowns of the solver ----
 *
 * Each number is an unknown u without bounds: x = start + scale u, or within bounds by the maps of Minuit (F. James, M.
 * Roos, 1975): a sine between two, a root above or below one. */

static double scale_of(const vs_fit_number *n) {
  double width = n->high - n->low;
  if (fabs(n->start) > 1e-9) return fabs(n->start);
  return isfinite(width) && width > 0 ? width / 2 : 1;
}

static double outer(const vs_fit_number *n, double u) {
  bool low = isfinite(n->low), high = isfinite(n->high);
  double scale = scale_of(n);
  if (low && high) return n->low + (n->high - n->low) * (1 + sin(u)) / 2;
  if (low) return n->low + scale * (sqrt(u * u + 1) - 1);
  if (high) return n->high - scale * (sqrt(u * u + 1) - 1);
  return scale * u;
}

static double inner(const vs_fit_number *n, double x) {
  bool low = isfinite(n->low), high = isfinite(n->high);
  double scale = scale_of(n), width = n->high - n->low;
  if (low && high) { /* a bound itself has no slope to leave it by */
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
  return (outer(n, u + h) - outer(n, u - h)) / (2 * h);
}

/* ---- the state of a fit ---- */

typedef struct {
  const vs_fit_problem *p;
  vs_model_fit *out;
  vs_error *e;
  size_t numbers, unknowns; /* unknowns: with the motion's */
  double diagonal;          /* of the model at the start */
  double tolerance;         /* of the facets in this step */
  vs_rigid_motion motion;   /* where the motion's unknowns are 0 */
  size_t count;             /* points in this step */
  bool failed;              /* with an error that is not the model's */
  vs_vec3 *core;            /* points of the scan without strays, in the same order */
  size_t core_count;
  const vs_vec3 *points;    /* of this step: all, or the core */
  size_t point_count;
  bool level;               /* places turn only about what is up */
  /* what was worked out last, and where */
  vs_mesh_distance *field;
  double *at, *made_at, *trial; /* unknowns of it; numbers of the field; numbers to be tried */
  bool known;
  double *begin[2]; /* numbers to start from: the caller's, and those times the scan's size by the model's */
  vs_vec3 *places, *slopes;
  double *distances, *other;
} fit;

static bool going(fit *f) {
  bool stopped = f->out->stopped; /* what comes then is little, and is done */
  f->out->stopped = !f->p->model->going(f->p->model->context) || stopped;
  return stopped || !f->out->stopped;
}

/* False: stopped, failed, or these numbers make no solid; then *refused. */
static bool make_field(fit *f, const double *numbers, vs_mesh_distance **out, bool *refused) {
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

/* The distances of the step's points from a field; slopes may be NULL. False: stopped. */
static bool measure(fit *f, const vs_mesh_distance *field, double *distances, vs_vec3 *slopes) {
  for (size_t i = 0; i < f->count; i++) {
    if (!(i & 1023) && !going(f)) return false;
    distances[i] = vs_mesh_distance_at(field, f->places[i], slopes ? &slopes[i] : NULL);
  }
  return true;
}

static void numbers_of(const fit *f, const double *unknowns, double *out) {
  for (size_t j = 0; j < f->numbers; j++) out[j] = outer(&f->p->numbers[j], unknowns[j]);
}

static const double *motion_of(const fit *f, const double *unknowns) {
  static const double none[VS_RIGID_UNKNOWNS] = { 0 };
  return f->p->placed ? none : unknowns + f->numbers;
}

/* Distances and slopes at these unknowns. *refused: they make no solid. False: stopped or failed, or refused. */
static bool evaluate(fit *f, const double *unknowns, bool *refused) {
  *refused = false;
  if (f->known && !memcmp(f->at, unknowns, f->unknowns * sizeof *unknowns)) return true;
  if (!going(f)) return false;
  f->known = false;
  numbers_of(f, unknowns, f->trial);
  if (!f->field || memcmp(f->trial, f->made_at, f->numbers * sizeof *f->trial)) {
    vs_mesh_distance *fresh;
    if (!make_field(f, f->trial, &fresh, refused)) return false;
    vs_mesh_distance_free(f->field);
    f->field = fresh;
    memcpy(f->made_at, f->trial, f->numbers * sizeof *f->trial);
  }
  vs_rigid_motion moved = vs_rigid_moved(&f->motion, motion_of(f, unknowns));
  for (size_t i = 0; i < f->count; i++) f->places[i] = vs_rigid_point(&moved, f->points[i]);
  if (!measure(f, f->field, f->distances, f->slopes)) return false;
  memcpy(f->at, unknowns, f->unknowns * sizeof *unknowns);
  return f->known = true;
}

/* Derivatives by the motion: the slope, carried by how the point moves. */
static void motion_slopes(const fit *f, const double *unknowns, double *out) {
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

/* The derivative of the distances by a number, at the unknowns of f->at. Where neither side makes a solid it is 0. */
static bool number_slopes(fit *f, size_t j, double *out) {
  const vs_fit_number *n = &f->p->numbers[j];
  double x = f->made_at[j], step = DIFFERENCE * fmax(fabs(x), .1 * scale_of(n));
  if (x + step > n->high) step = -step;
  for (int side = 0; side < 2; side++, step = -step) {
    vs_mesh_distance *field;
    bool refused;
    memcpy(f->trial, f->made_at, f->numbers * sizeof *f->trial);
    f->trial[j] = x + step;
    if (f->trial[j] < n->low || f->trial[j] > n->high) continue;
    bool ok = make_field(f, f->trial, &field, &refused);
    if (!ok && refused) continue;
    ok = ok && measure(f, field, f->other, NULL);
    vs_mesh_distance_free(field);
    for (size_t i = 0; ok && i < f->count; i++) out[i] = (f->other[i] - f->distances[i]) / step;
    return ok;
  }
  memset(out, 0, f->count * sizeof *out);
  return true;
}

/* vs_residuals_fn. Where the numbers make no solid, all distances are a diagonal: the solver takes a shorter step. */
static bool residuals(void *context, const double *unknowns, double *out, double *slopes) {
  fit *f = context;
  bool refused;
  if (!evaluate(f, unknowns, &refused)) {
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
    if (!number_slopes(f, j, slopes + j * f->count)) return false;
    double by = outer_slope(&f->p->numbers[j], unknowns[j]);
    for (size_t i = 0; i < f->count; i++) slopes[j * f->count + i] *= by;
  }
  if (!f->p->placed) motion_slopes(f, unknowns, slopes + f->numbers * f->count);
  return true;
}

/* ---- spreads ---- */

static int compare(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return a < b ? -1 : a > b;
}

/* The median size of the distances; scratch is as large. */
static double median_size(const double *distances, size_t count, double *scratch) {
  for (size_t i = 0; i < count; i++) scratch[i] = fabs(distances[i]);
  qsort(scratch, count, sizeof *scratch, compare);
  return count % 2 ? scratch[count / 2] : (scratch[count / 2 - 1] + scratch[count / 2]) / 2;
}

/* Of the last evaluation: 1.4826 medians, and not less than the facets are off. */
static double spread_of(fit *f) {
  f->out->spread = 1.4826 * median_size(f->distances, f->count, f->other);
  return fmax(f->out->spread, f->tolerance);
}

/* ---- steps ---- */

/* Fits all unknowns from those in place, in rounds with the spread measured anew; Tukey's first round has three times
 * the spread, lest a part that is a little off has no say. False: failed, or stopped. */
static bool solve(fit *f, vs_loss loss, size_t count, unsigned rounds, unsigned most, double tolerance,
                  double *unknowns, double *spread) {
  bool refused;
  f->count = count < f->point_count ? count : f->point_count;
  f->known = false;
  for (unsigned round = 0; round < rounds; round++) {
    if (!evaluate(f, unknowns, &refused)) return false;
    vs_robust_problem problem = { f->count, f->unknowns, residuals, f, loss, spread_of(f), most, tolerance };
    double before = problem.spread, mean;
    bool wide = loss == VS_LOSS_TUKEY && round == 0 && rounds > 2;
    if (wide) problem.spread *= 3;
    vs_robust_end end;
    if (!vs_robust_solve(&problem, unknowns, &mean, &end, f->e)) return f->failed = true, false;
    if (end == VS_ROBUST_STOPPED) return false;
    f->out->converged = end == VS_ROBUST_DONE;
    f->out->used = f->count;
    if (!evaluate(f, unknowns, &refused)) return false;
    *spread = spread_of(f);
    if (!wide && end == VS_ROBUST_DONE && fabs(*spread - before) < 1e-3 * before) break;
  }
  return true;
}

/* Moves what the motion's unknowns say into the motion, and makes them 0. */
static void settle(fit *f, double *unknowns) {
  if (f->p->placed) return;
  f->motion = vs_rigid_moved(&f->motion, unknowns + f->numbers);
  memset(unknowns + f->numbers, 0, VS_RIGID_UNKNOWNS * sizeof *unknowns);
  f->known = false;
}

/* Measures by the core, or by all points. */
static void take_points(fit *f, bool core) {
  f->points = core ? f->core : f->p->points, f->point_count = core ? f->core_count : f->p->count;
}

/* ---- the core of a scan ----
 *
 * Strays shift the centre of the points and turn their axes. Therefore three quarters of them are sought whose
 * ellipsoid is small, by the steps of P. Rousseeuw and K. Van Driessen (1999): keep those that are nearest by the
 * ellipsoid of those that were kept. Then all that lie within CORE times its square reach come back. */

/* The square of the distance from the centre, by the spreads along the axes. */
static double ellipsoid_square(vs_vec3 p, vs_vec3 centre, double axes[3][3], const double square[3]) {
  vs_vec3 d = vs_v3_sub(p, centre);
  double sum = 0;
  for (int a = 0; a < 3; a++) {
    double along = d.x * axes[a][0] + d.y * axes[a][1] + d.z * axes[a][2];
    sum += along * along / square[a];
  }
  return sum;
}

static void find_core(fit *f) {
  enum { SEEN = 2000, STEPS = 12 };
  const vs_fit_problem *p = f->p;
  size_t n = p->count < SEEN ? p->count : SEEN, half = n * 3 / 4;
  vs_vec3 centre;
  double axes[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, square[3] = { 1, 1, 1 }, limit = 0, scratch[SEEN];
  double middle[3];
  for (int a = 0; a < 3; a++) {
    for (size_t i = 0; i < n; i++) scratch[i] = a == 0 ? p->points[i].x : a == 1 ? p->points[i].y : p->points[i].z;
    qsort(scratch, n, sizeof *scratch, compare);
    middle[a] = scratch[n / 2];
  }
  centre = vs_v3(middle[0], middle[1], middle[2]);
  for (int step = 0; step < STEPS; step++) {
    vs_point_moments moments = { 0 };
    double size;
    for (size_t i = 0; i < n; i++) scratch[i] = ellipsoid_square(p->points[i], centre, axes, square);
    qsort(scratch, n, sizeof *scratch, compare);
    limit = scratch[half];
    for (size_t i = 0; i < n; i++)
      if (ellipsoid_square(p->points[i], centre, axes, square) <= limit)
        vs_point_moments_add(&moments, p->points[i], 1);
    vs_point_moments_axes(&moments, &centre, axes, &size);
    if (!(size > 0)) break;
    for (int a = 0; a < 3; a++) {
      double sum = 0;
      for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
          const double c[3] = { centre.x, centre.y, centre.z };
          sum += axes[a][i] * axes[a][k] * (moments.square[i][k] / moments.weight - c[i] * c[k]);
        }
      square[a] = fmax(sum, 1e-4 * size * size);
    }
  }
  f->core_count = 0;
  for (size_t i = 0; i < p->count; i++)
    if (ellipsoid_square(p->points[i], centre, axes, square) <= CORE * limit) f->core[f->core_count++] = p->points[i];
}

/* ---- the start ---- */

typedef struct {
  vs_rigid_motion motion;
  double cost; /* mean size of the distances, none above NEAR */
  bool scaled; /* the model has its numbers by the scan's size, f->begin[1] */
  bool core;   /* it was found by the core */
  float distances[TRIED];
} place;

static int compare_places(const void *p, const void *q) {
  double a = ((const place *)p)->cost, b = ((const place *)q)->cost;
  return a < b ? -1 : a > b;
}

/* Do both lay every point as far from the model? A model that looks the same turned has many such. */
static bool same_place(const fit *f, const place *a, const place *b) {
  double apart = 0;
  for (size_t i = 0; i < f->count; i++) apart += fabs((double)a->distances[i] - (double)b->distances[i]);
  return apart < .1 * (double)f->count * fmin(a->cost, b->cost);
}

/* Sorts places, and leaves one of each that are the same. */
static void distinct_places(const fit *f, place *places, size_t *count) {
  size_t kept = 0;
  if (*count) qsort(places, *count, sizeof *places, compare_places);
  for (size_t i = 0; i < *count; i++) {
    bool known = false;
    for (size_t k = 0; k < kept && !known; k++) known = same_place(f, &places[k], &places[i]);
    if (!known && kept++ < i) places[kept - 1] = places[i];
  }
  *count = kept;
}

/* Measures the distances there. False: stopped. */
static bool cost_of(fit *f, place *at) {
  for (size_t i = 0; i < f->count; i++) f->places[i] = vs_rigid_point(&at->motion, f->points[i]);
  if (!measure(f, f->field, f->distances, NULL)) return false;
  at->cost = 0;
  for (size_t i = 0; i < f->count; i++) {
    double d = fmin(fabs(f->distances[i]), NEAR * f->out->size);
    at->distances[i] = (float)d;
    at->cost += d / (double)f->count;
  }
  return true;
}

/* The turn that lays the scan's axes on the model's, in the k-th of 24 ways, or (k >= 24) so and an eighth of a turn
 * about the model's first axis. */
static void axes_turned(int k, double model[3][3], double scan[3][3], double out[3][3]) {
  static const int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 } };
  double turned[3][3];
  memset(out, 0, 9 * sizeof(double));
  const int *order = orders[k % 24 / 4];
  int signs = k % 4;
  double sign[3] = { signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, 1 };
  sign[2] = (k % 24 / 4 < 3 ? 1 : -1) * sign[0] * sign[1]; /* no mirror */
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 3; c++) turned[i][c] = sign[i] * scan[order[i]][c];
  if (k >= 24)
    for (int c = 0; c < 3; c++) {
      double a = turned[1][c], b = turned[2][c];
      turned[1][c] = sqrt(.5) * (a - b), turned[2][c] = sqrt(.5) * (a + b);
    }
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 3; c++)
      for (int r = 0; r < 3; r++) out[i][c] += model[r][i] * turned[r][c];
}

/* The direction in which points spread most in plan, as an angle. */
static double plan_angle(const vs_point_moments *s) {
  double x = s->sum.x / s->weight, y = s->sum.y / s->weight, xx = s->square[0][0] / s->weight - x * x,
         xy = s->square[0][1] / s->weight - x * y, yy = s->square[1][1] / s->weight - y * y;
  return atan2(2 * xy, xx - yy) / 2;
}

static void turn_in_plan(double angle, double out[3][3]) {
  memset(out, 0, 9 * sizeof(double));
  out[0][0] = out[1][1] = cos(angle), out[1][0] = sin(angle), out[0][1] = -out[1][0], out[2][2] = 1;
}

static void span_along(const double axis[3], const vs_vec3 *points, size_t count, const vs_rigid_motion *m,
                       double span[2]) {
  span[0] = INFINITY, span[1] = -INFINITY;
  for (size_t i = 0; i < count; i++) {
    vs_vec3 p = m ? vs_rigid_point(m, points[i]) : points[i];
    double at = p.x * axis[0] + p.y * axis[1] + p.z * axis[2];
    span[0] = fmin(span[0], at), span[1] = fmax(span[1], at);
  }
}

/* A surface as step 1 sees it: its moments, axes and centre; of the model its extent along its axes, too. */
typedef struct {
  vs_point_moments moments;
  vs_vec3 centre;
  double axes[3][3], size, span[3][2];
  const vs_vec3 *points; /* of the scan: those that span its box */
  size_t count;
} shape;

/* Adds the places that one turn gives: with the boxes along the model's first axis laid middle on middle, end on end,
 * start on start, or centre on centre. */
static void add_turn(const fit *f, const shape *model, const shape *scan, double turn[3][3], place *places,
                     size_t *count) {
  for (int s = 0; s < SHIFTS; s++) {
    vs_rigid_motion m = f->motion;
    m.centre = scan->centre, m.to = model->centre;
    memcpy(m.turn, turn, sizeof m.turn);
    for (int a = 0; s < 3 && a < 3; a++) {
      double span[2];
      span_along(model->axes[a], scan->points, scan->count, &m, span);
      const double offs[3] = { (model->span[a][0] + model->span[a][1] - span[0] - span[1]) / 2,
                               model->span[a][0] - span[0], model->span[a][1] - span[1] };
      m.to = vs_v3_add(m.to, vs_v3_scale(vs_v3(model->axes[a][0], model->axes[a][1], model->axes[a][2]),
                                         offs[a == 0 ? s : 0]));
    }
    places[(*count)++].motion = m;
  }
}

/* Adds the places that lay one set of the scan's points on the model: axes on axes, and turns about the upright axis.
 * Unless any pose may be, what is up in the scan is up in the model. */
static void add_turns(const fit *f, shape *model, shape *scan, place *places, size_t *count) {
  double turn[3][3], angle = plan_angle(&model->moments) - plan_angle(&scan->moments);
  for (int k = 0; k < AXES_TURNS; k++) {
    axes_turned(k, model->axes, scan->axes, turn);
    if (f->p->any_pose || turn[2][2] > UPRIGHT) add_turn(f, model, scan, turn, places, count);
  }
  for (int k = 0; k < PLAN_TURNS; k++) {
    turn_in_plan(angle + 2 * acos(-1) * k / PLAN_TURNS, turn);
    add_turn(f, model, scan, turn, places, count);
  }
}

static void model_shape(const vs_mesh *mesh, shape *out) {
  *out = (shape){ .size = 0 };
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    vs_vec3 c[3];
    for (int k = 0; k < 3; k++) c[k] = mesh->vertices[mesh->triangles[i][k]];
    double area = vs_v3_length(vs_v3_cross(vs_v3_sub(c[1], c[0]), vs_v3_sub(c[2], c[0]))) / 2;
    for (int k = 0; k < 3; k++) /* by the middles of the sides, which is exact for squares */
      vs_point_moments_add(&out->moments, vs_v3_scale(vs_v3_add(c[k], c[(k + 1) % 3]), .5), area / 3);
  }
  if (!(out->moments.weight > 0)) return;
  vs_point_moments_axes(&out->moments, &out->centre, out->axes, &out->size);
  for (int a = 0; a < 3; a++) span_along(out->axes[a], mesh->vertices, mesh->vertex_count, NULL, out->span[a]);
}

/* The moments of so many points. */
static void scan_shape(const vs_vec3 *points, size_t count, size_t spanned, shape *out) {
  *out = (shape){ .points = points, .count = count < spanned ? count : spanned };
  for (size_t i = 0; i < count; i++) vs_point_moments_add(&out->moments, points[i], 1);
  vs_point_moments_axes(&out->moments, &out->centre, out->axes, &out->size);
}

/* Places to be tried; the first as the scan lies. */
static bool try_places(fit *f, const vs_mesh *mesh, place *places, size_t *count) {
  shape model, scan;
  model_shape(mesh, &model);
  scan_shape(f->core, f->core_count, f->count, &scan);
  f->out->size = scan.size, f->out->model_size = model.size;
  scan_shape(f->points, f->point_count, f->count, &scan);
  if (!(model.size > 0)) return vs_error_set(f->e, VS_ERROR_MODEL, NULL, "the model has no surface");
  *count = 0;
  f->motion = (vs_rigid_motion){ .size = f->out->size > 0 ? f->out->size : 1 };
  f->motion.turn[0][0] = f->motion.turn[1][1] = f->motion.turn[2][2] = 1;
  places[(*count)++].motion = f->motion;
  if (f->p->placed || f->p->near) return true;
  add_turn(f, &model, &scan, f->motion.turn, places, count);
  add_turns(f, &model, &scan, places, count);
  return true;
}

/* Are scan and model of a size? */
static bool same_unit(fit *f) {
  double ratio = f->out->size / f->out->model_size;
  if (!(f->out->size > 0)) return vs_error_set(f->e, VS_ERROR_FILE, NULL, "all points lie in one place");
  if (ratio > 20)
    return vs_error_set(f->e, VS_ERROR_FILE, NULL,
                        "the scan is %.0f times as large as the model: are both in the same unit?", ratio);
  return ratio > .02 ||
         vs_error_set(f->e, VS_ERROR_FILE, NULL,
                      "the scan is only %.2g times as large as the model: are both in the same unit?", ratio);
}

/* The places of the scan to be improved in the model with the numbers to start from, best first. False: failed,
 * stopped, or the model cannot be made; then the error says why. */
static bool find_places(fit *f, bool scaled, place *places, size_t *count) {
  vs_mesh mesh = { 0 };
  memcpy(f->made_at, f->begin[scaled], f->numbers * sizeof *f->made_at);
  f->out->models++;
  *count = 0;
  bool ok = f->p->model->make(f->p->model->context, f->made_at, scaled ? f->tolerance : 0, &mesh, f->e);
  if (ok && !mesh.triangle_count)
    ok = vs_error_set(f->e, VS_ERROR_MODEL, NULL, "the model draws no solid, from which distances could be measured");
  vs_mesh_distance_free(f->field);
  f->field = NULL;
  if (ok) {
    vs_bounds b = vs_mesh_bounds(&mesh);
    f->diagonal = vs_bounds_diagonal(&b);
    f->tolerance = f->diagonal * COARSE;
    if (!(f->field = vs_mesh_distance_new(&mesh))) ok = vs_error_memory(f->e, NULL);
  }
  f->count = f->point_count < TRIED ? f->point_count : TRIED;
  ok = ok && try_places(f, &mesh, places, count) && same_unit(f);
  vs_mesh_free(&mesh);
  if (!ok) return f->failed = true, false;
  for (size_t i = 0; i < *count; i++) {
    places[i].scaled = scaled, places[i].core = f->points == f->core;
    if (!cost_of(f, &places[i])) return false;
  }
  if (f->p->placed) return true;
  size_t kept = 1; /* the first, and of each rotation the best shift */
  for (size_t i = 1; i < *count; i += SHIFTS) {
    size_t best = i;
    for (size_t k = i + 1; k < i + SHIFTS; k++)
      if (places[k].cost < places[best].cost) best = k;
    places[kept++] = places[best];
  }
  *count = kept;
  distinct_places(f, places, count);
  return true;
}

/* ---- the motion alone, for the model as it is ---- */

static bool motion_residuals(void *context, const double *unknowns, double *out, double *slopes) {
  fit *f = context;
  double all[UNKNOWNS_MOST + VS_RIGID_UNKNOWNS];
  memcpy(all + f->numbers, unknowns, VS_RIGID_UNKNOWNS * sizeof *unknowns);
  vs_rigid_motion moved = vs_rigid_moved(&f->motion, unknowns);
  for (size_t i = 0; i < f->count; i++) f->places[i] = vs_rigid_point(&moved, f->points[i]);
  if (!measure(f, f->field, out, f->slopes)) return false;
  if (slopes) motion_slopes(f, all, slopes);
  if (slopes && f->level) memset(slopes, 0, 2 * f->count * sizeof *slopes);
  return true;
}

/* Improves a place. False: stopped or failed. */
static bool improve(fit *f, place *at) {
  double unknowns[VS_RIGID_UNKNOWNS] = { 0 }, mean;
  vs_robust_end end;
  f->motion = at->motion;
  if (!cost_of(f, at)) return false;
  f->level = !f->p->any_pose;
  for (int loss = VS_LOSS_HUBER; loss <= VS_LOSS_TUKEY; loss++) { /* Tukey's: rid of what strays pulled */
    vs_robust_problem problem = {
      f->count, VS_RIGID_UNKNOWNS, motion_residuals, f, (vs_loss)loss, spread_of(f), 20, 1e-4
    };
    memset(unknowns, 0, sizeof unknowns);
    if (!vs_robust_solve(&problem, unknowns, &mean, &end, f->e)) return f->failed = true, false;
    f->motion = at->motion = vs_rigid_moved(&f->motion, unknowns);
    if (end == VS_ROBUST_STOPPED || !cost_of(f, at)) return false;
    f->level = false;
  }
  return true;
}

/* ---- the way through ---- */

typedef struct {
  vs_rigid_motion motion;
  double unknowns[UNKNOWNS_MOST + VS_RIGID_UNKNOWNS], cost, spread;
  float distances[FIRST / 2];
  size_t known; /* distances */
  bool core;
} candidate;

/* The mean of Tukey's loss of its distances, from 0 to 1: about how many of the points are not the model's. */
static double score(const candidate *c, double spread) {
  double sum = 0, slope, most = VS_TUKEY_REACH * VS_TUKEY_REACH / 3;
  for (size_t i = 0; i < c->known; i++) {
    double root = vs_loss_root(VS_LOSS_TUKEY, (double)c->distances[i] / spread, &slope, NULL);
    sum += root * root / most;
  }
  return c->known ? sum / (double)c->known : 1;
}

/* Gives all candidates their cost, by the spread of the one with the least. */
static void rate(const fit *f, candidate *all, size_t count) {
  double spread = INFINITY;
  for (size_t i = 0; i < count; i++) spread = fmin(spread, all[i].spread);
  spread = fmax(spread, f->tolerance);
  for (size_t i = 0; i < count; i++) all[i].cost = score(&all[i], spread);
}

/* Are the numbers of two candidates apart by more than a twentieth? */
static bool apart(const fit *f, const candidate *a, const candidate *b) {
  for (size_t j = 0; j < f->numbers; j++) {
    double x = outer(&f->p->numbers[j], a->unknowns[j]), y = outer(&f->p->numbers[j], b->unknowns[j]);
    if (fabs(x - y) > .05 * fmax(fabs(x), fabs(y))) return true;
  }
  return false;
}

/* How far its numbers are from the start, by their size. */
static double from_start(const fit *f, const candidate *c) {
  double sum = 0;
  for (size_t j = 0; j < f->numbers; j++) {
    const vs_fit_number *n = &f->p->numbers[j];
    double off = (outer(n, c->unknowns[j]) - n->start) / scale_of(n);
    sum += off * off;
  }
  return sum;
}

/* Is a point in twenty or more otherwise off from the one than from the other? Else the two are the same shape. */
static bool unlike(const fit *f, const candidate *a, const candidate *b) {
  double spread = fmax(fmax(a->spread, b->spread), f->tolerance);
  size_t off = 0;
  for (size_t i = 0; i < a->known; i++) off += fabs((double)a->distances[i] - (double)b->distances[i]) > 2 * spread;
  return off * 20 > a->known;
}

/* Of the candidates, which came nearest; where another that is apart came as near (*second then is the nearest such),
 * the one with the numbers nearer to the start. */
static void choose(fit *f, candidate *all, size_t count, candidate *best, candidate *second) {
  rate(f, all, count);
  *best = all[0];
  for (size_t i = 1; i < count; i++)
    if (all[i].cost < best->cost) *best = all[i];
  second->cost = INFINITY;
  for (size_t i = 0; i < count; i++)
    if (all[i].cost < second->cost && apart(f, best, &all[i])) *second = all[i];
  f->out->rival = second->cost < 1.1 * best->cost + .02;
  f->out->rival_unlike = f->out->rival && unlike(f, best, second);
  if (!(second->cost < 1.02 * best->cost + .005) || from_start(f, second) >= from_start(f, best)) return;
  candidate held = *best;
  *best = *second, *second = held;
}

/* Fits all unknowns from a candidate's. False: failed; stopped is none, and leaves it as it was, or better. */
static bool advance(fit *f, candidate *c, size_t points, unsigned most, double tolerance) {
  double spread;
  bool refused;
  f->motion = c->motion;
  take_points(f, c->core);
  bool ok = !f->out->stopped && solve(f, VS_LOSS_TUKEY, points, 3, most, tolerance, c->unknowns, &spread);
  if (f->failed) return false;
  take_points(f, false);
  f->count = f->p->count < FIRST / 2 ? f->p->count : FIRST / 2;
  f->known = false;
  if (ok && evaluate(f, c->unknowns, &refused)) {
    c->known = f->count, c->spread = spread_of(f);
    for (size_t i = 0; i < c->known; i++) c->distances[i] = (float)f->distances[i];
  }
  settle(f, c->unknowns);
  c->motion = f->motion;
  return !f->failed;
}

static int compare_candidates(const void *p, const void *q) {
  double a = ((const candidate *)p)->cost, b = ((const candidate *)q)->cost;
  return a < b ? -1 : a > b;
}

/* Did both come to the same: numbers, and distances of all points? */
static bool same_candidate(const fit *f, const candidate *a, const candidate *b) {
  size_t count = f->p->count < FIRST / 2 ? f->p->count : FIRST / 2;
  double off = 0;
  for (size_t i = 0; i < count; i++) off += fabs((double)a->distances[i] - (double)b->distances[i]);
  return !apart(f, a, b) && off < .1 * (double)count * fmax(fmin(a->spread, b->spread), f->tolerance);
}

/* Where many points are not the model's, some number may be caught beside its value: a row of windows on the next.
 * Starts anew from the best with one number larger, or smaller. False: failed. */
static bool from_numbers(fit *f, candidate *best, candidate *second) {
  enum { NUMBERS_MOVED = 12 };
  candidate pair[2];
  bool better = false;
  for (size_t j = 0; j < f->numbers && j < NUMBERS_MOVED; j++)
    for (int side = -1; side <= 1 && !f->out->stopped; side += 2) {
      const vs_fit_number *n = &f->p->numbers[j];
      double x = outer(n, best->unknowns[j]);
      pair[0] = pair[1] = *best;
      pair[1].unknowns[j] = inner(n, fmin(fmax(x + side * MOVED * fmax(fabs(x), .1 * scale_of(n)), n->low), n->high));
      if (!advance(f, &pair[1], FIRST / 2, 12, 1e-3)) return false;
      rate(f, pair, 2);
      if (pair[1].cost < .95 * pair[0].cost) *best = pair[1], better = true;
    }
  if (better) {
    pair[0] = *best, pair[1] = *second;
    choose(f, pair, second->cost < INFINITY ? 2 : 1, best, second);
  }
  return true;
}

/* Step 2: all unknowns from the best places, a few iterations each; then the better half of those that are different to
 * the end. False: failed; stopped is none. */
static bool from_places(fit *f, const place *places, size_t count, candidate *best, candidate *second) {
  size_t starts = count < MOST_STARTS ? count : MOST_STARTS;
  candidate all[MOST_STARTS];
  for (size_t i = 0; i < starts; i++) {
    all[i] = (candidate){ .motion = places[i].motion, .core = places[i].core, .cost = INFINITY, .spread = INFINITY };
    for (size_t j = 0; j < f->numbers; j++)
      all[i].unknowns[j] = inner(&f->p->numbers[j], f->begin[places[i].scaled][j]);
    if (!advance(f, &all[i], FIRST / 2, 12, 1e-3)) return false;
  }
  rate(f, all, starts);
  qsort(all, starts, sizeof *all, compare_candidates);
  size_t kept = 0;
  for (size_t i = 0; i < starts; i++) {
    bool known = false;
    for (size_t k = 0; k < kept && !known; k++) known = same_candidate(f, &all[k], &all[i]);
    if (!known && kept++ < i) all[kept - 1] = all[i];
  }
  starts = kept > 2 ? (kept + 1) / 2 : kept;
  for (size_t i = 0; i < starts; i++)
    if (all[i].core = false, !advance(f, &all[i], FIRST, 25, 1e-4)) return false;
  choose(f, all, starts, best, second);
  return f->out->stopped || best->cost < DOUBTED || from_numbers(f, best, second);
}

/* ---- what the result is worth ---- */

double vs_student_quantile(double confidence, double freedom) {
  /* the normal quantile by bisection of erf, then Cornish and Fisher's terms */
  double low = 0, high = 40;
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

/* Intervals by Huber's covariance of an M-estimate, K^2 s^2 [sum psi^2 / (m - n)] / [mean psi']^2 (J'J)^-1, in natural
 * scales: numbers by their size, the motion by the scan's; beside it, what facets that are off by their tolerance would
 * shift. A parameter that changes no distance by a hundred-thousandth of the scan's size, when it changes by its own,
 * is not determined. */
static bool judge(fit *f, const double *unknowns) {
  size_t n = f->unknowns, m = f->count;
  double *work = NULL;
  size_t room = 0;
  bool refused;
  if (!evaluate(f, unknowns, &refused)) return !f->failed;
  if (!VS_GROW(work, room, n * m + 2 * n * n + 4 * n)) return f->failed = true, vs_error_memory(f->e, NULL);
  double *jacobian = work, *normal = work + n * m, *vectors = normal + n * n, *values = vectors + n * n,
         *scales = values + n;
  double *common = scales + n; /* of one shift of all distances: what facets that lie within a round shape make */
  double spread = spread_of(f), psi = 0, curvature = 0, curvature_square = 0, freedom = (double)m - (double)n;
  bool ok = true;
  for (size_t j = 0; ok && j < f->numbers; j++) {
    ok = number_slopes(f, j, jacobian + j * m);
    scales[j] = fmax(fabs(f->made_at[j]), .01 * scale_of(&f->p->numbers[j]));
  }
  if (ok && !f->p->placed) motion_slopes(f, unknowns, jacobian + f->numbers * m);
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

/* ---- neighbours ---- */

typedef struct {
  uint64_t key;
  double distance;
} neighbour;
static int compare_neighbours(const void *p, const void *q) {
  uint64_t a = ((const neighbour *)p)->key, b = ((const neighbour *)q)->key;
  return a < b ? -1 : a > b;
}

/* The place of a point on a curve that fills the box (Morton's). */
static uint64_t curve_key(vs_vec3 p, const vs_bounds *b, double side) {
  const double at[3] = { (p.x - b->min.x) / side, (p.y - b->min.y) / side, (p.z - b->min.z) / side };
  uint64_t key = 0;
  for (int k = 0; k < 3; k++) {
    uint64_t cell = (uint64_t)fmin(fmax(at[k], 0) * 2097151, 2097151);
    for (int bit = 0; bit < 21; bit++) key |= (cell >> bit & 1) << (3 * bit + k);
  }
  return key;
}

/* Of all points: spread, outliers, and how much neighbours agree. False: no memory, or stopped. */
static bool summarise(fit *f) {
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
    if (!(i & 1023)) going(f);
    f->out->distances[i] = vs_mesh_distance_at(f->field, vs_rigid_point(&f->out->motion, p->points[i]), NULL);
    vs_bounds_add(&b, p->points[i]);
  }
  f->out->median = median_size(f->out->distances, p->count, scratch);
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

/* Why the result cannot be trusted. */
static vs_fit_doubt doubt_of(const fit *f) {
  const vs_model_fit *o = f->out;
  const double(*turn)[3] = (const double(*)[3])o->motion.turn;
  if (o->median > .02 * o->size) return VS_FIT_DOUBT_FAR;
  if (!f->p->placed && !f->p->any_pose && !(turn[2][2] > UPRIGHT)) return VS_FIT_DOUBT_TILTED;
  if (o->outliers * 5 > f->p->count) return VS_FIT_DOUBT_STRAYS;
  if (o->correlation > .5 && o->spread > 1e-3 * o->size) return VS_FIT_DOUBT_SHAPE;
  for (size_t j = 0; o->rival_unlike && j < f->numbers; j++) {
    const vs_fitted_number *n = &o->numbers[j];
    bool other = fabs(n->value - n->rival) > .05 * fmax(fabs(n->value), fabs(n->rival));
    if (other && n->verdict != VS_FIT_NUMBER_LOOSE) return VS_FIT_DOUBT_RIVAL;
  }
  return VS_FIT_DOUBT_NONE;
}

/* Step 1, with the numbers as they are, or by the scan's size. Adds places, the best of them improved. False: failed.
 */
static bool step_one(fit *f, bool scaled, place *places, size_t *count) {
  size_t found;
  if (!find_places(f, scaled, places, &found)) return !f->failed; /* stopped: none was measured whole */
  if (found > PLACES) found = PLACES;
  for (size_t i = 0; !f->p->placed && i < found && !f->out->stopped; i++)
    if (!improve(f, &places[i]) && f->failed) return false;
  distinct_places(f, places, &found);
  *count += found < STARTS ? found : STARTS;
  return true;
}

/* The numbers times the size of the scan by that of the model. False: there are none, or both are about as large. */
static bool scale_numbers(fit *f) {
  double ratio = f->out->size / f->out->model_size;
  for (size_t j = 0; j < f->numbers; j++) {
    const vs_fit_number *n = &f->p->numbers[j];
    f->begin[1][j] = outer(n, inner(n, fmin(fmax(f->begin[0][j] * ratio, n->low), n->high)));
  }
  return f->numbers && fabs(log(ratio)) > .1;
}

/* Step 1 with both sets of numbers; the best STARTS of both. False: failed. */
static bool starts_of(fit *f, place *places, size_t *count) {
  if (!step_one(f, false, places, count)) return false;
  if (!f->out->stopped && scale_numbers(f) && !step_one(f, true, places + *count, count)) {
    if (f->e->kind != VS_ERROR_MODEL && f->e->kind != VS_ERROR_FILE) return false;
    f->failed = false; /* that model cannot be made: the other stands */
    *f->e = (vs_error){ 0 };
  }
  qsort(places, *count, sizeof *places, compare_places);
  if (*count > STARTS) *count = STARTS;
  return true;
}

static bool run(fit *f, place *places) {
  size_t count = 0;
  candidate best, second;
  double spread;
  const vs_fit_problem *p = f->p;
  for (size_t j = 0; j < f->numbers; j++)
    f->begin[0][j] = outer(&p->numbers[j], inner(&p->numbers[j], p->numbers[j].start));
  find_core(f);
  for (int core = f->core_count * 50 < p->count * 49; core >= 0 && !f->out->stopped; core--) {
    size_t found = 0;
    take_points(f, core);
    if (!starts_of(f, places + count, &found)) return false;
    count += found;
  }
  if (!count) return vs_error_set(f->e, VS_ERROR_INTERRUPT, NULL, "interrupted before anything was fitted");
  if (!from_places(f, places, count, &best, &second)) return false;
  f->motion = best.motion;
  f->tolerance = f->diagonal * FINE;
  vs_mesh_distance_free(f->field);
  f->field = NULL;
  const size_t counts[] = { 4 * FIRST, p->most };
  for (size_t i = 0; i < 2 && !f->out->stopped; i++) {
    if (!solve(f, VS_LOSS_TUKEY, counts[i], i ? 2 : 4, 25, 1e-6, best.unknowns, &spread) && f->failed) return false;
    settle(f, best.unknowns);
    if (p->count <= counts[i]) break;
  }
  for (size_t j = 0; j < f->numbers; j++) {
    f->out->numbers[j].value = outer(&p->numbers[j], best.unknowns[j]);
    f->out->numbers[j].rival = f->out->rival ? outer(&p->numbers[j], second.unknowns[j]) : 0;
    f->out->numbers[j].low = -INFINITY, f->out->numbers[j].high = INFINITY, f->out->numbers[j].error = INFINITY;
  }
  f->out->motion = f->motion;
  bool stopped = f->out->stopped, refused;
  if (!stopped && !judge(f, best.unknowns)) return false;
  numbers_of(f, best.unknowns, f->trial);
  if (!f->field || memcmp(f->trial, f->made_at, f->numbers * sizeof *f->trial)) {
    vs_mesh_distance *fresh;
    if (!make_field(f, f->trial, &fresh, &refused)) {
      if (!f->failed) vs_error_set(f->e, VS_ERROR_INTERRUPT, NULL, "interrupted before anything was fitted");
      return false;
    }
    vs_mesh_distance_free(f->field);
    f->field = fresh;
  }
  if (!summarise(f)) return false;
  f->out->doubt = doubt_of(f);
  return true;
}

bool vs_model_fit_solve(const vs_fit_problem *p, vs_model_fit *out, vs_error *e) {
  size_t numbers = p->number_count, unknowns = numbers + (p->placed ? 0 : VS_RIGID_UNKNOWNS), room = 0,
         rooms[8] = { 0 };
  *out = (vs_model_fit){ 0 };
  if (numbers > UNKNOWNS_MOST)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%zu parameters are more than the %d that can be fitted at once",
                        numbers, UNKNOWNS_MOST);
  if (p->count <= unknowns)
    return vs_error_set(e, VS_ERROR_FILE, NULL, "%zu point%s; to find %zu parameter%s%s needs more than %zu", p->count,
                        p->count == 1 ? "" : "s", numbers, numbers == 1 ? "" : "s",
                        p->placed ? "" : " and the scan's place", unknowns);
  fit f = { .p = p, .out = out, .e = e, .numbers = numbers, .unknowns = unknowns };
  size_t core_room = 0, most = p->most > 4 * FIRST ? p->most : 4 * FIRST;
  if (most > p->count) most = p->count;
  place *places = NULL;
  bool ok = VS_GROW(out->numbers, rooms[0], numbers + 1) && VS_GROW(out->distances, rooms[1], p->count) &&
            VS_GROW(f.at, rooms[2], 5 * (unknowns + 1)) && VS_GROW(f.places, rooms[3], most) &&
            VS_GROW(f.slopes, rooms[4], most) && VS_GROW(f.distances, rooms[5], 2 * most) &&
            VS_GROW(f.core, core_room, p->count) && VS_GROW(places, room, MOST_STARTS + PLACES_TRIED);
  if (ok) {
    memset(out->numbers, 0, (numbers + 1) * sizeof *out->numbers);
    memset(out->distances, 0, p->count * sizeof *out->distances);
    f.made_at = f.at + unknowns + 1, f.trial = f.made_at + unknowns + 1;
    f.begin[0] = f.trial + unknowns + 1, f.begin[1] = f.begin[0] + unknowns + 1;
    f.other = f.distances + most;
    ok = run(&f, places);
    out->field = f.field;
  } else
    vs_error_memory(e, NULL);
  free(f.at), free(f.places), free(f.slopes), free(f.distances), free(f.core), free(places);
  return ok;
}

void vs_model_fit_free(vs_model_fit *f) {
  vs_mesh_distance_free(f->field);
  free(f->numbers), free(f->distances);
  *f = (vs_model_fit){ 0 };
}
