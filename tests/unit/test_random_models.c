/* Tests the solids of random programs (tests/oracle/models.h). Each program must end with an error of the model, or its
 * solid has these properties:
 *
 * - The mesh is closed and does not intersect itself, as doubles (.off has 12 digits) and as 32-bit numbers (.stl),
 * unless the writer warns.
 *
 * - Volumes of operands and results agree: |a u b| + |a n b| = |a| + |b|, |a - b| + |a n b| = |a|.
 *
 * - (contains? o p) agrees with the mesh's winding number at random points that are not next to the surface, and
 * (volume o) agrees with the mesh's volume.
 *
 * Models whose parts are rotated by 1e-5 to 1e-7 degrees must have the first property in four formats, with .ply
 * (doubles) and .glb among them. Tests a sample of 500 models, and 300 of the rotated models; with LONG=1 ten thousand
 * of each kind, or those of SEEDS=FROM-TO. The test shrinks a failing program as long as it fails, and prints it.
 * TELL=1 prints the counts. */
#include "tests/unit/trials.h"
#include "tests/unit/seeds.h"

enum { POINTS = 12 };

static size_t models, refused, empty, solids, warned, asked_points, inside_points, made_of[64], silent[4], told[4];

/* ---- checks of a model ---- */

static bool bad_part(trial *t, const char *suffix, size_t which, written *w, bool *more) {
  crossings_found found;
  if (!write_as(t, suffix, which, w, more)) {
    bool fault = strstr(t->heard.error, "fault of vs") != NULL;
    if (fault) snprintf(t->why, sizeof t->why, "%s: %s", suffix, t->heard.error);
    return fault;
  }
  if (!crossings_find((const crossings_point *)w->s.points, w->s.point_count, (const crossings_triangle *)w->s.triangles, w->s.count, &found)) abort();
  size_t open = written_open_edges(&w->s), faults = crossings_sum(&found) - found.count[CROSSINGS_TOUCHING];
  bool says = strstr(t->heard.warning, "touch or cross");
  warned += faults && says;
  if (!open && (!faults || says)) return false;
  int n = snprintf(t->why, sizeof t->why, "%s has %zu open edges", suffix, open);
  for (int k = 0; k < CROSSINGS_KINDS; k++)
    if (found.count[k]) n += snprintf(t->why + n, sizeof t->why - (size_t)n, ", %zu %s", found.count[k], crossings_names[k]);
  return true;
}

/* Checks every mesh of a .glb file, or the single mesh of another format. */
static bool bad_mesh(trial *t, const char *suffix, written *w) {
  bool more, bad = bad_part(t, suffix, 0, w, &more);
  for (size_t which = 1; !bad && more; which++) {
    release(w);
    bad = bad_part(t, suffix, which, w, &more);
  }
  return bad;
}

/* Numbers of facets of a full turn. FINE replaces USUAL where two results disagree. The test tries FINER where FINE
 * takes too long, and FINEST where FINE is not enough: a plane that cuts a round part at a low angle removes a wide,
 * shallow piece. */
enum { USUAL = 24, FINE = 96, FINER = 48, FINEST = 384 };

typedef enum { RIGHT, WRONG, UNTOLD } verdict;

/* Returns an upper bound of the step of the kernel's grid for the model. The grid has 2^32 steps for all leaves, and
 * the step is 1, 2 or 5 times a power of ten. The kernel uses the next larger step if a normal vector would be too
 * long. Returns 0 if the model's bounds are unknown. */
static double widest_step(trial *t) {
  double diagonal;
  if (!number_of(t, "(let ((b (bounding-box leaves))) (distance (car b) (cadr b)))", &diagonal)) return 0;
  if (!isfinite(diagonal)) return 0;
  return 5 * diagonal / 0x1p32;
}

/* Returns a bound of the rounding error of the volumes of a, b and their combinations. Each mesh is made on its own
 * grid. Rounding moves a corner by at most half a step along an axis. A volume therefore changes by at most half a step
 * times the area, as seen along three axes. Called only if volumes differ, because areas take as long as volumes. */
static double grid_slack(trial *t, const char *text, const char *end, int facets) {
  static const char *const whose[] = { "(area (unite a))", "(area (unite b))", "(area (unite a b))",
                                       "(area (intersect a b))", "(area (subtract a b))" };
  static char all[MODEL_ROOM];
  /* ENLARGED: number of a text. It computes the bounding box of the other solids in the axes of a rotated half-space,
   * enlarges it by a thirty-second, and adds the bounds of this box in world axes */
  enum { ENLARGED = 4 };
  double sum = 0, area;
  bool halves = false;
  size_t n = 0;
  for (const char *from = text; from < end && n + 16 < sizeof all;) { /* changes each set operation to a union, so that
                                                                       * the bounds of the result include all leaves */
    if (strncmp(from, "(make-half-space ", 17) == 0) { /* the kernel makes a half-space only as large as the other
                                                        * solids in the operation require */
      n += (size_t)snprintf(all + n, sizeof all - n, "(unite)");
      from = end_of(from), halves = true;
      continue;
    }
    size_t word = strncmp(from, "(subtract ", 10) == 0 ? 10 : strncmp(from, "(intersect ", 11) == 0 ? 11 : 0;
    if (word) n += (size_t)snprintf(all + n, sizeof all - n, "(unite "), from += word;
    else all[n++] = *from++;
  }
  all[n] = 0;
  if (run(t, "(define leaves (parameterize ((current-segments %d)) %s)))", facets, all) != VS_OUTCOME_DONE) return 0;
  double step = widest_step(t) * (halves ? ENLARGED : 1);
  for (int i = 0; step > 0 && i < 5; i++)
    if (number_of(t, whose[i], &area)) sum += area;
  return step / 2 * sqrt(3) * sum;
}

/* Returns the text without the numbers of facets of single parts, so that the test can set the number for all parts. */
static const char *unfaceted(const char *text) {
  static char copy[TEXT];
  snprintf(copy, sizeof copy, "%s", text);
  for (char *p = copy; (p = strstr(p, "#:segments ")) != NULL;) {
    size_t length = strlen("#:segments ");
    length += strspn(p + length, "0123456789");
    memset(p, ' ', length);
  }
  return copy;
}

/* Compares the volumes of two solids and of their combinations. The solids are the first two operands of the model's
 * set operation. Round parts have `facets` facets. */
static verdict volumes_of(trial *t, const char *text, int facets) {
  if (strncmp(text, "(unite ", 7) != 0 && strncmp(text, "(subtract ", 10) != 0 && strncmp(text, "(intersect ", 11) != 0)
    return UNTOLD;
  if (facets != USUAL) text = unfaceted(text);
  const char *a = strchr(text, ' ') + 1, *b = end_of(a);
  if (*b != ' ') return UNTOLD;
  const char *end = end_of(++b);
  double va, vb, both, common, less;
  if (run(t,
          "(define a (parameterize ((current-segments %d)) %.*s)) "
          "(define b (parameterize ((current-segments %d)) %.*s))",
          facets, (int)(b - a - 1), a, facets, (int)(end - b), b) != VS_OUTCOME_DONE)
    return UNTOLD;
  if (!number_of(t, "(volume (unite a))", &va) || !number_of(t, "(volume (unite b))", &vb)) return UNTOLD;
  bool ok = number_of(t, "(volume (unite a b))", &both) && number_of(t, "(volume (intersect a b))", &common) &&
            number_of(t, "(volume (subtract a b))", &less);
  if (!ok) {
    if (!strstr(t->heard.error, "fault of vs")) return UNTOLD;
    snprintf(t->why, sizeof t->why, "%s", t->heard.error);
    return WRONG;
  }
  /* `slack` allows for facets: the volume of a whole part comes from its formula, that of a cut part from its facets. A
   * sphere of 24 facets has 2 % less volume than its formula. With more facets the difference decreases at least in
   * proportion */
  double slack = 0.03 * USUAL / facets * (va + vb), most = fmax(fabs(both + common - va - vb), fabs(less + common - va));
  most = fmax(most, fmax(fmax(va, vb) - both, common - fmin(va, vb)));
  if (most <= slack || most <= slack + grid_slack(t, text, end, facets)) return RIGHT;
  snprintf(t->why, sizeof t->why, "volumes: a %.9g, b %.9g, a u b %.9g, a n b %.9g, a - b %.9g", va, vb, both, common,
           less);
  return WRONG;
}

/* Returns true if the volumes disagree. Facets explain a difference only if it vanishes with finer facets: the volume
 * of a whole part comes from its formula, that of a cut part from its facets. If finer models take too long, the
 * difference counts as a fault. */
static bool bad_volumes(trial *t, const char *text) {
  static char why[sizeof t->why];
  if (volumes_of(t, text, USUAL) != WRONG) return false;
  if (strstr(t->why, "fault of vs")) return true;
  memcpy(why, t->why, sizeof why);
  verdict finer = volumes_of(t, text, FINE);
  if (finer == UNTOLD) finer = volumes_of(t, text, FINER);
  if (finer != WRONG) memcpy(t->why, why, sizeof why);
  return finer != RIGHT;
}

/* Returns the winding number of the model's mesh at the point; round parts have `facets` facets. Returns NAN if the
 * mesh cannot be made or written in time. */
static double winding_at(trial *t, const char *text, const double at[3], int facets) {
  bool more;
  written fine;
  double nearest, turns = NAN;
  vs_restart(t->vm);
  if (run(t, "(draw (parameterize ((current-segments %d)) %s))", facets, unfaceted(text)) == VS_OUTCOME_DONE &&
      write_as(t, ".off", 0, &fine, &more)) {
    turns = winding(&fine.s, at, &nearest);
    release(&fine);
  }
  return turns;
}

static bool bad_inside(trial *t, const char *text, const written *w, uint64_t seed) {
  double size = 0, at[POINTS][3];
  maker m = { .state = seed * 0x9e3779b97f4a7c15u + 1 };
  char points[POINTS * 100];
  int n = 0;
  for (int k = 0; k < 3; k++) size = fmax(size, w->high[k] - w->low[k]);
  for (int i = 0; i < POINTS; i++) {
    for (int k = 0; k < 3; k++) at[i][k] = w->low[k] + (w->high[k] - w->low[k]) * (any(&m, 1 << 20) + 0.5) / (1 << 20);
    n += snprintf(points + n, sizeof points - (size_t)n, "(xyz %.17g %.17g %.17g)", at[i][0], at[i][1], at[i][2]);
  }
  if (run(t, "(for-each (lambda (p) (display (if (contains? o p) 1 0))) (list %s))", points) != VS_OUTCOME_DONE || strlen(t->heard.out) != POINTS) return false;
  char answers[POINTS + 1];
  memcpy(answers, t->heard.out, sizeof answers);
  for (int i = 0; i < POINTS; i++) {
    double nearest, turns = winding(&w->s, at[i], &nearest);
    bool inside = turns > 0.5;
    asked_points++;
    inside_points += inside;
    if (nearest < 0.025 * size || inside == (answers[i] == '1')) continue;
    double finer = winding_at(t, text, at[i], FINE);
    if (isnan(finer)) finer = winding_at(t, text, at[i], FINER);
    else if ((finer > 0.5) != (answers[i] == '1')) finer = winding_at(t, text, at[i], FINEST);
    /* If a mesh with finer facets agrees with contains?, the coarser facets caused the difference. If no such mesh can
     * be made, the difference counts as a fault. */
    if ((finer > 0.5) == (answers[i] == '1') && !isnan(finer)) continue;
    snprintf(t->why, sizeof t->why, "at (xyz %.17g %.17g %.17g) the mesh winds %g times, and contains? says %c", at[i][0], at[i][1], at[i][2], turns, answers[i]);
    return true;
  }
  return false;
}

/* Returns true if the model is wrong, and writes the reason to t->why. The shrinking of a program calls this function,
 * and keeps only programs that are still wrong. */
static bool fails(void *context, const char *text) {
  trial *t = context;
  written off = { .volume = 0 }, single = { .volume = 0 };
  double v = 0;
  t->why[0] = 0;
  vs_restart(t->vm);
  if (run(t, "(define o (parameterize ((current-segments 24)) %s))", text) != VS_OUTCOME_DONE || run(t, "(draw o)") != VS_OUTCOME_DONE) {
    refused++;
    if (!strstr(t->heard.error, "fault of vs")) return false;
    snprintf(t->why, sizeof t->why, "%s", t->heard.error);
    return true;
  }
  bool solid = number_of(t, "(if (solid? o) 1 0)", &v) && v > 0; /* if the object is not a solid, its .off file also
                                                                  * contains surfaces that are not closed */
  bool bad = (solid && bad_mesh(t, ".off", &off)) || bad_mesh(t, ".stl", &single);
  static const char *const others[] = { ".ply", ".glb" };
  for (int i = 0; i < 2 && solid && !bad && t->volumes; i++) {
    written other = { .volume = 0 };
    bad = bad_mesh(t, others[i], &other);
    release(&other);
  }
  if (!bad && !off.s.count) empty++;
  if (!bad && off.s.count) {
    solids++;
    bool measured = number_of(t, "(volume o)", &v);
    double size = 0;
    for (int k = 0; k < 3; k++) size = fmax(size, off.high[k] - off.low[k]);
    if (!measured && strstr(t->heard.error, "fault of vs")) snprintf(t->why, sizeof t->why, "%s", t->heard.error), bad = true;
    /* (volume o) comes from a formula, or from a finer mesh. The surface of the written mesh is within the chord height
     * (distance of facet and arc) of the exact surface, .0086 of a radius. If a solid is thinner than that, most of it
     * may be missing in the coarser mesh: therefore the larger of the two areas counts. */
    double chord = 0.01 * size, area = off.area;
    if (measured && fabs(v - off.volume) > chord * area + 1e-9 && number_of(t, "(area o)", &area)) area = fmax(area, off.area);
    if (measured && fabs(v - off.volume) > chord * area + 1e-9)
      snprintf(t->why, sizeof t->why, "(volume o) is %.9g, and the mesh encloses %.9g", v, off.volume), bad = true;
    bad = bad || (t->volumes && bad_volumes(t, text)) || bad_inside(t, text, &off, 7);
  }
  release(&off);
  release(&single);
  return bad;
}

static void models_are_right(void **state) {
  (void)state;
  static char text[MODEL_ROOM];
  static trial t;
  seed_range seeds = seeds_asked(500, 10000);
  unsigned long long bad = 0;
  begin(&t, 0);
  for (unsigned long long seed = seeds.from; seed <= seeds.to; seed++) {
    model_make(seed, text);
    models++;
    if (getenv("SHOW")) fprintf(stderr, "seed %llu: %s\n", seed, text);
    size_t before = solids;
    t.volumes = seed % 4 == 0 || seeds.whole;
    bool wrong = fails(&t, text);
    for (size_t i = 0; solids > before && i < model_kinds() && i < 64; i++) {
      char word[64];
      made_of[i] += model_kind_word(i, word) && strstr(text, word);
    }
    if (!wrong) continue;
    bad++;
    report_seed("", seed, text, fails, &t, t.why);
  }
  vs_free(t.vm);
  if (getenv("TELL") || seeds.asked)
    fprintf(stderr, "%zu models, %zu refused, %zu without a mesh, %zu solids, %zu written with a warning, %zu points, %zu inside; %llu wrong\n", models, refused, empty, solids, warned, asked_points,
            inside_points, bad);
  assert_int_equal(bad, 0);
  if (seeds.to - seeds.from < 400) return;
  assert_true(solids * 4 > models && inside_points * 10 > asked_points); /* checks that the run has tested enough solids
                                                                          * and points */
  for (size_t i = 0; i < model_kinds() && i < 64; i++)
    if (!made_of[i])
      fail_msg("no solid was made of the kind %s: it wants a line in tests/oracle/models.c", model_kind(i));
}

/* Models that vs once wrote wrong without a warning. Their difficulties: a hole of the profile that touches the outline
 * in a corner; thin triangles with one direction beside a place where the surface touches itself; a sweep that overlaps
 * itself completely, whose inner walls coincide; needles so thin that rounding left too little volume for the check of
 * bounds; a low triangle beside a sharp edge, which rounding tilts by more than the edge's angle; mirrored quads that
 * are not flat. */
static void wrong_examples_are_right(void **state) {
  (void)state;
  static const char *const texts[] = {
    "(do-extrude (do-project (unite (make-box (xyz 0 -0.9 -0.1) 2 0.5 0.05) (scope-place (make-ffd-scope (xyz -2 2 0) "
    "(xyz 2 2 0) (xyz -1 1 0.8) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 -2 0) (xyz -1 -1 3) (xyz 0.9 -1 0)) (do-rotate "
    "(make-box (xyz -0.1 -0.1 -1) 2 0.5 2) 'x 8e-5))) 'xy) 1)",
    "(do-sweep (make-region (make-circle (xy 3 0) 1) (make-circle (xy 3 0) .5)) (make-circle (xy 3 0) 0.75) 4e-8 2.25)",
    "(do-sweep (make-polygon (xy 0 0) (xy 2 0) (xy 2 1) (xy 0 1)) (make-polygon (xy 0 0) (xy 2 0) (xy 2 1) (xy 0 1)))",
    "(subtract (make-cone (xyz 1e-6 -2.25 -0.8) (xyz 2 -2 -2) 1e-6) (make-cone (xyz 1e-6 -2.25 -0.8) (xyz 2 -1.5 -2) "
    "1e-6))",
    "(do-transform (subtract (make-e-cone (xyz 0.75 -2.25 2.2) 1.125 1.875 (xyz 1.5 -1.5 0.75) 1.875) (do-rotate "
    "(make-e-cone (xyz 0.75 -2.25 2.25) 1.125 1.88 (xyz 1.5 -1.5 0.75) 1.875) (vxyz 1 2 3) 3e-10)) (make-matrix 1 0 0 0 "
    " 0 1 0 0  .25 0 1 0  0 0 0 1))",
    /* a surface with three layers that are closer than numbers of 12 digits can separate */
    "(intersect (scope-place (make-ffd-scope (xyz -2 2 0) (xyz 2 2 0) (xyz -1 1 1.5) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 -2 "
    "0) (xyz -1 -1 3) (xyz 2 2 3)) (make-box (xyz -2 -3 2) (xyz 0 0.8 -2))) (make-half-space (vxyz 1 2 3)))",
    /* a folded hexahedron; a path that reverses in cusps, where it has no direction */
    "(scope-place (make-ffd-scope (xyz -2 2 0) (xyz 2 2 0) (xyz -1 1 3) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 -2 0) (xyz -1 "
    "-1 3) (xyz -0.5 1.5 0)) (make-box (xyz 0.9 1e-3 1e-6) 0.5 0.5 1))",
    "(scope-place (make-ffd-scope (xyz -2 2 0) (xyz 2 2 0) (xyz -1 1 2) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 -2 0) (xyz -1 "
    "-1 3) (xyz -1 0 0)) (make-box (xyz -0.9 -2 0) 2 2 2))",
    "(intersect (do-loft (list (make-circle origin 1) (do-move (make-polygon (xy 3 0) (xy 2 .5) (xy 2 2)) (vxyz 0 0 "
    "2)))) (do-sweep (make-polygon (xy 0 0) (xy 2 1) (xy 0 1)) (make-spline (list (xy 1 0) (xy 3 0) (xyz 2 0 0) (xy 1 "
    "0))) 0.8))",
    /* a correct mesh that vs must also report as correct: the remaining solid is about as thin as a step of the
     * kernel's grid, and each set operation has another grid */
    "(subtract (subtract (make-pyramid (xyz -0.8 0.8 0) 2 16 (xyz -3 2 0.8) 1.9) (make-pyramid (xyz -0.8 0.8 0) 2 16 "
    "(xyz -3 2 0.8) 2)) (do-slice (subtract (make-pyramid (xyz -0.8 0.8 0) 2 16 (xyz -3 2 0.8) 2) (make-pyramid (xyz "
    "-0.8 0.8 0) 2 16 (xyz -3 2 0.8) 2) (do-scale (make-box (xyz -1 0.2 1) 2 0.5 1) (list 1 1 100))) 'yz))",
    "(subtract (subtract (let ((bow (make-spline (xyz 1 0 0) (xyz 1 0 4)))) (do-guided-loft (list (make-circle "
    "origin 1) (xyz 0 0 4)) (do-rotate bow 'z pi))) (do-rotate (let ((bow (make-spline (xyz 1 0 0) (xyz 1 0 4)))) "
    "(do-guided-loft (list (make-circle origin 1) (xyz 0 0 4)) (do-rotate bow 'z pi))) 'z 7e-7)) (do-rotate "
    "(subtract (do-scale (let ((bow (make-spline (xyz 1 0 0) (xyz 2.625 0 2) (xyz 1 0 4)))) (do-guided-loft (list "
    "(make-circle origin 1) (make-circle (xyz 0 0 4) 1)) (list bow (do-rotate bow 'z pi)))) (list 1 1 100)) "
    "(do-rotate (do-scale (let ((bow (make-spline (xyz 1 0 0) (xyz 2.625 0 2) (xyz 1 0 4)))) (do-guided-loft (list "
    "(make-circle origin 1) (make-circle (xyz 0 0 4) 1)) (list bow (do-rotate bow 'z pi)))) (list 1 1 100)) 'z "
    "7e-7)) 'z 9e-6))",
    /* a folded hexahedron that nearly touches its floor, and touches it in 32-bit floats */
    "(scope-place (make-ffd-scope (xyz -2 2 0) (xyz 2 2 0) (xyz -1 1 0.375) (xyz 1 1 3) (xyz -2 -2 0) (xyz 2 -2 0) "
    "(xyz -1 -1 3) (xyz -0.5 1 0)) (make-box (xyz -2 -1 -1) 4 2 0.05))",
    /* in .glb, rounding moves an edge of a narrow slit past the opposite edge, so the floors beside the slit overlap */
    "(subtract (unite (do-extrude (do-project (do-sweep (make-circle (xy 3 0) 0.25) (make-polygon (xy 1 0) (xy 3 0) "
    "(xy 2 1.5)) (* 8 1/4 pi)) 'xy) 1) (make-box (xyz -0.5 -2 -0.125) 0.5 0.5 2.05) (make-box (xyz -0.5 -1.625 0) "
    "1.5 1.5 0.05)) (do-scale (make-box (xyz -2 -0.875 -0.035149951465427876) 1.5 0.5 1.05) (list 1 1 .01)))",
    "(do-mirror (make-polyface-mesh (list (xyz 0 0 0) (xyz 2 0 0) (xyz 2 2 0) (xyz 0 2 2) (xyz 0 0 2) (xyz 2 0 2) "
    "(xyz 2 2 2) (xyz 0 2 2)) '((1 4 3 2) (4 1 5 8)) #:repair #t) 'yz)",
  };
  static trial t;
  begin(&t, 0);
  t.volumes = true;
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    if (fails(&t, texts[i])) fail_msg("%s: %s", t.why, texts[i]);
  vs_free(t.vm);
}

/* ---- models whose parts are rotated by a very small angle ---- */

/* Returns true if the model's mesh in one of the formats intersects itself without a warning. */
static bool is_silent(void *context, const char *text) {
  static const char *const suffixes[] = { ".off", ".stl", ".ply", ".glb" };
  trial *t = context;
  char why[sizeof t->why] = "";
  vs_restart(t->vm);
  if (run(t, "(draw (parameterize ((current-segments 12)) %s))", text) != VS_OUTCOME_DONE) return false;
  for (int i = 0; i < 4; i++) {
    written w = { .volume = 0 };
    t->why[0] = 0;
    if (bad_mesh(t, suffixes[i], &w)) {
      silent[i]++;
      snprintf(why + strlen(why), sizeof why - strlen(why), "%.200s; ", t->why);
    }
    told[i] += strstr(t->heard.warning, "touch or cross") != NULL;
    release(&w);
  }
  memcpy(t->why, why, sizeof why);
  return why[0];
}

/* Models that vs once wrote wrong without a warning. Their difficulties: folds beside a collapsed part; a triangle that
 * turns over between two triangles with one direction; a corner that crosses an edge within a plane perpendicular to an
 * axis; edges of three units. */
static void turned_examples_are_right(void **state) {
  (void)state;
  static const char *const texts[] = {
    "(subtract (make-pyramid (xyz 0 1 -4) 2 32 (xyz 0 1 -2) 2) (do-rotate (make-box (xyz 1 0 -4) (xyz 2 5 -3)) 'x (* "
    "1e-5 (/ pi 180))))",
    "(do-move (subtract (unite (make-sphere (xyz 0 0 -2) 2) (do-rotate (make-sphere (xyz 0 0 -2) 2) 'y "
    "(degrees->radians -4e-5)) (do-rotate (make-pyramid (xyz 0 0 -4) 1 16 (xyz 0 0 -2) 1) "
    "(vxyz 1 0 1) (degrees->radians -2e-6))) (make-box (xyz 0 0 0) (xyz 2 1 1))) (vxyz 100 20 3))",
    "(do-scale (unite (make-box (xyz -1 -1 -3) (xyz 1 2 -2)) (do-rotate (subtract (make-box (xyz -2 -2 -2) (xyz 1 0 "
    "1)) (make-box (xyz -2 -1 -3) (xyz 0 0 -1))) 'z (degrees->radians -6e-7))) .001)",
    "(do-rotate (unite (unite (make-box (xyz 0 0 -1) (xyz 1 4 1)) (do-rotate (make-prism (xyz 2 1 -1) 2 16 (xyz 2 1 "
    "1)) 'z (degrees->radians 3e-5)) (do-rotate (make-prism (xyz -1 2 -1) 1 12 "
    "(xyz -1 2 0)) 'y (degrees->radians 8e-7))) (make-box (xyz 2 -1 -2) (xyz 5 1 2))) 'z .5)",
    /* needle-shaped cells: a thirtieth of a grid step long, and too thin to contain any line */
    "(intersect (intersect (make-box (xyz -2 0 -3) (xyz 1 2 -2)) (make-prism (xyz 0 2 -3) 2 16 (xyz 0 2 0))) "
    "(do-rotate (intersect (make-box (xyz -2 0 -3) (xyz 1 2 -2)) (make-prism (xyz 0 2 -3) 2 16 (xyz 0 2 0))) 'x "
    "(degrees->radians -2e-7)) (do-rotate (unite (make-box (xyz 0 2 -1) (xyz 3 4 0)) (do-rotate (make-box (xyz 2 -1 0) "
    "(xyz 4 2 2)) 'y (degrees->radians 7e-5)) (do-rotate (make-box (xyz -1 -1 -4) (xyz 2 3 -3)) 'y (degrees->radians "
    "6e-6))) (vxyz 2 -1 1) (degrees->radians 3e-5)))",
    /* a triangle so low that rounding to doubles reverses it, although rounding to 12 digits does not */
    "(unite (make-prism (xyz 1 -2 -3) 1 15 (xyz 1 -2 0)) (do-rotate (make-prism (xyz 1 -2 -3) 1 15 (xyz 1 -2 0)) (vxyz "
    "2 2 1) (degrees->radians -2e-7)) (make-pyramid (xyz -1 -1 -3) 2 8 (xyz -1 -1 1) 2))",
    /* a wedge whose two planes coincide once their corners are doubles */
    "(subtract (subtract (make-box (xyz 1 -1 -4) (xyz 3 3 -2)) (do-rotate (make-box (xyz 1 -1 -4) (xyz 3 3 -2)) 'z "
    "(degrees->radians -7e-6))) (do-rotate (subtract (make-box (xyz 1 -1 -4) (xyz 3 3 -2)) (do-rotate (make-box (xyz 1 "
    "-1 -4) (xyz 3 3 -2)) 'z (degrees->radians -7e-6))) 'y (degrees->radians 3e-7)))",
    /* two neighbouring triangles whose planes coincide once their corners are doubles; the triangles have only their
     * common edge in contact */
    "(unite (subtract (make-prism (xyz 1 -2 -1) 2 9 (xyz 1 -2 2)) (do-rotate (make-prism (xyz 1 -2 -1) 2 9 (xyz 1 -2 "
    "2)) (vxyz 0 1 1) (degrees->radians 5e-7)) (make-box (xyz 2 -1 -4) (xyz 5 2 -1))) (do-rotate (make-box (xyz 0 -1 "
    "-1) (xyz 3 0 3)) 'z (degrees->radians 4e-6)))",
    /* a shell whose corners coincide once they are doubles */
    "(unite (make-sphere (xyz -2 1 -1) 2) (do-rotate (subtract (make-sphere (xyz 1 0 -4) 2) (do-rotate (make-box (xyz "
    "1 -1 -4) (xyz 3 2 0)) 'x (degrees->radians 9e-7))) 'y (degrees->radians -1e-5)))",
  };
  static trial t;
  begin(&t, 0);
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
    if (is_silent(&t, texts[i])) fail_msg("%s: %s", t.why, texts[i]);
  vs_free(t.vm);
}

/* Tests the models with slightly rotated parts: a sample of 300 seeds, with LONG=1 ten thousand, or those of
 * SEEDS=FROM-TO. */
static void turned_models_are_right(void **state) {
  (void)state;
  static char text[MODEL_ROOM];
  static trial t;
  seed_range seeds = seeds_asked(300, 10000);
  unsigned long long bad = 0;
  begin(&t, 0);
  for (unsigned long long seed = seeds.from; seed <= seeds.to; seed++) {
    model_make_turned(seed, text);
    if (getenv("SHOW")) fprintf(stderr, "seed %llu: %s\n", seed, text);
    if (!is_silent(&t, text)) continue;
    bad++;
    report_seed("turned, ", seed, text, is_silent, &t, t.why);
  }
  vs_free(t.vm);
  if (getenv("TELL") || seeds.asked)
    fprintf(stderr,
            "%llu turned models: silent %zu .off, %zu .stl, %zu .ply, %zu .glb; with a warning %zu, %zu, %zu, %zu\n",
            seeds.to - seeds.from + 1, silent[0], silent[1], silent[2], silent[3], told[0], told[1], told[2], told[3]);
  assert_int_equal(bad, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(models_are_right), cmocka_unit_test(wrong_examples_are_right),
                                      cmocka_unit_test(turned_examples_are_right),
                                      cmocka_unit_test(turned_models_are_right) };
  cmocka_set_test_filter(getenv("TESTS"));
  return cmocka_run_group_tests_name("random models of all kinds", tests, NULL, NULL);
}
