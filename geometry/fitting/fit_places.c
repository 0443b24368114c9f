/* Implements step 1 of a fit (fit_places.h): it finds possible places of the scan in the model. */
#include "geometry/fitting/fit_places.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  STARTS = VS_FIT_STARTS_MOST / 2, /* greatest number of starts of a fit that are found with all points; as many are
                                    * found with the core (the points without stray points) */
  PLACES = 24,                     /* number of placements of the scan (poses in which it may lie in the model) that are
                                    * improved by a fit of the motion alone */
  AXES_TURNS = 48,
  PLAN_TURNS = 12,
  SHIFTS = 4
};
_Static_assert(1 + SHIFTS * (1 + AXES_TURNS + PLAN_TURNS) == VS_FIT_PLACES_TRIED, "all that are tried have room");
#define COARSE (1. / 2000) /* facet tolerance of the model's mesh in steps 1 and 2 of the fit, as a fraction of the
                            * diagonal of the model's box */
#define NEAR .1 /* distance of a point from the model beyond which its cost no longer grows, as a fraction of the scan's
                 * size */
#define CORE 2.5 /* A point belongs to the core (scan without stray points) if its squared distance, as measured by an
                  * ellipsoid, is at most this multiple of the one that contains three quarters of the points. */

/* ---- the core of a scan ----
 *
 * Stray points shift the centre of the points and rotate their axes. Therefore this code searches for three quarters of
 * the points with a small ellipsoid, by the steps of P. Rousseeuw and K. Van Driessen (1999): repeatedly keep the
 * points that are nearest as measured by the ellipsoid of the kept points. Then all points within CORE times its square
 * radius are added again. */

/* Returns the squared distance of p from the centre. Along each axis, the unit of length is the spread of the
 * points. */
static double ellipsoid_square(vs_vec3 p, vs_vec3 centre, double axes[3][3], const double square[3]) {
  vs_vec3 d = vs_v3_sub(p, centre);
  double sum = 0;
  for (int a = 0; a < 3; a++) {
    double along = d.x * axes[a][0] + d.y * axes[a][1] + d.z * axes[a][2];
    sum += along * along / square[a];
  }
  return sum;
}

void vs_fit_find_core(vs_fit_search *f) {
  enum { SEEN = 2000, STEPS = 12 };
  const vs_fit_problem *p = f->p;
  size_t n = p->count < SEEN ? p->count : SEEN, half = n * 3 / 4;
  vs_vec3 centre;
  double axes[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, square[3] = { 1, 1, 1 }, limit = 0, scratch[SEEN];
  double middle[3];
  for (int a = 0; a < 3; a++) {
    for (size_t i = 0; i < n; i++) scratch[i] = a == 0 ? p->points[i].x : a == 1 ? p->points[i].y : p->points[i].z;
    qsort(scratch, n, sizeof *scratch, vs_fit_compare);
    middle[a] = scratch[n / 2];
  }
  centre = vs_v3(middle[0], middle[1], middle[2]);
  for (int step = 0; step < STEPS; step++) {
    vs_point_moments moments = { 0 };
    double size;
    for (size_t i = 0; i < n; i++) scratch[i] = ellipsoid_square(p->points[i], centre, axes, square);
    qsort(scratch, n, sizeof *scratch, vs_fit_compare);
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

/* ---- places of the scan in the model ---- */

static int compare_places(const void *p, const void *q) {
  double a = ((const vs_fit_place *)p)->cost, b = ((const vs_fit_place *)q)->cost;
  return a < b ? -1 : a > b;
}

/* Returns true if every point has equal distances from the model in places a and b. A model with rotational symmetry
 * has many such places. */
static bool same_place(const vs_fit_search *f, const vs_fit_place *a, const vs_fit_place *b) {
  double apart = 0;
  for (size_t i = 0; i < f->count; i++) apart += fabs((double)a->distances[i] - (double)b->distances[i]);
  return apart < .1 * (double)f->count * fmin(a->cost, b->cost);
}

/* Sorts the places of the scan by cost, and removes places that equal another one. */
static void distinct_places(const vs_fit_search *f, vs_fit_place *places, size_t *count) {
  size_t kept = 0;
  if (*count) qsort(places, *count, sizeof *places, compare_places);
  for (size_t i = 0; i < *count; i++) {
    bool known = false;
    for (size_t k = 0; k < kept && !known; k++) known = same_place(f, &places[k], &places[i]);
    if (!known && kept++ < i) places[kept - 1] = places[i];
  }
  *count = kept;
}

/* For the placement `at` of the scan, computes the points' distances from the model and the placement's cost. Returns
 * false when interrupted. */
static bool cost_of(vs_fit_search *f, vs_fit_place *at) {
  for (size_t i = 0; i < f->count; i++) f->places[i] = vs_rigid_point(&at->motion, f->points[i]);
  if (!vs_fit_measure(f, f->field, f->distances, NULL)) return false;
  at->cost = 0;
  for (size_t i = 0; i < f->count; i++) {
    double d = fmin(fabs(f->distances[i]), NEAR * f->out->size);
    at->distances[i] = (float)d;
    at->cost += d / (double)f->count;
  }
  return true;
}

/* Computes rotation k of those that map the scan's axes to the model's axes: 24 choices of signs and order. For k >=
 * 24, it is rotation k % 24, followed by an eighth of a turn about the model's first axis. */
static void axes_turned(int k, double model[3][3], double scan[3][3], double out[3][3]) {
  static const int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 } };
  double turned[3][3];
  VS_ASSERT(k >= 0);
  memset(out, 0, 9 * sizeof(double));
  const int *order = orders[k % 24 / 4];
  int signs = k % 4;
  double sign[3] = { signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, 1 };
  sign[2] = (k % 24 / 4 < 3 ? 1 : -1) * sign[0] * sign[1]; /* the sign of the third axis makes the map a rotation
                                                            * instead of a reflection */
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

/* Returns the horizontal direction in which the points have the greatest spread, as an angle in radians from +X. */
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

/* The shape of the scan or of the model: its moments, axes and centre; for the model also its extent along its axes. */
typedef struct {
  vs_point_moments moments;
  vs_vec3 centre;
  double axes[3][3], size, span[3][2];
  const vs_vec3 *points; /* points of the scan; the first `spanned` of them span the scan's bounding box */
  size_t count;
} shape;

/* Adds the places of the scan with the rotation `turn`, one for each of SHIFTS ways to align it with the model along
 * the model's first axis: by their middles, ends or centres. */
static void add_turn(const vs_fit_search *f, const shape *model, const shape *scan, double turn[3][3],
                     vs_fit_place *places, size_t *count) {
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

/* Adds places of the scan that align its axes with the model's axes, and places rotated about the vertical axis. Skips
 * places where the scan would lie on its side, unless any pose is allowed. */
static void add_turns(const vs_fit_search *f, shape *model, shape *scan, vs_fit_place *places, size_t *count) {
  double turn[3][3], angle = plan_angle(&model->moments) - plan_angle(&scan->moments);
  for (int k = 0; k < AXES_TURNS; k++) {
    axes_turned(k, model->axes, scan->axes, turn);
    if (f->p->any_pose || turn[2][2] > VS_FIT_UPRIGHT) add_turn(f, model, scan, turn, places, count);
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
    for (int k = 0; k < 3; k++) /* computes the moments of a triangle from the midpoints of its sides, which is exact
                                 * for squares of coordinates */
      vs_point_moments_add(&out->moments, vs_v3_scale(vs_v3_add(c[k], c[(k + 1) % 3]), .5), area / 3);
  }
  if (!(out->moments.weight > 0)) return;
  vs_point_moments_axes(&out->moments, &out->centre, out->axes, &out->size);
  for (int a = 0; a < 3; a++) span_along(out->axes[a], mesh->vertices, mesh->vertex_count, NULL, out->span[a]);
}

/* Computes the moments of the scan's points, and from them its centre and axes. The first `spanned` points span its
 * box. */
static void scan_shape(const vs_vec3 *points, size_t count, size_t spanned, shape *out) {
  *out = (shape){ .points = points, .count = count < spanned ? count : spanned };
  for (size_t i = 0; i < count; i++) vs_point_moments_add(&out->moments, points[i], 1);
  vs_point_moments_axes(&out->moments, &out->centre, out->axes, &out->size);
}

/* Collects the places of the scan that are to be evaluated, beginning with its present place. Returns false on
 * failure. */
static bool try_places(vs_fit_search *f, const vs_mesh *mesh, vs_fit_place *places, size_t *count) {
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

/* Returns true if scan and model probably have the same unit of length: the ratio of their sizes is between .02 and
 * 20. */
static bool same_unit(vs_fit_search *f) {
  double ratio = f->out->size / f->out->model_size;
  if (!(f->out->size > 0)) return vs_error_set(f->e, VS_ERROR_FILE, NULL, "all points lie in one place");
  if (ratio > 20)
    return vs_error_set(f->e, VS_ERROR_FILE, NULL,
                        "the scan is %.0f times as large as the model: are both in the same unit?", ratio);
  return ratio > .02 ||
         vs_error_set(f->e, VS_ERROR_FILE, NULL,
                      "the scan is only %.2g times as large as the model: are both in the same unit?", ratio);
}

/* Finds the best places of the scan in the model, in order of cost. scaled: true for the scaled start numbers, false
 * for the caller's. Returns false on failure or interruption. */
static bool find_places(vs_fit_search *f, bool scaled, vs_fit_place *places, size_t *count) {
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
  f->count = f->point_count < VS_FIT_TRIED ? f->point_count : VS_FIT_TRIED;
  ok = ok && try_places(f, &mesh, places, count) && same_unit(f);
  vs_mesh_free(&mesh);
  if (!ok) return f->failed = true, false;
  for (size_t i = 0; i < *count; i++) {
    places[i].scaled = scaled, places[i].core = f->points == f->core;
    if (!cost_of(f, &places[i])) return false;
  }
  if (f->p->placed) return true;
  size_t kept = 1; /* keeps the scan's present place, which is the first, and for each rotation the shift with the least
                    * cost */
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

/* ---- fit of the motion alone, with the model unchanged ---- */

static bool motion_residuals(void *context, const double *unknowns, double *out, double *slopes) {
  vs_fit_search *f = context;
  double all[VS_FIT_UNKNOWNS_MOST + VS_RIGID_UNKNOWNS];
  memcpy(all + f->numbers, unknowns, VS_RIGID_UNKNOWNS * sizeof *unknowns);
  vs_rigid_motion moved = vs_rigid_moved(&f->motion, unknowns);
  for (size_t i = 0; i < f->count; i++) f->places[i] = vs_rigid_point(&moved, f->points[i]);
  if (!vs_fit_measure(f, f->field, out, f->slopes)) return false;
  if (slopes) vs_fit_motion_slopes(f, all, slopes);
  if (slopes && f->level) memset(slopes, 0, 2 * f->count * sizeof *slopes);
  return true;
}

/* Improves a place of the scan by a fit of the motion. Returns false when interrupted or failed. */
static bool improve(vs_fit_search *f, vs_fit_place *at) {
  double unknowns[VS_RIGID_UNKNOWNS] = { 0 }, mean;
  vs_robust_end end;
  f->motion = at->motion;
  if (!cost_of(f, at)) return false;
  f->level = !f->p->any_pose;
  for (int loss = VS_LOSS_HUBER; loss <= VS_LOSS_TUKEY; loss++) { /* begins with Huber's loss; then Tukey's loss removes
                                                                   * the influence of stray points */
    vs_robust_problem problem = {
      f->count, VS_RIGID_UNKNOWNS, motion_residuals, f, (vs_loss)loss, vs_fit_spread(f), 20, 1e-4
    };
    memset(unknowns, 0, sizeof unknowns);
    if (!vs_robust_solve(&problem, unknowns, &mean, &end, f->e)) return f->failed = true, false;
    f->motion = at->motion = vs_rigid_moved(&f->motion, unknowns);
    if (end == VS_ROBUST_STOPPED || !cost_of(f, at)) return false;
    f->level = false;
  }
  return true;
}

/* ---- step 1 ---- */

/* Runs step 1 of the fit: appends the best places of the scan in the model. scaled: true if the start numbers are
 * scaled by the scan's size. Returns false on failure. */
static bool step_one(vs_fit_search *f, bool scaled, vs_fit_place *places, size_t *count) {
  size_t found;
  if (!find_places(f, scaled, places, &found)) return !f->failed; /* if the search was interrupted before any place was
                                                                   * evaluated completely, that is no failure */
  if (found > PLACES) found = PLACES;
  for (size_t i = 0; !f->p->placed && i < found && !f->out->stopped; i++)
    if (!improve(f, &places[i]) && f->failed) return false;
  distinct_places(f, places, &found);
  *count += found < STARTS ? found : STARTS;
  return true;
}

/* Multiplies the model's numbers by the ratio of the scan's size to the model's. Returns false if there are no numbers,
 * or both sizes are about equal. */
static bool scale_numbers(vs_fit_search *f) {
  double ratio = f->out->size / f->out->model_size;
  for (size_t j = 0; j < f->numbers; j++) {
    const vs_fit_number *n = &f->p->numbers[j];
    double scaled = fmin(fmax(f->begin[0][j] * ratio, n->low), n->high);
    f->begin[1][j] = vs_fit_number_outer(n, vs_fit_number_inner(n, scaled));
  }
  return f->numbers && fabs(log(ratio)) > .1;
}

bool vs_fit_find_starts(vs_fit_search *f, vs_fit_place *places, size_t *count) {
  if (!step_one(f, false, places, count)) return false;
  if (!f->out->stopped && scale_numbers(f) && !step_one(f, true, places + *count, count)) {
    if (f->e->kind != VS_ERROR_MODEL && f->e->kind != VS_ERROR_FILE) return false;
    f->failed = false; /* the model with scaled numbers cannot be made, so the search uses only the start numbers */
    *f->e = (vs_error){ 0 };
  }
  qsort(places, *count, sizeof *places, compare_places);
  if (*count > STARTS) *count = STARTS;
  return true;
}
