/* Unit tests of vs_drawing_face: form, area, radius and axis of faces, beside their formulas. Each solid is tested as it
 * is, and turned by odd angles, enlarged, and far from the origin. */
#include "visualscheme.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "model/vec.h"

#define PI 3.14159265358979323846

/* A solid, a point of one of its faces, and the face: area, radius, tube, angle; at: a point of its axis, its centre or
 * its apex. */
typedef struct {
  const char *solid;
  vs_vec3 point;
  const char *form;
  double area, radius, tube, angle;
  vs_vec3 at, axis;
} example;

static const example examples[] = {
  { "(make-box origin (xyz 2 3 4))", { 1, 1, 4 }, "plane", 6, 0, 0, 0, { 1, 1.5, 4 }, { 0, 0, 1 } },
  { "(make-sphere (xyz 1 2 3) 2)", { 1, 2, 5 }, "sphere", 16 * PI, 2, 0, 0, { 1, 2, 3 }, { 0, 0, 0 } },
  { "(make-cylinder origin (xyz 0 0 5) 2)", { 2, 0, 2.3 }, "cylinder", 20 * PI, 2, 0, 0, { 0, 0, 0 }, { 0, 0, 1 } },
  { "(make-cylinder origin (xyz 0 0 5) 2)", { .3, .4, 5 }, "plane", 4 * PI, 0, 0, 0, { 0, 0, 5 }, { 0, 0, 1 } },
  { "(make-cone origin (xyz 0 0 4) 3)", { 1.5, 0, 2 }, "cone", 15 * PI, 0, 0, .64350110879328437, { 0, 0, 4 },
    { 0, 0, -1 } },
  { "(make-cut-cone origin 3 (xyz 0 0 2) 1.5)", { 2.25, 0, 1 }, "cone", 11.25 * PI, 0, 0, .64350110879328437,
    { 0, 0, 4 }, { 0, 0, -1 } },
  { "(make-torus origin 3 1)", { 4, 0, 0 }, "torus", 12 * PI * PI, 3, 1, 0, { 0, 0, 0 }, { 0, 0, 1 } },
  /* a drilled plate: the hole's wall, and the plate's face around it */
  { "(subtract (make-box (xyz -2 -3 0) (xyz 2 3 1)) (make-cylinder (xyz 0 0 -1) (xyz 0 0 2) 1))", { 1, 0, .5 },
    "cylinder", 2 * PI, 1, 0, 0, { 0, 0, 0 }, { 0, 0, 1 } },
  { "(subtract (make-box (xyz -2 -3 0) (xyz 2 3 1)) (make-cylinder (xyz 0 0 -1) (xyz 0 0 2) 1))", { 1.8, 1, 1 },
    "plane", 24 - PI, 0, 0, 0, { 0, 0, 1 }, { 0, 0, 1 } },
  /* a sphere cut above its middle: both caps, and the cut */
  { "(do-slice (make-sphere origin 2) (make-plane (xyz 0 0 1) (vxyz 0 0 -1)))", { 0, 0, -2 }, "sphere", 12 * PI, 2, 0, 0,
    { 0, 0, 0 }, { 0, 0, 0 } },
  { "(do-slice (make-sphere origin 2) (make-plane (xyz 0 0 1) (vxyz 0 0 1)))", { 0, 0, 2 }, "sphere", 4 * PI, 2, 0, 0,
    { 0, 0, 0 }, { 0, 0, 0 } },
  { "(do-slice (make-sphere origin 2) (make-plane (xyz 0 0 1) (vxyz 0 0 1)))", { .1, .2, 1 }, "plane", 3 * PI, 0, 0, 0,
    { 0, 0, 1 }, { 0, 0, 1 } },
  { "(do-extrude (make-circle origin 1.5) 2)", { 1.5, 0, 1 }, "cylinder", 6 * PI, 1.5, 0, 0, { 0, 0, 0 }, { 0, 0, 1 } },
  { "(do-revolve (make-circle (xyz 3 0 0) 1 #:plane 'xz) 'z)", { 4, 0, 0 }, "torus", 12 * PI * PI, 3, 1, 0, { 0, 0, 0 },
    { 0, 0, 1 } },
  { "(unite (make-box origin (xyz 1 1 1)) (make-box (xyz 1 0 0) (xyz 2 1 1)))", { .5, .5, 1 }, "plane", 2, 0, 0, 0,
    { 1, .5, 1 }, { 0, 0, 1 } },
};

static void show(void *context, const vs_diagnostic *d) {
  (void)context;
  fprintf(stderr, "%s\n", d->message);
}

static vs_scheme *opened(void) {
  vs_options o = vs_options_default();
  o.host.diagnose = show;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  return s;
}

static void draw(vs_scheme *s, const char *solid, const vs_affine *place) {
  char text[2000];
  int n = snprintf(text, sizeof text, "(draw (do-transform %s (make-matrix", solid);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 4; k++) n += snprintf(text + n, sizeof text - (size_t)n, " %.17g", place->m[i][k]);
  snprintf(text + n, sizeof text - (size_t)n, " 0 0 0 1)))");
  assert_int_equal(vs_eval_text(s, "test", 1, text, strlen(text), 0), VS_OUTCOME_DONE);
}

static void expect(const char *solid, const char *what, double found, double wanted, double size) {
  if (fabs(found - wanted) > 1e-6 * size) fail_msg("%s: %s is %.12g, not %.12g", solid, what, found, wanted);
}

/* Tests an example placed by a map that enlarges by `factor` and keeps angles. */
static void holds(const example *e, const vs_affine *place, double factor) {
  vs_scheme *s = opened();
  draw(s, e->solid, place);
  vs_vec3 p = vs_affine_point(place, e->point), at = vs_affine_point(place, e->at), axis = vs_affine_vector(place, e->axis);
  vs_face_info f;
  assert_int_equal(vs_drawing_face(s, (double[]){ p.x, p.y, p.z }, &f), VS_OUTCOME_DONE);
  if (!f.form || strcmp(f.form, e->form)) fail_msg("%s: a %s, not a %s", e->solid, f.form ? f.form : "nothing", e->form);
  expect(e->solid, "the area", f.area, factor * factor * e->area, factor * factor * e->area);
  expect(e->solid, "the radius", f.radius, factor * e->radius, factor);
  expect(e->solid, "the tube", f.tube, factor * e->tube, factor);
  expect(e->solid, "the angle", f.angle, e->angle, 1);
  vs_vec3 off = vs_v3_sub(vs_v3(f.at[0], f.at[1], f.at[2]), at), way = vs_v3(f.axis[0], f.axis[1], f.axis[2]);
  double along = vs_v3_dot(off, way);
  if (!strcmp(e->form, "cylinder")) off = vs_v3_sub(off, vs_v3_scale(way, along)); /* any point of the axis */
  if (!strcmp(e->form, "plane")) off = vs_v3_scale(way, along);                    /* any point of the plane */
  expect(e->solid, "the place", vs_v3_length(off), 0, factor + vs_v3_length(at));
  if (vs_v3_length(axis) > 0)
    expect(e->solid, "the axis", vs_v3_length(vs_v3_cross(vs_v3_unit(axis), way)), 0, 1);
  vs_free(s);
}

static void faces_have_their_measures(void **state) {
  (void)state;
  const vs_affine still = vs_affine_translation(vs_v3(0, 0, 0));
  const vs_affine turned = vs_affine_rotation(vs_v3(3, -1, 2), vs_v3(1, 2, 3), .7);
  const vs_affine larger = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(37, 37, 37));
  const vs_affine both = vs_affine_multiply(&larger, &turned);
  for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
    holds(&examples[i], &still, 1);
    holds(&examples[i], &turned, 1);
    holds(&examples[i], &both, 37);
  }
}

static void others_are_surfaces(void **state) {
  (void)state;
  vs_scheme *s = opened();
  const vs_affine uneven = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(1, 1, 2));
  vs_face_info f;
  draw(s, "(make-sphere origin 1)", &uneven); /* an ellipsoid */
  assert_int_equal(vs_drawing_face(s, (double[]){ 1, 0, 0 }, &f), VS_OUTCOME_DONE);
  assert_string_equal(f.form, "surface");
  assert_true(fabs(f.area - 21.4784) < .2);
  assert_int_equal(vs_drawing_face(s, (double[]){ 9, 0, 0 }, &f), VS_OUTCOME_DONE);
  assert_null(f.form);
  assert_int_equal(vs_drawing_face(s, (double[]){ NAN, 0, 0 }, &f), VS_OUTCOME_DONE);
  assert_null(f.form);
  vs_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(faces_have_their_measures),
    cmocka_unit_test(others_are_surfaces),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
