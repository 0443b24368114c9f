/* Tests that all ways to measure an object agree. The programs place samples of every kind and every constructor
 * (tests/oracle/paths.h) in every way, and as each operand of every set operation:
 *
 * - (volume o), the volume of the written mesh, the volume of the mesh written without passes, (contains? o p) and
 * (bounding-box o) agree.
 *
 * - The answers and the bytes are equal whether o is measured before or after it is drawn, and in an interpreter
 * without a cache.
 *
 * If all faces are planar, volumes are equal to 1e-9. Otherwise the chord height (distance of facet and arc) bounds
 * their difference: the written mesh and the measured mesh lie within it of the exact surface. Runs 500 programs; with
 * LONG=1 ten thousand, or those of SEEDS=FROM-TO. SHOW=1 prints each program, TELL=1 the counts. */
#include "tests/unit/trials.h"
#include "tests/unit/seeds.h"

#include "tests/oracle/paths.c"

enum { PLACES = 12 };
static const char samples_file[] = "tests/cross/shapes.vs";

typedef struct {
  bool solid, drawn;            /* solid: whether the object is a solid. drawn: whether its mesh was written */
  double volume;                /* volume of the object; NAN if the object has no volume */
  double low[3], high[3], size; /* low, high: corners of the bounding box. size: length of its diagonal */
  char told[TEXT];              /* text of all answers of the interpreter */
  char error[600];              /* reason why no mesh was written */
  written mesh;
} looks;

typedef struct {
  trial kept, bare; /* kept: interpreter with a cache. bare: interpreter without a cache */
  char why[900];
  size_t made, late, refused, flat, compared, nothing, points, inside;
} paths;

static const char asking[] =
    "(define (asked f . more) (guard (e (#t 'none)) (apply f o more)))"
    "(define (ask) (define box (asked bounding-box)) (write (asked volume)) (display \" \") (if (pair? box) (for-each "
    "(lambda (p) (for-each (lambda (c) (write (c p)) (display \" \")) (list cx cy cz))) box) (display \"no box \")) "
    "(write (list (solid? o) (asked area) (asked centroid))))";

/* Evaluates the text, then measures the object: before writing the mesh if `asks_first`, otherwise after. Before the
 * first measurement the interpreter collects garbage, so that no other value refers to the object's parts. Returns
 * false if the program is refused. */
static bool look(trial *t, const char *text, bool asks_first, unsigned passes, looks *out) {
  vs_output_options o = vs_output_options_default();
  bool more;
  o.passes = passes;
  release(&out->mesh);
  *out = (looks){ .volume = NAN };
  vs_restart(t->vm);
  const char *before = path_definitions();
  if (vs_eval_text(t->vm, samples_file, 1, before, strlen(before), 0) != VS_OUTCOME_DONE)
    fail_msg("the samples' definitions: %s", t->heard.error);
  if (run(t, "(define o %s)", text) != VS_OUTCOME_DONE || run(t, "%s", asking) != VS_OUTCOME_DONE) return false;
  if (asks_first && run(t, "(collect-garbage)") != VS_OUTCOME_DONE) return false;
  for (int step = 0; step < 2; step++) {
    if ((step == 0) == asks_first) {
      if (run(t, "(ask)") != VS_OUTCOME_DONE) return false;
      memcpy(out->told, t->heard.out, t->heard.out_count + 1);
    } else {
      if (run(t, "(begin (erase-all) (draw o))") != VS_OUTCOME_DONE) return false;
      t->output = &o;
      out->drawn = write_as(t, ".ply", 0, &out->mesh, &more);
      t->output = NULL;
      if (!out->drawn) snprintf(out->error, sizeof out->error, "%s", t->heard.error);
    }
  }
  out->solid = strstr(out->told, "(#t ") != NULL;
  double *b[6] = { &out->low[0], &out->low[1], &out->low[2], &out->high[0], &out->high[1], &out->high[2] };
  char *rest = out->told, *end;
  out->volume = strtod(rest, &end);
  if (end == rest) out->volume = NAN, end = rest + strcspn(rest, " ");
  for (int i = 0; i < 6; i++) *b[i] = strtod(rest = end, &end);
  for (int k = 0; k < 3; k++) out->size += (out->high[k] - out->low[k]) * (out->high[k] - out->low[k]);
  out->size = sqrt(out->size);
  return true;
}

static bool same_mesh(const written_mesh *a, const written_mesh *b) {
  return a->point_count == b->point_count && a->count == b->count &&
         memcmp(a->points, b->points, a->point_count * sizeof *a->points) == 0 &&
         memcmp(a->triangles, b->triangles, a->count * sizeof *a->triangles) == 0;
}

/* ---- tolerances ---- */

typedef struct { const char *name; bool flat; } flatness;
static const flatness flat_kinds[] = {
/* Levels of the kinds whose faces may be planar: faces, placements, sets and wrappers. Round kinds (such as spheres)
 * have another level. */
#define VS_KIND(upper, lower, name, class, level, role, traits) { name, VS_LEVEL_IS_##level },
#define VS_LEVEL_IS_SUGAR true
#define VS_LEVEL_IS_OPERATION true
#define VS_LEVEL_IS_SWEPT false
#define VS_LEVEL_IS_CURVED false
#define VS_LEVEL_IS_FLAT true
#define VS_LEVEL_IS_MESH true
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
};

static bool gather(void *context, const void *bytes, size_t count) {
  char *tree = context;
  size_t used = strlen(tree);
  if (used + count + 1 > TEXT) return false;
  memcpy(tree + used, bytes, count);
  tree[used + count] = 0;
  return true;
}

/* Returns true if all faces are planar, judged by the kinds of nodes in the drawn tree. An extrusion has planar faces
 * if it is straight and its profile is polygonal. */
static bool is_flat(trial *t) {
  static char tree[TEXT];
  tree[0] = 0;
  if (vs_write_drawing_to(t->vm, "tree", NULL, gather, tree) != VS_OUTCOME_DONE) return false;
  for (const char *at = tree; (at = strchr(at, '(')) != NULL;) {
    size_t length = strcspn(++at, " ()\n");
    for (size_t i = 0; i < sizeof flat_kinds / sizeof *flat_kinds; i++) {
      if (flat_kinds[i].flat || strlen(flat_kinds[i].name) != length || strncmp(at, flat_kinds[i].name, length) != 0)
        continue;
      if (strncmp(at, "extrude (along 0 0 0)", 21) == 0 || strncmp(at, "extrude ", 8) != 0) return false;
      const char *line = at + strcspn(at, "\n");
      const char *straight = strstr(at, "(twist 0)");
      if (!straight || straight > line) return false;
    }
  }
  return true;
}

/* Returns the chord height (largest distance of a facet from its arc) of a drawing whose diagonal is `size`: the power
 * of two nearest to size / 4000. */
static double chord(double size) {
  return size > 0 && isfinite(size) ? ldexp(1, (int)nearbyint(log2(size / 4000))) : 0;
}

/* Returns the chord height of facets that are coarser than those of the drawing. The text may set a small number of
 * facets. An object that a hexahedron deforms has a chord height of 1/200 of its diagonal (solids/deformed.c). */
static double coarser_chord(const char *text, double size) {
  static const char *const counts[] = { "#:segments ", "#:nu ", "#:nv " };
  static const char *const bent[] = { "make-ffd-scope", "to-frustum", "rules/hexahedron" };
  double most = 0;
  for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
    for (const char *at = text; (at = strstr(at, counts[i])) != NULL; at++) {
      double n = strtod(at + strlen(counts[i]), NULL);
      if (n > 1) most = fmax(most, size / 2 * (1 - cos(3.14159265358979 / n)));
    }
  for (size_t i = 0; i < sizeof bent / sizeof *bent; i++)
    if (strstr(text, bent[i])) most = fmax(most, size / 200);
  return most;
}

/* step, chord: distances by which a point of the surface may be wrong, due to rounding and to facets. volume: allowed
 * difference of volumes */
typedef struct { double step, chord, volume; } allowance;

/* Returns the tolerances for the measures of an object. The kernel's grid has 2^32 steps for all that the program
 * combines; a step is 1, 2 or 5 times a power of ten, and a point moves by at most half a step. The allowed chord
 * height is that of the drawing, doubled for surfaces that bend in two directions. It counts once for the written mesh
 * and once for the measured mesh. */
static allowance allow(const char *text, double size, double result, double area, bool flat) {
  allowance s = { .step = 5 * size / 0x1p32, .chord = flat ? 0 : fmax(chord(result), coarser_chord(text, size)) };
  s.volume = (s.step + 4 * s.chord) * area;
  return s;
}

/* Defines (operands o place): the solids that set operations combine to o, each where all placements and then `place`
 * move it. A half-space has no size. The kernel's grid has the size of all operands, and a placement enlarges its
 * steps. */
static const char operands[] =
    "(define (operands o place) (define below (object-children o)) (case (object-kind o) "
    "[(half-space) '()] [(transform) (operands (car below) (lambda (x) (place (do-transform x (car (object-arguments "
    "o))))))] [(unite intersect subtract with-material layer highlight only) (append-map (lambda (x) (operands x "
    "place)) below)] [else (list (place o))]))";

/* Returns larger tolerances, from the size and area of all operands of the program. Called if the measures exceed the
 * tolerances by the size of the result alone. */
static allowance allow_wider(paths *p, const char *text, const looks *a, bool flat) {
  double area = 0, size = a->size;
  if (run(&p->kept, "%s(define whole (unite (operands o (lambda (x) x))))", operands) == VS_OUTCOME_DONE) {
    if (!number_of(&p->kept, "(area whole)", &area)) area = 0;
    if (!number_of(&p->kept, "(let ((b (bounding-box whole))) (distance (car b) (cadr b)))", &size)) size = a->size;
  }
  return allow(text, fmax(size, a->size), fmax(size, a->size), fmax(area, a->mesh.area), flat);
}

/* ---- checks of an object ---- */

static bool wrong(paths *p, const char *format, ...) {
  va_list rest;
  va_start(rest, format);
  vsnprintf(p->why, sizeof p->why, format, rest);
  va_end(rest);
  return true;
}

/* Returns the volume of the mesh's part beyond the plane where coordinate k equals `level`, in the direction of `sign`.
 * By Gauss's theorem, this volume is the flux of the field (0, 0, z - level), whose divergence is 1, through the
 * triangles, each cut at the plane. */
static double volume_beyond(const written_mesh *m, int k, double level, int sign) {
  double sum = 0;
  int u = (k + 1) % 3, v = (k + 2) % 3;
  for (size_t i = 0; i < m->count; i++) {
    double part[4][3]; /* for each corner of the cut triangle: its coordinates u and v in the plane, and its height
                        * above the plane */
    int n = 0;
    for (int c = 0; c < 3; c++) {
      const double *a = m->points[m->triangles[i][c]], *b = m->points[m->triangles[i][(c + 1) % 3]];
      double ha = a[k] - level, hb = b[k] - level, t = ha / (ha - hb);
      if (sign * ha > 0) part[n][0] = a[u], part[n][1] = a[v], part[n++][2] = ha;
      if ((sign * ha > 0) != (sign * hb > 0))
        part[n][0] = a[u] + t * (b[u] - a[u]), part[n][1] = a[v] + t * (b[v] - a[v]), part[n++][2] = 0;
    }
    for (int c = 2; c < n; c++) {
      double area = ((part[c - 1][0] - part[0][0]) * (part[c][1] - part[0][1]) -
                     (part[c - 1][1] - part[0][1]) * (part[c][0] - part[0][0])) / 2;
      sum += area * (part[0][2] + part[c - 1][2] + part[c][2]) / 3;
    }
  }
  return sum;
}

/* Returns true if the bounding box does not contain the mesh. The bounding box of a round shape is that of finer
 * facets. Rounding may leave a fin (a very thin piece) outside the box where coplanar faces were rotated. Fins with a
 * volume below 1e-12 of area times size do not count. */
static bool bad_bounds(paths *p, const looks *a, double slack) {
  for (int k = 0; k < 3; k++)
    for (int side = 0; side < 2; side++) {
      double level = side ? a->high[k] + slack : a->low[k] - slack, far = level;
      for (size_t i = 0; i < a->mesh.s.point_count; i++) {
        double at = a->mesh.s.points[i][k];
        if (side ? at > far : at < far) far = at;
      }
      if (far == level) continue;
      double beyond = fabs(volume_beyond(&a->mesh.s, k, level, side ? 1 : -1));
      if (a->solid && beyond <= 1e-12 * a->size * a->mesh.area) continue;
      return wrong(p, "the mesh reaches to %.9g along axis %d, and the bounds from %.9g to %.9g", far, k, a->low[k],
                   a->high[k]);
    }
  return false;
}

static bool bad_places(paths *p, const looks *a, double slack) {
  double at[PLACES][3], nearest;
  char places[PLACES * 100], answers[PLACES + 1];
  maker m = { .state = 0x9e3779b97f4a7c15u * (a->mesh.s.count + 1) + 1 };
  int n = 0;
  for (int i = 0; i < PLACES; i++) {
    for (int k = 0; k < 3; k++)
      at[i][k] = a->mesh.low[k] + (a->mesh.high[k] - a->mesh.low[k]) * (any(&m, 1 << 20) + 0.5) / (1 << 20);
    n += snprintf(places + n, sizeof places - (size_t)n, "(xyz %.17g %.17g %.17g)", at[i][0], at[i][1], at[i][2]);
  }
  if (run(&p->kept, "(for-each (lambda (p) (display (if (contains? o p) 1 0))) (list %s))", places) !=
          VS_OUTCOME_DONE ||
      strlen(p->kept.heard.out) != PLACES)
    return wrong(p, "contains?: %s", p->kept.heard.error);
  memcpy(answers, p->kept.heard.out, sizeof answers);
  for (int i = 0; i < PLACES; i++) {
    bool inside = winding(&a->mesh.s, at[i], &nearest) > 0.5;
    p->points++;
    p->inside += inside;
    if (nearest < slack || inside == (answers[i] == '1')) continue;
    return wrong(p, "at (xyz %.17g %.17g %.17g), %g from the surface, the mesh is %s and contains? says %c", at[i][0],
                 at[i][1], at[i][2], nearest, inside ? "there" : "not there", answers[i]);
  }
  return false;
}

/* Returns true if the answers or the meshes of two measurements a and b differ. how: text that describes how b was
 * measured. */
static bool differ(paths *p, const looks *a, const looks *b, const char *how) {
  if (strcmp(a->told, b->told) != 0) return wrong(p, "answers differ %s: %.300s and %.300s", how, a->told, b->told);
  if (a->drawn != b->drawn)
    return wrong(p, "%s: %.200s; %.200s", how, a->drawn ? "drawn" : a->error, b->drawn ? "drawn" : b->error);
  return a->drawn && !same_mesh(&a->mesh.s, &b->mesh.s) && wrong(p, "the mesh is another %s", how);
}

static bool off_by(double a, double b, double slack) { return !(fabs(a - b) <= slack); }

/* Returns true if an answer differs from the mesh by more than the tolerances. */
static bool bad_answers(paths *p, const looks *a, allowance s, bool flat) {
  /* a plane that cuts a round part at a low angle: facets move the edge of the cut by more than the chord height */
  if (bad_bounds(p, a, s.step + (flat ? 0 : a->size / 4096 + 4 * s.chord))) return true;
  if (a->solid && off_by(a->volume, a->mesh.volume, s.volume))
    return wrong(p, "(volume o) is %.12g, the mesh encloses %.12g, and %.3g is allowed%s", a->volume, a->mesh.volume,
                 s.volume, flat ? ", all is flat" : "");
  return a->solid && bad_places(p, a, 2 * s.step + 4 * s.chord);
}

static bool disagrees(paths *p, const char *text) {
  static looks a, b;
  p->why[0] = 0;
  p->made++;
  if (!look(&p->kept, text, false, VS_PASSES_ALL, &a))
    return p->refused++, strstr(p->kept.heard.error, ".c ") && wrong(p, "%s", p->kept.heard.error);
  if (!a.drawn) {
    p->nothing++;
    allowance s = allow_wider(p, text, &a, false);
    return a.solid && a.volume > s.volume &&
           wrong(p, "(volume o) is %.9g, and nothing is written: %.300s", a.volume, a.error);
  }
  bool flat = is_flat(&p->kept);
  p->flat += flat;
  p->compared++;
  allowance s = allow(text, a.size, a.size, a.mesh.area, flat);
  if (bad_answers(p, &a, s, flat)) {
    s = allow_wider(p, text, &a, flat);
    if (bad_answers(p, &a, s, flat)) return true;
    p->why[0] = 0;
  }
  if (!look(&p->kept, text, true, VS_PASSES_ALL, &b))
    return wrong(p, "refused the second time: %s", p->kept.heard.error);
  if (differ(p, &a, &b, "when it is measured first")) return true;
  if (!look(&p->bare, text, false, VS_PASSES_ALL, &b))
    return wrong(p, "refused without memory: %s", p->bare.heard.error);
  if (differ(p, &a, &b, "when nothing is kept")) return true;
  if (!look(&p->kept, text, false, 0, &b)) return wrong(p, "refused without passes: %s", p->kept.heard.error);
  if (strcmp(a.told, b.told) != 0) return wrong(p, "answers differ without passes: %.300s and %.300s", a.told, b.told);
  if (!b.drawn) return wrong(p, "without passes nothing is written: %.300s", b.error);
  if (off_by(a.mesh.volume, b.mesh.volume, s.volume)) s = allow_wider(p, text, &a, flat);
  return off_by(a.mesh.volume, b.mesh.volume, s.volume) &&
         wrong(p, "the mesh encloses %.12g, without passes %.12g, and %.3g is allowed", a.mesh.volume, b.mesh.volume,
               s.volume);
}

/* Returns true if the answers for the program are wrong. A program that a busy machine did not finish in time does not
 * count. */
static bool fails(void *context, const char *text) {
  paths *p = context;
  bool bad = disagrees(p, text), late = bad && strstr(p->why, "stopped after");
  p->late += late;
  return bad && !late;
}

static size_t seen_samples[SAMPLES], seen_ways[100], seen_sets[100];

static void paths_agree(void **state) {
  (void)state;
  static char text[MODEL_ROOM];
  static paths p;
  seed_range seeds = seeds_asked(500, 10000);
  unsigned long long bad = 0;
  assert_true(path_samples() || path_samples_read(samples_file));
  begin(&p.kept, 0);
  begin(&p.bare, SIZE_MAX);
  p.kept.file = p.bare.file = samples_file; /* the file names in the samples are relative to the folder of the samples'
                                             * file */
  for (unsigned long long seed = seeds.from; seed <= seeds.to; seed++) {
    size_t sample, way, set, compared = p.compared;
    path_make(seed, text, &sample, &way, &set);
    if (getenv("SHOW")) fprintf(stderr, "seed %llu: %s\n", seed, text);
    bool fault = fails(&p, text);
    if (getenv("SHOW") && p.compared == compared && !fault) fprintf(stderr, "  not compared: %s\n", p.kept.heard.error);
    if (p.compared > compared) seen_samples[sample]++, seen_ways[way]++, seen_sets[set]++;
    if (!fault) continue;
    bad++;
    char label[200];
    snprintf(label, sizeof label, "%s, ", path_sample(sample));
    report_seed(label, seed, text, fails, &p, p.why);
  }
  vs_free(p.kept.vm);
  vs_free(p.bare.vm);
  if (getenv("TELL") || seeds.asked)
    fprintf(stderr,
            "%zu programs, %zu late, %zu refused, %zu of nothing, %zu compared, %zu of them flat; %zu points, %zu inside; %llu "
            "wrong\n",
            p.made, p.late, p.refused, p.nothing, p.compared, p.flat, p.points, p.inside, bad);
  if (getenv("TELL"))
    for (size_t i = 0; i < path_samples(); i++)
      if (!seen_samples[i]) fprintf(stderr, "never compared: %s\n", path_sample(i));
  assert_int_equal(bad, 0);
  if (seeds.to - seeds.from < 400) return;
  for (size_t i = 0; seeds.to - seeds.from > 5000 && i < path_samples(); i++)
    if (!seen_samples[i] && !path_is_nothing(path_sample(i))) fail_msg("%s was never compared", path_sample(i));
  assert_true(p.late * 50 < p.made);
  assert_true(p.compared * 2 > p.made && p.flat * 8 > p.compared);
  for (size_t i = 0; i < path_ways(); i++) assert_true(seen_ways[i]);
  for (size_t i = 0; i < path_sets(); i++) assert_true(seen_sets[i]);
}

/* Returns true if the mesh reaches beyond the bounds by more than 1/1000 of their side along the same axis. A map may
 * enlarge a short side alone, so the error must not follow from the longest side. */
static bool bad_sides(paths *p, const looks *a) {
  for (int k = 0; k < 3; k++) {
    double slack = (a->high[k] - a->low[k]) / 1000 + 5 * a->size / 0x1p32;
    if (a->mesh.low[k] < a->low[k] - slack || a->mesh.high[k] > a->high[k] + slack)
      return wrong(p, "along axis %d the mesh reaches from %.9g to %.9g, and the bounds from %.9g to %.9g", k,
                   a->mesh.low[k], a->mesh.high[k], a->low[k], a->high[k]);
  }
  return false;
}

/* Tests each sample in the first of the thicknesses, which do not change a solid; with LONG=1 in all of them. */
static void thin_objects_have_precise_bounds(void **state) {
  (void)state;
  static char text[MODEL_ROOM];
  static paths p;
  static looks a;
  static const char *const thicknesses[] = { "1/8", "1/11", "1/30" };
  const char *longer = getenv("LONG");
  size_t widths = longer && *longer ? sizeof thicknesses / sizeof *thicknesses : 1, bad = 0;
  assert_true(path_samples() || path_samples_read(samples_file));
  begin(&p.kept, 0);
  p.kept.file = samples_file;
  for (size_t i = 0; i < path_samples(); i++)
    for (size_t k = 0; k < widths; k++) {
      path_thin(i, thicknesses[k], text);
      p.made++;
      if (!look(&p.kept, text, false, VS_PASSES_ALL, &a) || !a.drawn || !a.solid) break;
      p.compared++;
      if (bad_sides(&p, &a)) bad++, fprintf(stderr, "%s: %s\n%s\n", path_sample(i), p.why, text);
    }
  vs_free(p.kept.vm);
  if (getenv("TELL")) fprintf(stderr, "%zu thin objects, %zu compared, %zu wrong\n", p.made, p.compared, bad);
  assert_int_equal(bad, 0);
  assert_true(p.compared * 2 > p.made);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(paths_agree), cmocka_unit_test(thin_objects_have_precise_bounds) };
  cmocka_set_test_filter(getenv("TESTS"));
  return cmocka_run_group_tests_name("one object by every path", tests, NULL, NULL);
}
