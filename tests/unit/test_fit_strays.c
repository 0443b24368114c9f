/* Tests fits of a model of a facade to points that were scanned from one side. Points that are not on the facade are
 * called strays. The test's table has a cell for each kind of strays and each pose of the facade. A fit is right if
 * each fitted number is within a hundredth of its true value; a wrong fit must report a doubt. LONG=1 runs 100 seeds
 * for each cell, FITS=N runs N seeds. SHOW=1 prints the table, and each fit that is wrong or in doubt. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "geometry/fitting/model_fit.h"

/* ---- random numbers ---- */

static double share(uint64_t *seed) {
  *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  uint64_t x = *seed;
  x ^= x >> 33, x *= UINT64_C(0xff51afd7ed558ccd), x ^= x >> 33;
  return (double)(x >> 11) * 0x1p-53;
}
static double between(uint64_t *seed, double a, double b) { return a + (b - a) * share(seed); }
/* Returns a normally distributed random number (G. Box, M. Muller, 1958). */
static double normal(uint64_t *seed) { return sqrt(-2 * log(1 - share(seed))) * cos(2 * acos(-1) * share(seed)); }

/* ---- the facade: a wall of cells ----
 *
 * The tables below contain the positions of the divisions between cells along each axis, and whether each cell is full.
 * Three windows in two rows are set back; the plinth and the cornice project. The model has three numbers: width,
 * height, and the width of a window. */

enum { NUMBERS = 3, ALONG = 7, DEEP = 4, UP = 7 };

static bool full(int i, int j, int k) {
  if (i < 0 || i >= ALONG || j < 0 || j >= DEEP || k < 0 || k >= UP) return false;
  bool window = i % 2 == 1 && (k == 2 || k == 4), plinth = k == 0, cornice = k == UP - 1;
  return j == 0 ? cornice : j == 1 ? cornice || plinth : j == 2 ? !window : true;
}

static bool breaks(const double *n, double x[ALONG + 1], double y[DEEP + 1], double z[UP + 1]) {
  static const double depths[DEEP + 1] = { -.3, -.15, 0, .25, .5 };
  const double heights[UP + 1] = { 0, .8, .2 * n[1], .2 * n[1] + 1.6, .6 * n[1], .6 * n[1] + 1.6, n[1] - .4, n[1] };
  x[0] = 0, x[ALONG] = n[0];
  for (int c = 0; c < 3; c++) {
    double middle = n[0] * (c + .5) / 3;
    x[2 * c + 1] = middle - n[2] / 2, x[2 * c + 2] = middle + n[2] / 2;
  }
  memcpy(y, depths, sizeof depths), memcpy(z, heights, sizeof heights);
  bool rising = true;
  for (int i = 0; i < ALONG; i++) rising = rising && x[i] + .01 < x[i + 1] && z[i] + .01 < z[i + 1];
  return rising;
}

typedef void quad_fn(void *context, int axis, bool low, const int at[3]);

/* Calls fn for each side of a full cell next to an empty cell. fn receives the lower corner of the cell in `at`, or the
 * corner one cell further for the cell's upper side. */
static void each_side(quad_fn *fn, void *context) {
  for (int i = 0; i < ALONG; i++)
    for (int j = 0; j < DEEP; j++)
      for (int k = 0; k < UP; k++)
        for (int axis = 0; axis < 3 && full(i, j, k); axis++)
          for (int low = 0; low < 2; low++) {
            int next[3] = { i, j, k }, at[3] = { i, j, k };
            next[axis] += low ? -1 : 1, at[axis] += !low;
            if (!full(next[0], next[1], next[2])) fn(context, axis, low, at);
          }
}

typedef struct {
  double x[ALONG + 1], y[DEEP + 1], z[UP + 1];
  vs_mesh *out;
  int32_t index[ALONG + 1][DEEP + 1][UP + 1];
  bool ok;
} wall;

static uint32_t corner(wall *w, int i, int j, int k) {
  int32_t *known = &w->index[i][j][k];
  if (*known < 0) {
    *known = (int32_t)w->out->vertex_count;
    w->ok = vs_mesh_add_vertex(w->out, vs_v3(w->x[i], w->y[j], w->z[k]), NULL) && w->ok;
  }
  return (uint32_t)*known;
}
static void add_side(void *context, int axis, bool low, const int at[3]) {
  wall *w = context;
  int a = (axis + 1) % 3, b = (axis + 2) % 3;
  uint32_t c[4];
  for (int n = 0; n < 4; n++) {
    int p[3] = { at[0], at[1], at[2] };
    p[a] += n == 1 || n == 2, p[b] += n >= 2;
    c[low ? 3 - n : n] = corner(w, p[0], p[1], p[2]);
  }
  w->ok = vs_mesh_add_triangle(w->out, c[0], c[1], c[2]) && vs_mesh_add_triangle(w->out, c[0], c[2], c[3]) && w->ok;
}

static bool make_wall(void *context, const double *n, double tolerance, vs_mesh *out, vs_error *e) {
  wall w = { .out = out, .ok = true };
  (void)context, (void)tolerance;
  if (!breaks(n, w.x, w.y, w.z)) return vs_error_set(e, VS_ERROR_MODEL, NULL, "the windows do not fit in");
  memset(w.index, -1, sizeof w.index);
  each_side(add_side, &w);
  return w.ok || vs_error_memory(e, NULL);
}
static bool go_on(void *context) { return (void)context, true; }
static void ignore(void *context, unsigned iteration, double spread) { (void)context, (void)iteration, (void)spread; }

/* ---- the scan ---- */

enum { POINTS = 2000, SIDES = 400 };

typedef struct {
  wall w;
  vs_vec3 eye, low[SIDES], high[SIDES];
  double sums[SIDES];
  size_t count;
} seen_sides;

/* Stores a side of a cell if the scanner can see it. */
static void see(void *context, int axis, bool low, const int at[3]) {
  seen_sides *s = context;
  int past[3] = { at[0], at[1], at[2] };
  past[(axis + 1) % 3]++, past[(axis + 2) % 3]++;
  vs_vec3 a = vs_v3(s->w.x[at[0]], s->w.y[at[1]], s->w.z[at[2]]),
          b = vs_v3(s->w.x[past[0]], s->w.y[past[1]], s->w.z[past[2]]), d = vs_v3_sub(b, a), to = vs_v3_sub(s->eye, a);
  double by[3] = { to.x, to.y, to.z };
  if ((by[axis] > 0) == low || s->count == SIDES) return;
  double area = axis == 0 ? d.y * d.z : axis == 1 ? d.x * d.z : d.x * d.y;
  s->low[s->count] = a, s->high[s->count] = b;
  s->sums[s->count] = area + (s->count ? s->sums[s->count - 1] : 0);
  s->count++;
}

typedef enum { ANYWHERE, TREE, GROUND, STRAY_KINDS } stray_kind;

/* Returns a stray, a point that is not on the facade. Depending on the kind, the point is anywhere around the facade,
 * in a tree in front of it, or on the ground or in the tree. */
static vs_vec3 stray(stray_kind kind, const double *n, uint64_t *seed) {
  if (kind == ANYWHERE)
    return vs_v3(between(seed, -.25 * n[0], 1.25 * n[0]), between(seed, -6, 1), between(seed, -.5, 1.3 * n[1]));
  if (kind == GROUND && share(seed) < .6)
    return vs_v3(between(seed, -2, n[0] + 2), between(seed, -6, 0), .01 * normal(seed));
  return vs_v3(.6 * n[0] + normal(seed), -3 + .8 * normal(seed), 2.6 + normal(seed));
}

/* Returns the rotation about the axis (x y z) by an angle in degrees, followed by the translation `to`. */
static vs_rigid_motion turned(double x, double y, double z, double degrees, vs_vec3 to) {
  vs_rigid_motion m = { .size = 1, .to = to };
  double w[VS_RIGID_UNKNOWNS] = { 0 }, length = sqrt(x * x + y * y + z * z), angle = degrees * acos(-1) / 180;
  for (int k = 0; k < 3; k++) m.turn[k][k] = 1;
  w[0] = x / length * angle, w[1] = y / length * angle, w[2] = z / length * angle;
  return vs_rigid_moved(&m, w);
}

typedef struct {
  const char *name;
  double axis[3], degrees;
  vs_vec3 to;
} pose;
static const pose poses[] = {
  { "as it lies", { 0, 0, 1 }, 0, { 0, 0, 0 } },
  { "turned 3", { .2, .1, 1 }, 3, { .3, -.2, .1 } },
  { "turned 40", { 0, 0, 1 }, 40, { 20, -7, 3 } },
  { "turned 155", { .03, -.02, 1 }, 155, { -5, 12, 1 } },
};
enum { POSES = sizeof poses / sizeof *poses };

static void scan_wall(const double *n, double strays, const pose *at, uint64_t seed, vs_vec3 *out) {
  static seen_sides s;
  vs_rigid_motion m = turned(at->axis[0], at->axis[1], at->axis[2], at->degrees, at->to);
  stray_kind kind = (stray_kind)(seed % STRAY_KINDS);
  s = (seen_sides){ .eye = vs_v3(-2, -9, 1.6) };
  assert_true(breaks(n, s.w.x, s.w.y, s.w.z));
  each_side(see, &s);
  for (size_t i = 0; i < POINTS; i++) {
    vs_vec3 p;
    if ((double)i < strays * POINTS) {
      p = stray(kind, n, &seed);
    } else {
      size_t k = 0;
      double place = share(&seed) * s.sums[s.count - 1];
      while (k + 1 < s.count && s.sums[k] < place) k++;
      p = vs_v3(between(&seed, s.low[k].x, s.high[k].x), between(&seed, s.low[k].y, s.high[k].y),
                between(&seed, s.low[k].z, s.high[k].z));
    }
    vs_vec3 off = vs_v3(normal(&seed), normal(&seed), normal(&seed));
    out[i] = vs_rigid_point(&m, vs_v3_add(p, vs_v3_scale(off, .005)));
  }
  for (size_t i = POINTS; i > 1; i--) { /* shuffles the points */
    size_t k = (size_t)(share(&seed) * (double)i);
    vs_vec3 held = out[i - 1];
    out[i - 1] = out[k], out[k] = held;
  }
}

/* ---- the table ---- */

typedef struct {
  unsigned right, doubted, wrong;
} cell;

static void fit_one(double strays, const pose *at, unsigned number, cell *to) {
  static vs_vec3 points[POINTS];
  static const vs_fit_number start[NUMBERS] = { { 10, 4, 30 }, { 7, 4, 20 }, { 1.4, .3, 3 } };
  uint64_t seed = number * UINT64_C(7919) + 17;
  double truth[NUMBERS];
  for (int k = 0; k < NUMBERS; k++) truth[k] = start[k].start * between(&seed, .88, 1.12);
  scan_wall(truth, strays, at, seed / STRAY_KINDS * STRAY_KINDS + number % STRAY_KINDS, points);
  vs_fit_model model = { NULL, make_wall, go_on, ignore };
  vs_fit_problem p = { .model = &model, .numbers = start, .number_count = NUMBERS, .points = points, .count = POINTS,
                       .most = POINTS, .confidence = .95 };
  vs_model_fit f;
  vs_error e = { 0 };
  assert_true(vs_model_fit_solve(&p, &f, &e));
  bool right = true;
  for (int k = 0; k < NUMBERS; k++) right = right && fabs(f.numbers[k].value / truth[k] - 1) < .01;
  bool doubted = f.doubt != VS_FIT_DOUBT_NONE;
  to->right += right && !doubted, to->doubted += doubted, to->wrong += !right && !doubted;
  if (getenv("SHOW") && (doubted || !right))
    print_message("%s, %g %%, seed %u, kind %u: %s%s: %.4g/%.4g %.4g/%.4g %.4g/%.4g; spread %.3g, correlation %.2f, "
                  "outliers %.1f %%, doubt %d, converged %d\n",
                  at->name, 100 * strays, number, number % STRAY_KINDS, right ? "right" : "WRONG",
                  doubted ? ", in doubt" : "",
                  f.numbers[0].value, truth[0], f.numbers[1].value, truth[1], f.numbers[2].value, truth[2], f.spread,
                  f.correlation, 100. * (double)f.outliers / POINTS, f.doubt, f.converged);
  vs_model_fit_free(&f);
}

static void table(void **state) {
  (void)state;
  const char *longer = getenv("LONG");
  int whole = (longer && *longer) || getenv("FITS");
  unsigned seeds = whole ? 100 : 1, wrong = 0, few = 0;
  if (getenv("FITS")) seeds = (unsigned)atoi(getenv("FITS"));
  for (int five = !whole; five <= 5; five += whole ? 1 : 2)
    for (int k = 0; k < POSES; k++) {
      cell c = { 0 };
      for (unsigned n = 0; n < seeds; n++) fit_one(.05 * five, &poses[k], n, &c);
      if (getenv("SHOW"))
        print_message("strays %2d %%, %-10s: %u right, %u in doubt, %u wrong of %u\n", 5 * five, poses[k].name, c.right,
                      c.doubted, c.wrong, seeds);
      wrong += c.wrong, few += five <= 3 && c.right * 100 < 95 * seeds;
    }
  assert_int_equal(wrong, 0);
  assert_int_equal(few, 0); /* few: number of the table's cells that have too few right fits */
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(table) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
