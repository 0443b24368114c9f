/* Tests geometry/fitting/: loss functions, rigid motions, quantiles, and fits of a box that need no interpreter. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "geometry/fitting/distance_map.h"
#include "geometry/fitting/fit_judgement.h"
#include "geometry/fitting/model_fit.h"
#include "geometry/fitting/robust_squares.h"
#include "geometry/fitting/scan_points.h"

static void near(double a, double b, double off) {
  if (!(fabs(a - b) <= off)) fail_msg("%.12g is not %.12g, give or take %g", a, b, off);
}

/* Tests the loss functions. The slope must be the derivative of the square root of the loss. Weight times residual must
 * be the derivative of the loss. */
static void losses(void **state) {
  (void)state;
  for (int loss = VS_LOSS_HUBER; loss <= VS_LOSS_TUKEY; loss++)
    for (double r = -7.05; r < 7; r += .1) {
      double slope, weight, other, h = 1e-6;
      double f = vs_loss_root((vs_loss)loss, r, &slope, &weight);
      double more = vs_loss_root((vs_loss)loss, r + h, &other, NULL),
             less = vs_loss_root((vs_loss)loss, r - h, &other, NULL);
      near(slope, (more - less) / (2 * h), 1e-6);
      near(weight * r, (more * more - less * less) / (4 * h), 1e-6);
      if (fabs(r) < .5) near(f, r, .02);
    }
  double slope;
  near(pow(vs_loss_root(VS_LOSS_TUKEY, 100, &slope, NULL), 2) / 2, VS_TUKEY_REACH * VS_TUKEY_REACH / 6, 1e-12);
  near(slope, 0, 0);
  near(vs_loss_curvature(VS_LOSS_TUKEY, 0), 1, 0);
  near(vs_loss_curvature(VS_LOSS_TUKEY, 5), 0, 0);
}

static vs_rigid_motion some_motion(void) {
  vs_rigid_motion m = { .size = 2, .centre = { 1, 2, 3 }, .to = { -4, 5, 6 } };
  m.turn[0][1] = 1, m.turn[1][2] = 1, m.turn[2][0] = 1; /* a rotation that permutes the axes: it maps x to z, y to x, z
                                                         * to y */
  return m;
}

static void motions(void **state) {
  (void)state;
  vs_rigid_motion m = some_motion();
  const double at[VS_RIGID_UNKNOWNS] = { .8, -1.1, .5, .1, .2, .3 };
  vs_vec3 p = vs_v3(3, -1, 2);
  double jacobian[3][3];
  vs_rigid_motion moved = vs_rigid_moved(&m, at);
  vs_vec3 q = vs_rigid_point(&moved, p), arm = vs_v3_sub(q, moved.to);
  vs_rigid_jacobian(at, m.size, jacobian);
  for (int k = 0; k < VS_RIGID_UNKNOWNS; k++) {
    double more[VS_RIGID_UNKNOWNS];
    memcpy(more, at, sizeof at);
    more[k] += 1e-6;
    vs_rigid_motion other = vs_rigid_moved(&m, more);
    vs_vec3 by = vs_v3_scale(vs_v3_sub(vs_rigid_point(&other, p), q), 1e6), want = { 0, 0, 0 };
    if (k < 3)
      want = vs_v3_scale(vs_v3_cross(vs_v3(jacobian[0][k], jacobian[1][k], jacobian[2][k]), arm), 1 / m.size);
    else
      want = vs_v3(k == 3, k == 4, k == 5);
    near(vs_v3_length(vs_v3_sub(by, want)), 0, 1e-5);
  }
  vs_affine there = vs_rigid_map(&moved), back = vs_rigid_inverse(&moved);
  near(vs_v3_length(vs_v3_sub(vs_affine_point(&there, p), q)), 0, 1e-12);
  near(vs_v3_length(vs_v3_sub(vs_affine_point(&back, q), p)), 0, 1e-12);
  near(vs_affine_determinant(&there), 1, 1e-12);
}

static void eigenvectors(void **state) {
  (void)state;
  double m[9] = { 2, -1, 0, -1, 2, -1, 0, -1, 2 }, v[9], values[3];
  vs_symmetric_eigen(m, v, values, 3);
  near(values[0], 2 + sqrt(2), 1e-12), near(values[1], 2, 1e-12), near(values[2], 2 - sqrt(2), 1e-12);
  near(fabs(v[0]), .5, 1e-12), near(v[0] * v[1] + v[3] * v[4] + v[6] * v[7], 0, 1e-12);
}

static void quantiles(void **state) {
  (void)state; /* values from tables of Student's t distribution */
  near(vs_student_quantile(.95, 1e9), 1.959964, 1e-5);
  near(vs_student_quantile(.95, 30), 2.0423, 1e-3);
  near(vs_student_quantile(.99, 10), 3.1693, 2e-2);
}

/* ---- fits of a box with three unknown sides ---- */

typedef struct {
  unsigned made, asked, stop_at;
  bool small_only;
} boxes;

static bool make_box(void *context, const double *n, double tolerance, vs_mesh *out, vs_error *e) {
  boxes *b = context;
  static const uint32_t corners[12][3] = {
    { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
    { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 }
  };
  (void)tolerance;
  b->made++;
  if (b->small_only && n[0] > 2.5) return vs_error_set(e, VS_ERROR_MODEL, NULL, "too large");
  for (unsigned i = 0; i < 8; i++)
    if (!vs_mesh_add_vertex(out, vs_v3(i & 1 ? n[0] : 0, i & 2 ? n[1] : 0, i & 4 ? n[2] : 0), NULL)) return false;
  for (int i = 0; i < 12; i++)
    if (!vs_mesh_add_triangle(out, corners[i][0], corners[i][1], corners[i][2])) return false;
  return true;
}
static bool go_on(void *context) {
  boxes *b = context;
  return !b->stop_at || ++b->asked < b->stop_at;
}
static void ignore(void *context, unsigned iteration, double spread) { (void)context, (void)iteration, (void)spread; }

enum { POINTS = 1500 };

/* Computes points on the first `faces` sides of a box, and applies a rigid motion to them. Before the motion, the sixth
 * side has z = 0. The last `far` points are scattered far outside the box. */
static void scan_box(const double side[3], int faces, size_t far, vs_vec3 *out) {
  vs_rigid_motion m = some_motion();
  const double unknowns[VS_RIGID_UNKNOWNS] = { .4, .3, -.5 };
  m = vs_rigid_moved(&m, unknowns);
  uint64_t seed = 12345;
  for (size_t i = 0; i < POINTS; i++) {
    double at[3];
    for (int k = 0; k < 3; k++) {
      seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
      at[k] = (double)(seed >> 11) * 0x1p-53 * side[k];
    }
    int which = (int)(i % (size_t)faces);
    at[which / 2] = which % 2 ? 0 : side[which / 2];
    for (int k = 0; i >= POINTS - far && k < 3; k++) at[k] += 3 + at[(k + 1) % 3];
    out[i] = vs_rigid_point(&m, vs_v3(at[0], at[1], at[2]));
  }
}

static const vs_fit_number sides[3] = { { 2, .5, 10 }, { 1.4, .5, INFINITY }, { 1, -INFINITY, INFINITY } };
static const double truth[3] = { 2.3, 1.6, .9 };

static vs_fit_problem problem_of(const vs_fit_model *model, const vs_vec3 *points) {
  return (vs_fit_problem){ .model = model,
                           .numbers = sides,
                           .number_count = 3,
                           .points = points,
                           .count = POINTS,
                           .most = POINTS,
                           .any_pose = true,
                           .confidence = .95 };
}

/* Compares the fitted lengths of the box's sides with the true lengths in any order, because the box may be fitted
 * lying on another side. */
static void expect_sides(const vs_model_fit *f, double off) {
  for (int k = 0; k < 3; k++) {
    double best = INFINITY;
    for (int i = 0; i < 3; i++) best = fmin(best, fabs(f->numbers[i].value - truth[k]));
    near(best, 0, off);
  }
}

static void fits(void **state) {
  (void)state;
  static vs_vec3 points[POINTS];
  boxes b = { 0 };
  vs_fit_model model = { &b, make_box, go_on, ignore };
  vs_fit_problem p = problem_of(&model, points);
  vs_model_fit f;
  vs_error e = { 0 };
  scan_box(truth, 6, 0, points);
  assert_true(vs_model_fit_solve(&p, &f, &e));
  assert_true(f.converged && !f.stopped);
  expect_sides(&f, 1e-3);
  assert_int_equal(f.models, b.made);
  vs_model_fit_free(&f);
  scan_box(truth, 6, POINTS / 10, points); /* points on all six sides of the box, except a tenth of the points, which
                                            * are far outside */
  assert_true(vs_model_fit_solve(&p, &f, &e));
  expect_sides(&f, 5e-3);
  assert_true(f.outliers >= POINTS / 12 && f.outliers <= POINTS / 8);
  vs_model_fit_free(&f);
}

/* Returns a normal random number with mean 0 and standard deviation 1 (Box and Muller). */
static double normal_number(uint64_t *seed) {
  double u[2];
  for (int k = 0; k < 2; k++) {
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    u[k] = ((double)(*seed >> 11) + 1) * 0x1p-53;
  }
  return sqrt(-2 * log(u[0])) * cos(2 * 3.14159265358979323846 * u[1]);
}

/* Tests the confidence intervals of the fitted sides of boxes. Of 90 intervals of 95 %, about 85 must contain the true
 * length, with a standard deviation of 2. The width of the intervals must correspond to the actual errors. */
static void intervals(void **state) {
  (void)state;
  enum { SCANS = 30 };
  static vs_vec3 exact[POINTS], points[POINTS];
  uint64_t seed = 99;
  int held = 0;
  double squares = 0, widths = 0;
  scan_box(truth, 6, 0, exact);
  for (int scan = 0; scan < SCANS; scan++) {
    for (size_t i = 0; i < POINTS; i++) {
      vs_vec3 off = vs_v3(normal_number(&seed), normal_number(&seed), normal_number(&seed));
      points[i] = vs_v3_add(exact[i], vs_v3_scale(off, .01));
    }
    boxes b = { 0 };
    vs_fit_model model = { &b, make_box, go_on, ignore };
    vs_fit_problem p = problem_of(&model, points);
    p.count = p.most = 600;
    vs_model_fit f;
    vs_error e = { 0 };
    assert_true(vs_model_fit_solve(&p, &f, &e));
    for (int k = 0; k < 3; k++) {
      int nearest = 0;
      for (int i = 1; i < 3; i++)
        if (fabs(f.numbers[i].value - truth[k]) < fabs(f.numbers[nearest].value - truth[k])) nearest = i;
      const vs_fitted_number *n = &f.numbers[nearest];
      held += n->low <= truth[k] && truth[k] <= n->high;
      squares += (n->value - truth[k]) * (n->value - truth[k]);
      widths += n->error * n->error;
    }
    vs_model_fit_free(&f);
  }
  print_message("%d of %d intervals hold; errors %g, said %g\n", held, 3 * SCANS, sqrt(squares / 3 / SCANS),
                sqrt(widths / 3 / SCANS));
  assert_in_range(held, 80, 90);
  near(sqrt(widths / squares), 1, .2);
}

/* If a side of the box has no points, its position is unknown, so the fit must report a doubt. */
static void open_boxes(void **state) {
  (void)state;
  static vs_vec3 points[POINTS];
  boxes b = { 0 };
  vs_fit_model model = { &b, make_box, go_on, ignore };
  vs_fit_problem p = problem_of(&model, points);
  const vs_fit_number known[3] = { { 2.3, .5, 10 }, { 1.6, .5, 10 }, { 1.5, .5, 10 } };
  vs_model_fit f;
  vs_error e = { 0 };
  p.numbers = known;
  scan_box(truth, 5, 0, points);
  assert_true(vs_model_fit_solve(&p, &f, &e));
  int loose = 0;
  for (int k = 0; k < 3; k++) {
    bool open = f.numbers[k].verdict == VS_FIT_NUMBER_LOOSE;
    loose += open && f.numbers[k].error > 1e300;
    if (!open) near(fmin(fabs(f.numbers[k].value - 2.3), fabs(f.numbers[k].value - 1.6)), 0, .01);
  }
  assert_int_equal(loose, 1);
  vs_model_fit_free(&f);
}

/* If the model cannot be built for a trial value of its parameters, the fit must continue. */
static void refused_models(void **state) {
  (void)state;
  static vs_vec3 points[POINTS];
  boxes b = { .small_only = true };
  vs_fit_model model = { &b, make_box, go_on, ignore };
  vs_fit_problem p = problem_of(&model, points);
  vs_model_fit f;
  vs_error e = { 0 };
  scan_box(truth, 6, 0, points);
  assert_true(vs_model_fit_solve(&p, &f, &e));
  expect_sides(&f, 1e-2);
  vs_model_fit_free(&f);
}

/* A fit that is interrupted at any moment returns a result, or reports that it has none. */
static void stopped_fits(void **state) {
  (void)state;
  static vs_vec3 points[POINTS];
  scan_box(truth, 6, 0, points);
  size_t whole = 0, nothing = 0;
  for (unsigned at = 1; at < 4000; at = at * 3 / 2 + 1) {
    boxes b = { .stop_at = at };
    vs_fit_model model = { &b, make_box, go_on, ignore };
    vs_fit_problem p = problem_of(&model, points);
    vs_model_fit f;
    vs_error e = { 0 };
    if (vs_model_fit_solve(&p, &f, &e)) {
      for (int k = 0; k < 3; k++) assert_true(isfinite(f.numbers[k].value) && f.numbers[k].value > 0);
      assert_true(isfinite(f.median));
      whole++;
    } else {
      assert_int_equal(e.kind, VS_ERROR_INTERRUPT);
      nothing++;
    }
    vs_model_fit_free(&f);
  }
  assert_true(whole > 3 && nothing > 0);
}

/* ---- files of scanned points ---- */

static void clouds(void **state) {
  (void)state;
  const float at[2][3] = { { 1.5f, -2, 3 }, { 4, 5, 6.25f } };
  for (int big = 0; big < 2; big++) {
    unsigned char file[300];
    size_t n =
        (size_t)sprintf((char *)file,
                        "ply\nformat binary_%s_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n",
                        big ? "big" : "little");
    for (int i = 0; i < 6; i++) {
      uint32_t bits;
      memcpy(&bits, &at[i / 3][i % 3], 4);
      for (int k = 0; k < 4; k++) file[n++] = (unsigned char)(bits >> 8 * (big ? 3 - k : k));
    }
    vs_file_bytes ply = { "a.ply", file, n };
    vs_face_list read = { 0 };
    vs_scan_points scan;
    vs_error e = { 0 };
    assert_false(vs_mesh_file_read(&ply, (vs_poller){ 0 }, &read, &e)); /* a file without faces is not a solid */
    vs_face_list_free(&read);
    assert_true(vs_points_file_read(&ply, (vs_poller){ 0 }, true, &read, &e));
    assert_true(vs_scan_points_take(&read, 100, &scan, &e));
    assert_int_equal(scan.sample_count, 2);
    near(scan.file.points[1].z, 6.25, 0);
    vs_scan_points_free(&scan);
  }
}

/* Random points that are sampled on a mesh lie on the mesh, and the number on each face is proportional to the face's
 * area. */
static void samples(void **state) {
  (void)state;
  static const char text[] = "OFF\n4 2 0\n0 0 0\n3 0 0\n0 1 0\n0 -3 0\n3 0 1 2\n3 0 3 1\n";
  vs_file_bytes off = { "a.off", (const unsigned char *)text, sizeof text - 1 };
  vs_face_list read = { 0 };
  vs_scan_points scan;
  vs_error e = { 0 };
  size_t above = 0;
  assert_true(vs_points_file_read(&off, (vs_poller){ 0 }, true, &read, &e));
  assert_true(vs_scan_points_take(&read, 4000, &scan, &e));
  assert_int_equal(scan.sample_count, 4000);
  for (size_t i = 0; i < scan.sample_count; i++) {
    near(scan.samples[i].z, 0, 1e-12);
    above += scan.samples[i].y > 0;
  }
  near((double)above, 1000, 2); /* the upper faces have the area 1.5 and the lower faces 4.5, so a quarter of 4,000
                                 * points are expected above */
  vs_scan_points_free(&scan);
}

static void colours(void **state) {
  (void)state;
  double low[3], middle[3], high[3];
  vs_distance_colour(-9, low), vs_distance_colour(0, middle), vs_distance_colour(9, high);
  assert_true(low[2] > low[0] && high[0] > high[2]);
  near(middle[0], middle[2], .05);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(losses),         cmocka_unit_test(motions),      cmocka_unit_test(eigenvectors),
    cmocka_unit_test(quantiles),      cmocka_unit_test(fits),         cmocka_unit_test(open_boxes),
    cmocka_unit_test(intervals),
    cmocka_unit_test(refused_models), cmocka_unit_test(stopped_fits), cmocka_unit_test(clouds),
    cmocka_unit_test(samples),        cmocka_unit_test(colours),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
