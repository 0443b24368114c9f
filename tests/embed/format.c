/* Tests that a host can add a format: a text format of a dozen lines, with words for boxes, spheres, lines and
 * subtractions. The library converts all other kinds of objects to these. */
#include <stdio.h>
#include <string.h>
#include <visualscheme.h>

typedef struct { char text[20000], said[2000]; size_t things; } host;

static void diagnose(void *context, const vs_diagnostic *d) {
  host *h = context;
  snprintf(h->said + strlen(h->said), sizeof h->said - strlen(h->said), "%u:%u %s\n", d->at.line, d->at.column, d->message);
}
static bool keep(void *context, const void *bytes, size_t count) {
  host *h = context;
  strncat(h->text, bytes, count);
  return true;
}

/* Writes a line of the format: a word for the object's kind, its numbers, and the place in the program that made the
 * object. */
static vs_kind_status line_of(vs_output *out, const vs_thing *t, const char *word, const char *const fields[]) {
  vs_output_print(out, word);
  for (; *fields; fields++) {
    double at[60];
    size_t count = vs_thing_numbers(t, *fields, at, 60);
    for (size_t i = 0; i < count && i < 60; i++) vs_output_print(out, " "), vs_output_number(out, at[i]);
  }
  if (t->place[0][3] != 0) vs_output_print(out, " right by "), vs_output_number(out, t->place[0][3]);
  if (t->painted) vs_output_print(out, " in "), vs_output_print(out, t->material);
  if (t->layer[0]) vs_output_print(out, " on "), vs_output_print(out, t->layer);
  return vs_output_print(out, "\n") ? VS_KIND_WRITTEN : VS_KIND_FAILED;
}
static vs_kind_status box(void *context, vs_output *out, const vs_thing *t) {
  ((host *)context)->things++;
  return line_of(out, t, "box", (const char *const[]){"p", "q", NULL});
}
static vs_kind_status sphere(void *context, vs_output *out, const vs_thing *t) {
  double segments;
  ((host *)context)->things++;
  /* accepts only shapes without a fixed number of facets; VS_KIND_SIMPLER makes the library convert other shapes to
   * simpler kinds */
  if (vs_thing_numbers(t, "segments", &segments, 1) != 1 || segments > 0) return VS_KIND_SIMPLER;
  return line_of(out, t, "ball", (const char *const[]){"c", "r", NULL});
}
static vs_kind_status line(void *context, vs_output *out, const vs_thing *t) {
  ((host *)context)->things++;
  return line_of(out, t, "line", (const char *const[]){"points", NULL});
}
static vs_kind_status mesh(void *context, vs_output *out, const vs_thing *t) {
  vs_triangles all;
  char text[80];
  ((host *)context)->things++;
  if (!vs_thing_triangles(out, t, &all)) return VS_KIND_FAILED;
  snprintf(text, sizeof text, "mesh %zu points %zu triangles\n", all.point_count, all.count);
  return vs_output_print(out, text) ? VS_KIND_WRITTEN : VS_KIND_FAILED;
}
static vs_kind_status subtract(void *context, vs_output *out, const vs_thing *t) {
  (void)context;
  char text[40];
  snprintf(text, sizeof text, t->phase == VS_THING_ENTER ? "from %zu (\n" : ")\n", t->child_count);
  return vs_output_print(out, text) ? VS_KIND_WRITTEN : VS_KIND_FAILED;
}
static vs_kind_status refuse(void *context, vs_output *out, const vs_thing *t) {
  (void)context, (void)t;
  vs_output_fail(out, "no tori here");
  return VS_KIND_FAILED;
}
static bool begin(void *context, vs_output *out) {
  ((host *)context)->things = 0;
  return vs_output_print(out, "begin\n");
}
static bool end(void *context, vs_output *out) {
  (void)context;
  return vs_output_print(out, "end\n");
}

static vs_outcome run(vs_scheme *s, host *h, const char *text) {
  vs_drawing_clear(s);
  h->text[0] = h->said[0] = 0;
  return vs_eval_text(s, "text", 1, text, strlen(text), 0);
}

static int failures;
#define CHECK(condition) ((condition) ? (void)printf("ok embed:format:%s\n", #condition) : (failures++, (void)printf("not ok embed:format:%s (line %d)\n", #condition, __LINE__)))

int main(void) {
  static host h;
  static const vs_format_kind kinds[] = {{"box", box}, {"sphere", sphere}, {"line", line}, {"polyface-mesh", mesh}, {"subtract", subtract}, {"torus", refuse}};
  static const vs_format_kind wrong[] = {{"polyface-mesh", mesh}, {"dodecahedron", mesh}};
  vs_format_own format = {.name = "words", .suffix = "words", .doc = "things in words", .kinds = kinds, .kind_count = 6, .begin = begin, .end = end, .context = &h};
  vs_options o = vs_options_default();
  vs_format_info info;
  o.host.context = &h;
  o.host.diagnose = diagnose;
  vs_scheme *s = vs_new(&o);
  if (!s) return printf("not ok embed:format: no interpreter\n"), 1;
#define WRITE(format) vs_write_drawing_to(s, format, NULL, keep, &h)
  CHECK(vs_register_format(s, &format) && vs_format_of(s, "out/a.words", &info) && strcmp(info.doc, "things in words") == 0);
  CHECK(run(s, &h, "(draw (make-box origin (xyz 1 2 3)) (layer \"up\" (with-material steel (do-move (make-sphere origin 1) (vxyz 0 0 0)))))") == VS_OUTCOME_DONE);
  CHECK(WRITE("words") == VS_OUTCOME_DONE && h.things == 2);
  CHECK(strcmp(h.text, "begin\nbox 0 0 0 1 2 3\nball 0 0 0 1 in steel on up\nend\n") == 0);
  CHECK(run(s, &h, "(draw (subtract (make-box origin (xyz 4 4 4)) (make-sphere origin 1)) (make-circle origin 1 #:segments 4))") == VS_OUTCOME_DONE);
  CHECK(WRITE("words") == VS_OUTCOME_DONE && strstr(h.text, "from 2 (\nbox 0 0 0 4 4 4\nball 0 0 0 1\n)\nline 1 0 0 0 1 0 -1 0 0 0 -1 0\n"));
  CHECK(run(s, &h, "(draw (make-wedge origin (xyz 1 1 1)) (intersect (make-box origin (xyz 2 2 2)) (make-box (xyz 1 1 1) (xyz 3 3 3))))") == VS_OUTCOME_DONE);
  CHECK(WRITE("words") == VS_OUTCOME_DONE && strstr(h.text, "mesh 6 points 8 triangles\nmesh 8 points 12 triangles\n"));
  CHECK(run(s, &h, "(draw (make-torus origin 3 1))") == VS_OUTCOME_DONE && WRITE("words") == VS_OUTCOME_MODEL && strcmp(h.said, "1:7 no tori here\n") == 0);
  format.kinds = wrong, format.kind_count = 2;
  CHECK(!vs_register_format(s, &format));
  format.kinds = kinds, format.kind_count = 3;
  CHECK(!vs_register_format(s, &format)); /* the library refuses to register a format that cannot write a
                                           * polyface-mesh */
  format.kind_count = 6, format.suffix = "stl";
  CHECK(!vs_register_format(s, &format));
  format.kinds = &kinds[3], format.kind_count = 1, format.suffix = "only";
  CHECK(vs_register_format(s, &format));
  CHECK(run(s, &h, "(draw (make-circle origin 1) (make-box origin (xyz 1 1 1)))") == VS_OUTCOME_DONE && WRITE("only") == VS_OUTCOME_DONE);
  CHECK(strcmp(h.text, "begin\nmesh 8 points 12 triangles\nend\n") == 0 && strcmp(h.said, "1:7 words has no lines: curves are omitted\n") == 0);
  vs_free(s);
  return failures != 0;
}
