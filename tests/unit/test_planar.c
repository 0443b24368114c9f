/* Owns the tests of areas in a plane: sets, offsets, open lines, chains, sheets of holes cut into triangles; and of what is read off meshes: sections, shadows, edges. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "geometry/plane/areas.h"
#include "geometry/plane/point_tree.h"
#include "geometry/primitives/solid_triangles.h"
#include "geometry/plane/ear_clipping.h"
#include "solids/sections.h"

static const vs_facets fine = { 1e-5, 0 };

static vs_area rectangle(double x0, double y0, double x1, double y1) {
  vs_area a = { 0 };
  assert_true(vs_area_point(&a, x0, y0) && vs_area_point(&a, x1, y0) && vs_area_point(&a, x1, y1) && vs_area_point(&a, x0, y1) && vs_area_loop(&a, false));
  return a;
}

static double content(const vs_area *a) { /* signed: holes run the other way */
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
  assert_int_equal(out.loop_count, 2); /* the loop and its hole, and no corner more than they need */
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
    assert_true(vs_area_offset(&in, 1, (vs_offset_corners)corners, &fine, 0, &out, NULL));
    assert_true(fabs(content(&out) - wanted[corners]) < (corners == VS_OFFSET_ROUND ? 1e-4 : 1e-12));
    vs_area_free(&out);
  }
  assert_true(vs_area_offset(&in, -1, VS_OFFSET_MITRE, &fine, 0, &out, NULL) && fabs(content(&out) - 4) < 1e-12);
  vs_area_free(&out);
  assert_true(vs_area_offset(&in, -2, VS_OFFSET_MITRE, &fine, 0, &out, NULL) && out.loop_count == 0);
  vs_area_free(&out);
  vs_area_free(&in);
  const vs_vec2 bent[] = { { 0, 0 }, { 4, 0 }, { 4, 4 } }, ways[] = { { 1, 0 }, { 0, 1 } };
  vs_polyline line = { 0 };
  assert_true(vs_line_offset(bent, 3, ways, 1, VS_OFFSET_MITRE, &fine, 0, &line, NULL));
  assert_int_equal(line.count, 3); /* left: inside the bend, in the line's own direction */
  assert_true(line.at[0].x == 0 && line.at[0].y == 1 && line.at[1].x == 3 && line.at[1].y == 1 && line.at[2].y == 4);
  vs_polyline_free(&line);
}

static void chains_wind(void **state) {
  (void)state;
  const vs_vec2 edges[][2] = { /* two squares, one over the other's corner, each closed in itself */
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
  const double heights[] = { 0, 1, 4 }; /* faces that lie in the plane count */
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

/* A sheet of 22,500 holes, which takes a second: walking round the ring for each would take half a minute, and trying corners where holes touch minutes. Rows that stand level and staggered, diamonds and squares, some that touch in a corner. */
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
    for (int k = 0; k < 4; k++) { /* clockwise */
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

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(sets_of_areas), cmocka_unit_test(offsets), cmocka_unit_test(chains_wind), cmocka_unit_test(read_off_meshes), cmocka_unit_test(sheets_of_holes),
  };
  return cmocka_run_group_tests_name("areas in a plane", tests, NULL, NULL);
}
