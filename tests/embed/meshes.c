/* Tests that a host can draw by meshes. Equal shapes share a mesh, and each round of meshes contains only the changes.
 * Volumes and normals are right. The library asks the host for each material once, and a failure loses nothing. Uses
 * the public header alone. With a file's name as argument, the program requests the meshes of that file's drawing
 * instead, and prints the time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <visualscheme.h>

typedef struct {
  unsigned added, changed, removed, places, curves;
  size_t triangles;
  double volume, bytes;
  bool sound;
  uint64_t last;
  char said[300], asked[100];
  vs_mesh_part part;
} round_of;

static int failures;
static void check(bool holds, const char *text, int line) {
  failures += !holds;
  printf(holds ? "ok embed:%s\n" : "not ok embed:%s (line %d)\n", text, line);
}
#define CHECK(condition) check(condition, #condition, __LINE__)

static void diagnose(void *context, const vs_diagnostic *d) { snprintf(((round_of *)context)->said, 300, "%s",
    d->message); }

static void apply(const double m[3][4], const double p[3], double out[3]) {
  for (int i = 0; i < 3; i++) out[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3];
}

/* Returns the volume of the mesh after `place`, a matrix, is applied. If the matrix mirrors, it reverses the order of
 * the corners. */
static double volume(const vs_mesh_info *m, const double place[3][4]) {
  double sum = 0, v[3][3];
  for (size_t i = 0; i < m->triangle_count; i++) {
    for (int k = 0; k < 3; k++) apply(place, m->points[m->corners[i][k]], v[k]);
    sum += v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) - v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
  }
  return fabs(sum / 6);
}

/* Returns true if each normal has unit length and points to the same side as its triangle. */
static bool sound(const vs_mesh_info *m) {
  for (size_t i = 0; i < m->triangle_count; i++) {
    const double *a = m->points[m->corners[i][0]], *b = m->points[m->corners[i][1]], *c = m->points[m->corners[i][2]];
    double u[3], v[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
    const double face[] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
    for (int k = 0; k < 3; k++) {
      if (m->normal_corners[i][k] >= m->normal_count) return false;
      const double *n = m->normals[m->normal_corners[i][k]];
      if (fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) > 1e-9) return false;
      if (n[0] * face[0] + n[1] * face[1] + n[2] * face[2] < 0) return false;
    }
    if (m->part_of && m->part_of[i] >= m->part_count) return false;
  }
  return true;
}

static vs_outcome go(vs_scheme *s, round_of *r) {
  vs_mesh_info m;
  r->added = r->changed = r->removed = r->places = r->curves = 0, r->triangles = 0, r->volume = 0, r->sound = true;
  vs_outcome outcome = vs_meshes_begin(s, NULL);
  while (vs_mesh_next(s, &m)) {
    r->added += m.change == VS_MESH_ADDED, r->changed += m.change == VS_MESH_CHANGED,
        r->removed += m.change == VS_MESH_REMOVED;
    r->places += (unsigned)m.place_count, r->triangles += m.triangle_count * m.place_count, r->last = m.id;
    r->bytes += (double)(m.point_count * sizeof *m.points + m.triangle_count * (sizeof *m.corners + sizeof
        *m.normal_corners) +
                         m.normal_count * sizeof *m.normals + m.place_count * sizeof *m.places);
    if (m.change != VS_MESH_ADDED) continue;
    r->curves += m.triangle_count == 0, r->sound = r->sound && sound(&m), r->part = m.parts[0];
    for (size_t i = 0; i < m.place_count; i++) r->volume += volume(&m, m.places[i]);
  }
  return outcome;
}

static uint64_t material(void *context, const char *name) {
  round_of *r = context;
  strcat(r->asked, name), strcat(r->asked, " ");
  return strlen(r->asked);
}

static vs_outcome run(vs_scheme *s, const char *text) { return vs_eval_text(s, "model", 1, text, strlen(text), 0); }

/* Tests that a drawing which a thousand nodes show is given as a single mesh, with a matrix for each node's place. */
static void share(vs_scheme *s, round_of *r) {
  static const char one[] =
      "(erase-all) (node-clear)"
      "(define part (subtract (make-sphere (xyz 0 0 0) 1 #:segments 32) (make-box (xyz 0 0 0) (xyz 2 2 2))))"
      "(define (show from to) (for ([i (in-range from to)])"
      "  (node-create #:parent (node-getroot) #:drawing part #:translate (vxyz (* 3 i) 0 0))))"
      "(show 0 1)";
  const char *const more[] = { "(show 1 3)", "(show 3 1000)" };
  double once = 0;
  vs_meshes_forget(s);
  r->bytes = 0;
  CHECK(run(s, one) == VS_OUTCOME_DONE && go(s, r) == VS_OUTCOME_DONE && r->added == 1 && r->places == 1);
  once = r->bytes;
  for (size_t i = 0; i < 2; i++) {
    unsigned places = i ? 1000 : 3;
    vs_meshes_forget(s);
    r->bytes = 0;
    CHECK(run(s, more[i]) == VS_OUTCOME_DONE && go(s, r) == VS_OUTCOME_DONE && r->added == 1 && r->places == places);
    CHECK(r->bytes - once == (places - 1) * sizeof *((vs_mesh_info *)0)->places);
    printf("%u instances: %.0f bytes, of which %.0f are the one mesh\n", places, r->bytes, once - 96);
  }
}

/* Tests that the level of detail depends on the time of the frames. Slow frames lower the scene's quality, and with it
 * the number of facets of the host's meshes. */
static void adapt(vs_scheme *s) {
  size_t triangles[3];
  vs_mesh_info m;
  double quality[3];
  CHECK(run(s, "(erase-all) (node-clear) (define quality (scene-quality)) (draw (make-sphere (xyz 0 0 0) 1))") == VS_OUTCOME_DONE);
  for (size_t i = 0; i < 3; i++) {
    for (int k = 0; k < 4 * (int)i; k++) vs_scene_frame(s, i == 1 ? 0.1 : 0.005);
    vs_handle q = 0;
    vs_output_options o = vs_output_options_default();
    if (vs_property_get(s, vs_scene_controller(s), "quality", &q) == VS_OUTCOME_DONE) vs_handle_get_numbers(s, q, &quality[i], 1);
    o.segments = (int)(48 * quality[i]);
    triangles[i] = 0;
    vs_meshes_begin(s, &o);
    while (vs_mesh_next(s, &m))
      if (m.change == VS_MESH_ADDED) triangles[i] += m.triangle_count;
  }
  CHECK(quality[0] == 1 && fabs(quality[1] - 0.4096) < 1e-9 && quality[2] == 1);
  CHECK(triangles[0] > 4 * triangles[1] && triangles[1] > 100 && triangles[2] == triangles[0]);
}

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; } /* returns the processor time of this
                                                                          * process */

static int measure(vs_scheme *s, const char *file, round_of *r) {
  double began = seconds();
  if (vs_eval_file(s, file, 0) != VS_OUTCOME_DONE) return 1;
  double ran = seconds();
  go(s, r);
  double first = seconds();
  printf("ran %.2f s; handed over in %.2f s: %u meshes at %u places, %zu triangles, %.1f MB\n", ran - began,
      first - ran,
         r->added, r->places, r->triangles, r->bytes / 1e6);
  go(s, r);
  printf("again, nothing changed: %.2f s, %u\n", seconds() - first, r->added + r->changed + r->removed);
  return 0;
}

int main(int count, char **words) {
  static round_of r;
  vs_options o = vs_options_default();
  o.host = (vs_host){ .context = &r, .diagnose = diagnose };
  vs_scheme *s = vs_new(&o);
  if (!s) return printf("not ok embed: no interpreter\n"), 1;
  if (count > 1) {
    int code = measure(s, words[1], &r);
    vs_free(s);
    return code;
  }
  vs_mesh_info none;
  CHECK(!vs_mesh_next(s, &none)); /* vs_mesh_next fails before the host begins a round of meshes */
  CHECK(go(s, &r) == VS_OUTCOME_MODEL && strstr(r.said, "nothing is drawn"));

  /* a shape in three nodes is one mesh; the size of a box is part of its place */
  vs_material_handler(s, material, &r);
  static const char scene[] =
      "(define hole (with-material 'steel (make-box (xyz -0.5 -0.5 1) (xyz 0.5 0.5 3))))"
      "(define engine (subtract (make-box (xyz -1 -1 0) (xyz 1 1 2)) hole))"
      "(for ([i (in-range 3)])"
      "  (node-create #:name (number->string i) #:parent (node-getroot) #:drawing (with-material 'gold engine)"
      "               #:translate (vxyz (* 10 i) 0 0)))"
      "(draw (make-box (xyz 0 0 50) (xyz 1 2 53)) (make-box (xyz 9 9 9) (xyz 10 10 10)))";
  CHECK(run(s, scene) == VS_OUTCOME_DONE);
  CHECK(go(s, &r) == VS_OUTCOME_DONE && r.added == 2 && r.changed == 0 && r.removed == 0 && r.places == 5 && r.sound);
  CHECK(fabs(r.volume - (3 * 7 + 6 + 1)) < 1e-9);
  CHECK(strstr(r.asked, "gold ") && strstr(r.asked, "steel ") && strlen(r.asked) == strlen("gold steel "));
  CHECK(go(s, &r) == VS_OUTCOME_DONE && r.added + r.changed + r.removed == 0); /* since nothing changed in the drawing,
                                                                                * the next round contains no meshes */

  /* after a node moved, its mesh keeps its id and has another place; a new sphere of another material is a new mesh */
  CHECK(run(s, "(node-translate (node-find \"1\") (vxyz 0 0 7))") == VS_OUTCOME_DONE);
  CHECK(go(s, &r) == VS_OUTCOME_DONE && r.added == 0 && r.changed == 1 && r.removed == 0 && r.places == 3);
  CHECK(run(s, "(draw (with-material 'steel (make-box (xyz 0 0 0) (xyz 1 1 1))))") == VS_OUTCOME_DONE);
  CHECK(go(s, &r) == VS_OUTCOME_DONE && r.added == 1 && r.changed == 0 && r.removed == 0 && r.part.painted);
  CHECK(strcmp(r.part.material, "steel") == 0 && r.part.material_id && r.part.line == 1 && strcmp(r.part.file,
      "model") == 0);
  CHECK(strlen(r.asked) == strlen("gold steel ")); /* the library does not ask the host again for a material that it
                                                    * knows */
  uint64_t steel = r.last;

  /* the round reports removed meshes; a mesh that is drawn again has its old id; the mesh of a curve has only points */
  CHECK(run(s, "(erase-all) (for-each (lambda (n) (node-setdrawing n '())) (node-getchildren (node-getroot)))"
               "(draw (make-line (xyz 0 0 0) (xyz 1 0 0) (xyz 1 1 0)))") == VS_OUTCOME_DONE);
  CHECK(go(s, &r) == VS_OUTCOME_DONE && r.added == 1 && r.curves == 1 && r.removed == 3);
  CHECK(run(s, "(erase-all) (draw (with-material 'steel (make-box (xyz 5 5 5) (xyz 6 9 6))))") == VS_OUTCOME_DONE);
  CHECK(go(s, &r) == VS_OUTCOME_DONE && r.added == 1 && r.removed == 1 && r.last == steel && fabs(r.volume - 4) < 1e-9);

  /* round shapes are smooth, with the requested tolerance; an error changes nothing */
  CHECK(run(s, "(erase-all) (draw (make-sphere (xyz 0 0 0) 2))") == VS_OUTCOME_DONE);
  CHECK(go(s, &r) == VS_OUTCOME_DONE && r.sound && fabs(r.volume / (32 * acos(-1) / 3) - 1) < 0.01);
  CHECK(run(s, "(erase-all) (draw (load-mesh \"none.stl\"))") != VS_OUTCOME_DONE);
  CHECK(go(s, &r) == VS_OUTCOME_MODEL && r.added == 0 && r.removed == 1); /* the failed program left an empty drawing,
                                                                           * so the round removes its only mesh */
  vs_meshes_forget(s);
  CHECK(run(s, "(draw (make-sphere (xyz 0 0 0) 2))") == VS_OUTCOME_DONE && go(s, &r) == VS_OUTCOME_DONE &&
      r.added == 1);
  share(s, &r);
  adapt(s);
  vs_free(s);
  return failures != 0;
}
