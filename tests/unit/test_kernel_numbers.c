/* Tests the exact numbers of the mesh kernel against GMP: signs of doubles, intersections of planes, and geometric
 * predicates. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gmp.h>

#include "kernel/exact/doubles.h"
#include "kernel/exact/exact.h"
#include "kernel/mesh/triangles_meet.h"
#include "tests/tools/crossings.h"
#include "tests/unit/dice.h"

static dice thrown = { 88172645463325252u };
static int32_t span(int32_t low, int32_t high) { return whole_between(&thrown, low, high); }

/* ---- doubles, converted exactly ---- */

/* Returns a coordinate near one of a few numbers, so that corners are often on edges and planes. The numbers are
 * integers, integers changed in the last bit, thirds, or random. */
static double place_near(int round) {
  double x = span(-2, 2);
  switch (round % 4) {
  case 0: return x;
  case 1: return span(0, 7) ? x : x != 0 ? nextafter(x, 9) : 0x1p-53;
  case 2: return x / 3;
  default: return span(0, 1) ? x * 1e-5 + 0.1 : x / 3;
  }
}

static void test_doubles(void **state) {
  (void)state;
  size_t zeros = 0, kinds[3] = { 0 };
  crossings_found found;
  for (int round = 0; round < 24000; round++) {
    crossings_point at[6];
    for (int i = 0; i < 18; i++) at[i / 3][i % 3] = place_near(round) * (round % 5 == 4 ? 0x1p-300 : 1);
    crossings c = { .at = (const crossings_point *)at };
    for (int i = 0; i < 12; i++) mpz_init(c.x[i]);
    for (int i = 0; i < 8; i++) mpz_init(c.t[i]);
    vs_vec3 p[6];
    for (int i = 0; i < 6; i++) p[i] = vs_v3(at[i][0], at[i][1], at[i][2]);
    int side = crossings_side(&c, 0, 1, 2, 3);
    zeros += side == 0;
    assert_int_equal(vs_doubles_side(p[0], p[1], p[2], p[3]), side);
    for (int axis = 0; axis < 3; axis++)
      assert_int_equal(vs_doubles_turn(axis, p[0], p[1], p[2]), crossings_turn(&c, axis, 0, 1, 2));
    for (int i = 0; i < 12; i++) mpz_clear(c.x[i]);
    for (int i = 0; i < 8; i++) mpz_clear(c.t[i]);
    if (round % 5 == 4 || vs_triangle_is_flat(p) || vs_triangle_is_flat(p + 3)) continue;
    crossings_triangle triangles[2] = { { 0, 1, 2 }, { 3, 4, 5 } };
    assert_true(crossings_find((const crossings_point *)at, 6, (const crossings_triangle *)triangles, 2, &found));
    size_t touching = found.count[CROSSINGS_TOUCHING], all = crossings_sum(&found);
    vs_triangle_meeting want = all > touching ? VS_MEET_CROSS : touching ? VS_MEET_TOUCH : VS_MEET_NOT;
    kinds[want]++;
    assert_int_equal(vs_triangles_meet(p, p + 3), want);
  }
  assert_true(zeros > 400 && kinds[VS_MEET_NOT] > 400 && kinds[VS_MEET_TOUCH] > 400 && kinds[VS_MEET_CROSS] > 400);
}

/* ---- exact integers of several words ---- */

static void set_wide(mpz_t z, const uint64_t *limbs, size_t n) {
  mpz_import(z, n, -1, 8, 0, 0, limbs);
  if (limbs[n - 1] >> 63) {
    mpz_t power;
    mpz_init_set_ui(power, 1);
    mpz_mul_2exp(power, power, 64 * n);
    mpz_sub(z, z, power);
    mpz_clear(power);
  }
}
static void set_128(mpz_t z, vs_i128 x) {
  uint64_t limbs[2] = { (uint64_t)(vs_u128)x, (uint64_t)((vs_u128)x >> 64) };
  set_wide(z, limbs, 2);
}

static void random_plane(vs_plane *p, int32_t most) {
  bool flipped;
  int32_t v[3][3];
  do
    for (int i = 0; i < 9; i++) v[i / 3][i % 3] = span(-most, most);
  while (!vs_plane_through(v[0], v[1], v[2], p, &flipped));
}

static void test_planes_meet(void **state) {
  (void)state;
  mpz_t w, x, n[3][3], d[3], sum, t;
  mpz_inits(w, x, sum, t, NULL);
  int inside = 0;
  for (int i = 0; i < 3; i++) mpz_inits(d[i], n[i][0], n[i][1], n[i][2], NULL);
  for (int round = 0; round < 3000; round++) {
    /* coordinates of the kernel's whole grid, or small coordinates for which the kernel uses faster arithmetic */
    int32_t most = round % 3 == 0 ? 5 : round % 3 == 1 ? INT32_MAX : 1 << 25;
    vs_plane p[3];
    vs_homogeneous h;
    for (int i = 0; i < 3; i++) random_plane(&p[i], most);
    if (!vs_meet_planes(&p[0], &p[1], &p[2], &h)) continue;
    set_wide(w, h.w, VS_LIMBS);
    assert_true(mpz_sgn(w) > 0);
    for (int i = 0; i < 3; i++) { /* every one of the three planes contains their intersection point */
      set_128(sum, -p[i].d);
      mpz_mul(sum, sum, w);
      for (int a = 0; a < 3; a++) {
        set_wide(x, h.x[a], VS_LIMBS);
        mpz_set_si(t, p[i].n[a]);
        mpz_addmul(sum, t, x);
      }
      assert_int_equal(mpz_sgn(sum), 0);
      assert_int_equal(vs_homogeneous_side(&p[i], &h), 0);
    }
    bool far = false, remainders = false; /* far: whether the point is outside the grid, where the kernel never calls
                                           * vs_homogeneous_fix */
    int64_t fixed[3], want[3];
    for (int a = 0; a < 3; a++) {
      set_wide(x, h.x[a], VS_LIMBS);
      mpz_mul_2exp(x, x, VS_FIXED_BITS);
      mpz_fdiv_qr(x, t, x, w);
      far = far || mpz_sizeinbase(x, 2) > VS_GRID_BITS + VS_FIXED_BITS;
      want[a] = mpz_get_si(x);
      remainders = remainders || mpz_sgn(t) != 0;
    }
    if (far) continue;
    inside++;
    assert_int_equal(vs_homogeneous_fix(&h, fixed), !remainders);
    for (int a = 0; a < 3; a++) assert_int_equal(fixed[a], want[a]);
  }
  assert_true(inside > 1000);
  mpz_clears(w, x, sum, t, NULL);
  for (int i = 0; i < 3; i++) mpz_clears(d[i], n[i][0], n[i][1], n[i][2], NULL);
}

/* Tests exact comparisons of points, many of them next to a plane or a line. Some points have remainders, because they
 * are not on the grid. */
static void test_predicates(void **state) {
  (void)state;
  mpq_t c[3][3], s, t, u;
  mpq_inits(s, t, u, NULL);
  for (int i = 0; i < 9; i++) mpq_init(c[i / 3][i % 3]);
  int zeros = 0;
  for (int round = 0; round < 3000; round++) {
    int32_t most = round % 3 == 0 ? 3 : round % 3 == 1 ? INT32_MAX : 1 << 24;
    vs_point points[3];
    vs_homogeneous big[3];
    for (uint32_t i = 0; i < 3; i++) {
      int32_t a[3], b[3], inside = most;
      vs_plane p;
      do { /* chooses a random point on an edge, within the kernel's grid */
        random_plane(&p, most);
        for (int j = 0; j < 3; j++) a[j] = span(-inside, inside), b[j] = span(-inside, inside);
        points[i].big = VS_POINT_EXACT;
        for (int j = 0; j < 3; j++) points[i].fixed[j] = (int64_t)a[j] * ((int64_t)1 << VS_FIXED_BITS);
      } while (vs_side((vs_points_view){ points, big, NULL }, &p, i) >= 0 || !vs_meet_edge(a, b, &p, &big[i]) ||
               (vs_i128)p.n[0] * b[0] + (vs_i128)p.n[1] * b[1] + (vs_i128)p.n[2] * b[2] <= p.d);
      points[i].big = vs_homogeneous_fix(&big[i], points[i].fixed) ? VS_POINT_EXACT : i;
      for (int j = 0; j < 3; j++) {
        set_wide(mpq_numref(c[i][j]), big[i].x[j], VS_LIMBS);
        set_wide(mpq_denref(c[i][j]), big[i].w, VS_LIMBS);
        mpq_canonicalize(c[i][j]);
      }
    }
    vs_points_view view = { points, big, NULL };
    for (int axis = 0; axis < 3; axis++) {
      int want = mpq_cmp(c[0][axis], c[1][axis]);
      assert_int_equal(vs_compare(view, 0, 1, axis), (want > 0) - (want < 0));
    }
    mpq_set_ui(s, 0, 1); /* computes twice the signed area of the triangle of points 0, 1 and 2 in the xy plane */
    mpq_sub(t, c[1][0], c[0][0]);
    mpq_sub(u, c[2][1], c[0][1]);
    mpq_mul(s, t, u);
    mpq_sub(t, c[1][1], c[0][1]);
    mpq_sub(u, c[2][0], c[0][0]);
    mpq_mul(t, t, u);
    assert_int_equal(vs_orient2d(view, 0, 1, 2, 0, 1), mpq_cmp(s, t) > 0 ? 1 : mpq_cmp(s, t) < 0 ? -1 : 0);
    vs_plane p;
    random_plane(&p, most);
    set_128(mpq_numref(s), -p.d);
    mpz_set_ui(mpq_denref(s), 1);
    for (int j = 0; j < 3; j++) {
      mpq_set_si(t, p.n[j], 1);
      mpq_mul(t, t, c[0][j]);
      mpq_add(s, s, t);
    }
    assert_int_equal(vs_side(view, &p, 0), mpq_sgn(s));
    zeros += mpq_sgn(s) == 0;
  }
  assert_true(zeros > 0);
  mpq_clears(s, t, u, NULL);
  for (int i = 0; i < 9; i++) mpq_clear(c[i / 3][i % 3]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_doubles),
    cmocka_unit_test(test_planes_meet),
    cmocka_unit_test(test_predicates),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
