/* Tests areas in a plane: unions and differences, offsets, open lines, chains of edges, triangulated sheets with holes.
 * Also tests shapes that are computed from meshes: sections, shadows, edges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geometry/plane/areas.h"
#include "geometry/plane/offset.h"
#include "geometry/plane/point_tree.h"
#include "geometry/primitives/solid_triangles.h"
#include "geometry/plane/ear_clipping.h"
#include "solids/feature_edges.h"
#include "solids/sections.h"

static const vs_fineness fine = { 1e-5, 0 };

static vs_area rectangle(double x0, double y0, double x1, double y1) {
  vs_area a = { 0 };
  assert_true(vs_area_point(&a, x0, y0) && vs_area_point(&a, x1, y0) && vs_area_point(&a, x1, y1) && vs_area_point(&a, x0, y1) && vs_area_loop(&a, false));
  return a;
}

static double content(const vs_area *a) { /* returns the signed area within all loops; holes count as negative */
  double sum = 0;
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 p = a->at[first + i], q = a->at[first + (i + 1) % a->size[l]];
      sum += (p.x * q.y - p.y * q.x) / 2;
    }
  return sum;
}

static void sets_of_areas(void **state) {
  (void)state;
  vs_area in[2] = { rectangle(0, 0, 4, 4), rectangle(1, 1, 3, 3) }, out = { 0 };
  vs_error e = { 0 };
  assert_true(vs_area_combine(VS_AREA_DIFFERENCE, in, 2, "test", &out, &e));
  assert_int_equal(out.loop_count, 2); /* the result has an outer loop and a hole, without unnecessary corners */
  assert_int_equal(out.count, 8);
  assert_true(!out.hole[0] && out.hole[1] && content(&out) == 12);
  assert_true(vs_area_holds(&out, 0.5, 0.5) && vs_area_holds(&out, 1, 2) && !vs_area_holds(&out, 2, 2) && !vs_area_holds(&out, 5, 2));
  vs_area_free(&out);
  assert_true(vs_area_combine(VS_AREA_UNION, in, 2, "test", &out, &e) && content(&out) == 16 && out.count == 4);
  vs_area_free(&out);
  assert_true(vs_area_combine(VS_AREA_INTERSECTION, in, 2, "test", &out, &e) && content(&out) == 4);
  vs_area_free(&out);
  in[1].at[0].x = NAN;
  assert_false(vs_area_combine(VS_AREA_UNION, in, 2, "test", &out, &e));
  assert_int_equal(e.kind, VS_ERROR_MODEL);
  for (int i = 0; i < 2; i++) vs_area_free(&in[i]);
}

static void offsets(void **state) {
  (void)state;
  vs_area in = rectangle(0, 0, 4, 4), out = { 0 };
  const double wanted[] = { 36, 32 + 3.14159265358979, 36 - 4 * (sqrt(2) - 1) * (sqrt(2) - 1) };
  for (int corners = 0; corners < 3; corners++) {
    assert_true(vs_area_offset(&in, &(vs_offset_rule){ 1, (vs_offset_corners)corners, &fine, 0 }, &out, NULL));
    assert_true(fabs(content(&out) - wanted[corners]) < (corners == VS_OFFSET_ROUND ? 1e-4 : 1e-12));
    vs_area_free(&out);
  }
  assert_true(vs_area_offset(&in, &(vs_offset_rule){ -1, VS_OFFSET_MITRE, &fine, 0 }, &out, NULL) && fabs(content(&out) - 4) < 1e-12);
  vs_area_free(&out);
  assert_true(vs_area_offset(&in, &(vs_offset_rule){ -2, VS_OFFSET_MITRE, &fine, 0 }, &out, NULL) && out.loop_count == 0);
  vs_area_free(&out);
  vs_area_free(&in);
  const vs_vec2 bent[] = { { 0, 0 }, { 4, 0 }, { 4, 4 } };
  vs_open_line open = { bent, 3, { { 1, 0 }, { 0, 1 } } };
  vs_polyline line = { 0 };
  assert_true(vs_line_offset(&open, &(vs_offset_rule){ 1, VS_OFFSET_MITRE, &fine, 0 }, &line, NULL));
  assert_int_equal(line.count, 3); /* the parallel line runs to the left of the given line, inside its bend, in the
                                    * direction of the given line */
  assert_true(line.at[0].x == 0 && line.at[0].y == 1 && line.at[1].x == 3 && line.at[1].y == 1 && line.at[2].y == 4);
  vs_polyline_free(&line);
}

static void chains_wind(void **state) {
  (void)state;
  const vs_vec2 edges[][2] = { /* the edges of two overlapping squares */
    { { 0, 0 }, { 2, 0 } }, { { 2, 0 }, { 2, 2 } }, { { 2, 2 }, { 0, 2 } }, { { 0, 2 }, { 0, 0 } },
    { { 1, 1 }, { 3, 1 } }, { { 3, 1 }, { 3, 3 } }, { { 3, 3 }, { 1, 3 } }, { { 1, 3 }, { 1, 1 } },
  };
  vs_area out = { 0 };
  assert_true(vs_area_of_chain(edges, 8, "test", &out, NULL));
  assert_true(out.loop_count == 1 && fabs(content(&out) - 7) < 1e-12);
  vs_area_free(&out);
}

static void read_off_meshes(void **state) {
  (void)state;
  vs_mesh box = { 0 };
  vs_outline o;
  vs_vec3 c;
  assert_true(vs_solid_box(&box, vs_v3(0, 0, 0), vs_v3(4, 4, 4)));
  const double heights[] = { 0, 1, 4 }; /* heights of three planes that cut the box: at its bottom, through its middle,
                                         * and at its top; at the bottom and top the section is a face */
  for (int i = 0; i < 3; i++) {
    assert_true(vs_mesh_section(&box, vs_v3(0, 0, heights[i]), vs_v3(0, 0, 1), &o, NULL));
    assert_true(o.count == 1 && fabs(vs_outline_measure(&o, &c) - 16) < 1e-12 && fabs(c.x - 2) < 1e-12);
    vs_outline_free(&o);
  }
  assert_true(vs_mesh_section(&box, vs_v3(0, 0, 5), vs_v3(0, 0, 1), &o, NULL) && o.count == 0);
  vs_outline_free(&o);
  assert_true(vs_mesh_shadow(&box, vs_v3(0, 0, 0), vs_v3(1, 1, 1), &o, NULL) && fabs(vs_outline_measure(&o, &c) - 16 * sqrt(3)) < 1e-9);
  vs_outline_free(&o);
  vs_polylines edges = { 0 };
  assert_true(vs_mesh_edges(&box, &edges, NULL));
  assert_int_equal(edges.count, 12);
  vs_polylines_free(&edges);
  vs_mesh_free(&box);
}

/* Tests a sheet with 22,500 holes, which takes a second. Slower algorithms would take half a minute (a walk around the
 * outline for each hole) or minutes (a test of all corners for touching holes). The holes are diamonds and squares, in
 * level and staggered rows; some touch in a corner. */
static void sheets_of_holes(void **state) {
  (void)state;
  enum { ROWS = 150, HOLES = ROWS * ROWS, CORNERS = 4 + 4 * HOLES };
  static vs_vec2 at[CORNERS];
  static size_t sizes[HOLES + 1];
  static uint32_t index[CORNERS];
  vs_mesh m = { 0 };
  double taken = 0, area = 0;
  at[0] = (vs_vec2){ 0, 0 }, at[1] = (vs_vec2){ ROWS + 1, 0 }, at[2] = (vs_vec2){ ROWS + 1, ROWS + 1 }, at[3] = (vs_vec2){ 0, ROWS + 1 };
  sizes[0] = 4;
  for (int i = 0; i < HOLES; i++) {
    int row = i / ROWS, column = i % ROWS;
    double r = row % 3 == 0 ? 0.5 : 0.25, x = column + 1, y = row + 1 + (row % 3 == 1 ? 0.2 * (column % 2) : 0);
    bool square = row % 3 == 2;
    for (int k = 0; k < 4; k++) { /* the corners of a hole, in clockwise order */
      double dx = square ? (k == 0 || k == 1 ? -r : r) : k == 0 ? -r : k == 2 ? r : 0, dy = square ? (k == 1 || k == 2 ? r : -r) : k == 1 ? r : k == 3 ? -r : 0;
      at[4 + 4 * i + k] = (vs_vec2){ x + dx, y + dy };
    }
    sizes[i + 1] = 4;
    taken += square ? 4 * r * r : 2 * r * r;
  }
  for (uint32_t i = 0; i < CORNERS; i++) {
    assert_true(vs_mesh_add_vertex(&m, vs_v3(at[i].x, at[i].y, 0), NULL));
    index[i] = i;
  }
  assert_true(vs_triangulate(at, sizes, HOLES + 1, &m, index, false));
  assert_int_equal(m.triangle_count, CORNERS + 2 * HOLES - 2);
  for (size_t i = 0; i < m.triangle_count; i++) {
    double turn = vs_vec2_turn(at[m.triangles[i][0]], at[m.triangles[i][1]], at[m.triangles[i][2]]);
    assert_true(turn >= -1e-9);
    area += turn / 2;
  }
  assert_true(fabs(area - ((ROWS + 1.0) * (ROWS + 1) - taken)) < 1e-6);
  vs_mesh_free(&m);
}

static double chance(uint64_t *state) { /* returns a random number of [0, 1) */
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) * 0x1p-53;
}

static vs_vec2 polar(double radius, double angle) { return (vs_vec2){ radius * cos(angle), radius * sin(angle) }; }

static double turns_of(const vs_vec2 *at, size_t n) { /* returns twice the signed area of the polygon with the n corners
                                                       * `at` */
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += at[i].x * at[(i + 1) % n].y - at[i].y * at[(i + 1) % n].x;
  return sum;
}

/* Tests stars with wedge-shaped holes that touch the star's corners. Further inside, other wedges touch the outer
 * wedges. No two triangles of the sheet may overlap. */
static void holes_touch_corners(void **state) {
  (void)state;
  enum { MOST = 8, CORNERS = 7 * MOST };
  const double turn = 6.283185307179586;
  for (uint64_t seed = 1; seed <= 3000; seed++) {
    uint64_t random = seed * 0x9e3779b97f4a7c15u;
    vs_vec2 at[CORNERS];
    size_t sizes[2 * MOST + 1], loops = 1, count = 3 + (size_t)(chance(&random) * (MOST - 2)), n = count;
    uint32_t index[CORNERS];
    vs_mesh m = { 0 };
    double area = 0, wanted, first = chance(&random), each = turn / (double)count;
    for (size_t i = 0; i < count; i++)
      at[i] = polar(count < 5 ? 3 : 2 + chance(&random), ((double)i + first) * each);
    sizes[0] = count;
    for (size_t i = 0; i < count; i++) {
      double angle = ((double)i + first) * each, wide = each * 0.2 * (chance(&random) < 0.5 ? 1e-6 : chance(&random));
      vs_vec2 wedge[2][3] = { { at[i], polar(1, angle - wide), polar(1, angle + wide) } };
      vs_vec2 inner[3] = { wedge[0][1 + (seed + i) % 2], polar(0.5, angle - wide), polar(0.5, angle + wide / 2) };
      memcpy(wedge[1], inner, sizeof inner);
      for (size_t k = 0; k < 2 && chance(&random) < 0.7; k++) {
        size_t turned = (size_t)(chance(&random) * 3);
        for (size_t j = 0; j < 3; j++) at[n + j] = wedge[k][(turned + 3 - j) % 3]; /* writes the wedge's corners in
                                                                                    * clockwise order, beginning with a
                                                                                    * random corner */
        if (turns_of(at + n, 3) > 0) {
          vs_vec2 swap = at[n];
          at[n] = at[n + 1], at[n + 1] = swap;
        }
        sizes[loops++] = 3;
        n += 3;
      }
    }
    wanted = turns_of(at, count);
    for (size_t i = count; i < n; i += 3) wanted += turns_of(at + i, 3);
    for (uint32_t i = 0; i < n; i++) {
      assert_true(vs_mesh_add_vertex(&m, vs_v3(at[i].x, at[i].y, 0), NULL));
      index[i] = i;
    }
    assert_true(vs_triangulate(at, sizes, loops, &m, index, false));
    for (size_t i = 0; i < m.triangle_count; i++) {
      double twice = vs_vec2_turn(at[m.triangles[i][0]], at[m.triangles[i][1]], at[m.triangles[i][2]]);
      if (twice < -1e-9) fail_msg("seed %llu: a triangle of twice the area %g", (unsigned long long)seed, twice);
      area += twice;
    }
    if (fabs(area - wanted) > 1e-9)
      fail_msg("seed %llu: twice the area is %.12g, not %.12g", (unsigned long long)seed, area, wanted);
    vs_mesh_free(&m);
  }
}

/* Tests sheets with holes in rows, rotated by any angle. Many corners of holes lie on one line, up to rounding. An edge
 * that joins two holes along this line passes other corners at a distance below the rounding error. */
static void holes_in_rows(void **state) {
  (void)state;
  enum { ROWS = 9, MOST = ROWS * ROWS * 9 + 4 };
  static vs_vec2 at[MOST];
  static size_t sizes[ROWS * ROWS + 1];
  static uint32_t index[MOST];
  for (uint32_t i = 0; i < MOST; i++) index[i] = i;
  for (uint64_t seed = 1; seed <= 3000; seed++) {
    uint64_t random = seed * 0x9e3779b97f4a7c15u;
    size_t columns = 1 + (size_t)(chance(&random) * ROWS), rows = 1 + (size_t)(chance(&random) * ROWS), n = 0, loops = 0;
    double angle = seed % 3 ? 6.3 * chance(&random) : 0, wide = 1 + 30 * chance(&random), high = 1 + 30 * chance(&random);
    double c = cos(angle), s = sin(angle), area = 0, wanted = 0;
    vs_mesh m = { 0 };
#define PUT(x, y) (at[n++] = (vs_vec2){ (x) * c - (y) * s, (x) * s + (y) * c })
    PUT(0, 0), PUT(wide, 0), PUT(wide, high), PUT(0, high);
    sizes[loops++] = 4;
    for (size_t i = 0; i < columns; i++)
      for (size_t j = 0; j < rows; j++) {
        if (chance(&random) < 0.2) continue;
        double x = wide * ((double)i + 0.1) / (double)columns, y = high * ((double)j + 0.1) / (double)rows;
        double dx = wide * 0.8 / (double)columns, dy = high * 0.8 / (double)rows, tilt = 1e-16 * high * chance(&random);
        size_t begin = n;
        switch (seed % 4) {
        case 0: /* a hole with a notch in its upper side */
          PUT(x, y + tilt), PUT(x, y + dy), PUT(x + dx / 2, y + dy / 2), PUT(x + dx, y + dy + tilt), PUT(x + dx, y);
          break;
        case 1: {
          size_t sides = 3 + (size_t)(chance(&random) * 6);
          for (size_t k = 0; k < sides; k++) {
            double turn = -6.283185307179586 * (double)k / (double)sides;
            PUT(x + dx / 2 * (1 + cos(turn)), y + dy / 2 * (1 + sin(turn)));
          }
          break;
        }
        default: /* a row of holes whose heights are equal, or alternate between two values */
          if (seed % 4 == 3 && chance(&random) < 0.5) x += dx / 4, dx -= dx / 4;
          if (seed % 4 == 3 && chance(&random) < 0.5) dy *= 0.6;
          PUT(x, y + tilt), PUT(x, y + dy), PUT(x + dx, y + dy + tilt), PUT(x + dx, y);
        }
        sizes[loops++] = n - begin;
      }
#undef PUT
    for (size_t l = 0, first = 0; l < loops; first += sizes[l++]) wanted += turns_of(at + first, sizes[l]);
    for (size_t i = 0; i < n; i++) assert_true(vs_mesh_add_vertex(&m, vs_v3(at[i].x, at[i].y, 0), NULL));
    assert_true(vs_triangulate(at, sizes, loops, &m, index, false));
    for (size_t i = 0; i < m.triangle_count; i++)
      area += fabs(vs_vec2_turn(at[m.triangles[i][0]], at[m.triangles[i][1]], at[m.triangles[i][2]]));
    if (fabs(area - wanted) > 1e-9 * wide * high)
      fail_msg("seed %llu: the triangles' area is %.12g, the sheet's %.12g", (unsigned long long)seed, area, wanted);
    vs_mesh_free(&m);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(sets_of_areas), cmocka_unit_test(offsets), cmocka_unit_test(chains_wind), cmocka_unit_test(read_off_meshes), cmocka_unit_test(sheets_of_holes),
    cmocka_unit_test(holes_touch_corners), cmocka_unit_test(holes_in_rows),
  };
  return cmocka_run_group_tests_name("areas in a plane", tests, NULL, NULL);
}
