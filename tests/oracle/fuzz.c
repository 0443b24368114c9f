/* Tests the kernel with random trees of boxes, cylinders, cones, spheres and tori. The solids are nested, rotated,
 * flush with each other, or at arbitrary coordinates.
 *
 *   usage: fuzz [-v] [-s FIRST_SEED] [COUNT]; fuzz -p cell|turned|spelt SEED
 *
 * Each seed makes two trees a and b. Every result must be closed, have winding number one, not intersect itself
 * (tests/tools/crossings.h: as doubles, as 12 digits, as 32-bit numbers), and be equal for one thread and three. The
 * volumes must satisfy |a u b| = |a| + |b| - |a n b|, |a - b| = |a| - |a n b|, a - (a - b) = a n b, a - a = 0, a u a =
 * a, and De Morgan's law inside a box around a and b. The volumes of trees of boxes are also counted cell by cell.
 *
 * Prints the seeds that failed; the exit code is their number. -p prints the trees of one seed as a program in the
 * language, to be appended to bench/kernel/suite.vs. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernel/mesh/inspect.h"
#include "kernel/round/rounding.h"
#include "tests/oracle/sx.h"
#include "tests/tools/crossings.h"

enum { ROOM = 1 << 16, CELLS = 10, FEW = 100 };

static uint64_t state;
static uint32_t any(uint32_t n) { /* returns a random integer of 0 .. n-1 */
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (uint32_t)((state >> 20) % n);
}

typedef struct { char at[ROOM]; size_t count; } program;
static void say(program *t, const char *format, ...) {
  va_list rest;
  va_start(rest, format);
  int n = vsnprintf(t->at + t->count, ROOM - t->count, format, rest);
  va_end(rest);
  t->count += n > 0 && (size_t)n < ROOM - t->count ? (size_t)n : 0;
}

/* The kinds of seed. CELL: boxes on the cells of a grid. TURNED: such boxes, all rotated by one angle. SPELT: boxes
 * rotated by equal angles that are written differently. WHOLE: shapes with integer coordinates. FREE: shapes with any
 * coordinates. */
typedef enum { CELL, TURNED, SPELT, WHOLE, FREE, KINDS } seed_kind;


typedef struct { uint8_t in[CELLS][CELLS][CELLS]; } cells;

static double place(seed_kind k) { return k == FREE ? any(8000) / 1000.0 : any(8); }

static void add_leaf(program *t, seed_kind k, cells *c) {
  if (k <= SPELT) {
    uint32_t at[3], size[3];
    char box[100];
    for (int i = 0; i < 3; i++) at[i] = any(6), size[i] = 1 + any(4);
    snprintf(box, sizeof box, "(translate %u %u %u (box %u %u %u))", at[0], at[1], at[2], size[0], size[1], size[2]);
    if (k != SPELT) say(t, "%s", box);
    else switch (any(4)) {
    case 0: say(t, "(rotate 33 21 17 %s)", box); break;
    case 1: say(t, "(rotate 0 0 17 (rotate 0 21 0 (rotate 33 0 0 %s)))", box); break;
    case 2: say(t, "(rotate 393 -339 377 %s)", box); break;
    default: say(t, "(rotate 0 0 7 (rotate 0 0 10 (rotate 33 21 0 %s)))", box); break;
    }
    memset(c, 0, sizeof *c);
    for (uint32_t x = at[0]; x < at[0] + size[0]; x++)
      for (uint32_t y = at[1]; y < at[1] + size[1]; y++)
        for (uint32_t z = at[2]; z < at[2] + size[2]; z++) c->in[x][y][z] = 1;
    return;
  }
  double x = place(k), y = place(k), z = place(k);
  say(t, "(translate %g %g %g ", x, y, z);
  uint32_t turn = any(3);
  if (turn == 1) say(t, "(rotate %d %d %d ", 90 * (int)any(4), 90 * (int)any(4), 90 * (int)any(4));
  if (turn == 2) say(t, "(rotate %d %d %d ", (int)any(360), (int)any(360), (int)any(360));
  uint32_t sides = 3 + any(14);
  double r = k == FREE ? 0.5 + any(3000) / 1000.0 : 1 + any(3);
  switch (any(6)) {
  case 0: say(t, "(box %u %u %u)", 1 + any(4), 1 + any(4), 1 + any(4)); break;
  case 1: say(t, "(cbox %u %u %u)", 1 + any(4), 1 + any(4), 1 + any(4)); break;
  case 2: say(t, "(cyl %u %g %g %u)", 1 + any(5), r, r, sides); break;
  case 3: say(t, "(cyl %u %g %g %u)", 1 + any(5), r, any(2) ? 0 : r / 2, sides); break;
  case 4: say(t, "(sphere %g %u)", r, 4 + 2 * any(5)); break;
  default: say(t, "(torus %g %g %u %u)", r + 1, 0.5 + any(2) * 0.25, 4 + any(10), 3 + any(6)); break;
  }
  say(t, turn ? "))" : ")");
}

static void combine(cells *a, const cells *b, int op) {
  for (int i = 0; i < CELLS * CELLS * CELLS; i++) {
    uint8_t *x = &((uint8_t *)a->in)[i], y = ((const uint8_t *)b->in)[i];
    *x = op == 0 ? *x | y : op == 1 ? *x & !y : *x & y;
  }
}

static void add_tree(program *t, seed_kind k, int depth, cells *c) { /* adds a tree of depth 4 or less */
  static const char *const names[] = { "union", "difference", "intersection" };
  if (depth == 0 || any(5) == 0) {
    add_leaf(t, k, c);
    return;
  }
  int op = (int)any(5) * 2 / 4;
  if (op > 2) op = 0;
  uint32_t n = 2 + any(3);
  say(t, "(%s", names[op]);
  for (uint32_t i = 0; i < n; i++) {
    cells other;
    say(t, " ");
    add_tree(t, k, depth - 1, i ? &other : c);
    if (i) combine(c, &other, op);
  }
  say(t, ")");
}

static bool verbose, failed;
static uint64_t straightened, told_of; /* straightened: number of results from which the kernel removed bends. told_of:
                                        * number of these that the kernel reported to intersect themselves; it made them
                                        * again with bends */
static uint64_t results, said; /* results: number of results. said: number of results that intersect themselves after
                                * rounding to the numbers of a format, for which the writer warns */
static void complain(const char *what, const program *t, const char *detail) {
  failed = true;
  printf("  %s: %s\n    %s\n", what, detail, t->at);
}

static int edge_order(const void *a, const void *b) {
  const uint32_t *x = a, *y = b;
  return x[0] != y[0] ? (x[0] < y[0] ? -1 : 1) : x[1] < y[1] ? -1 : x[1] > y[1];
}

static bool manifold(const vs_mesh *m) { /* returns true if each directed edge, identified by the numbers of its
                                          * vertices, occurs once */
  size_t n = 3 * m->triangle_count, twice = 0;
  uint32_t(*edges)[2] = malloc((n + 1) * sizeof *edges);
  if (!edges) return false;
  for (size_t i = 0; i < n; i++) edges[i][0] = m->triangles[i / 3][i % 3], edges[i][1] = m->triangles[i / 3][(i + 1) % 3];
  qsort(edges, n, sizeof *edges, edge_order);
  for (size_t i = 1; i < n; i++) twice += edge_order(edges[i - 1], edges[i]) == 0;
  free(edges);
  return twice == 0;
}

/* Checks the result for self-intersections. A result without bends may intersect itself only if the kernel's search
 * reports it; the kernel then makes the result again with bends. A result with bends may not intersect itself in the
 * numbers of any format, after the rounding that writers use. Exception: the solid itself touches a face with a
 * corner. */
static void look_at_crossings(const char *what, const program *t, const vs_mesh *whole, bool straight) {
  static const char *const as[] = { "doubles", "12 digits", "32 bits", "32 bits without indices" };
  char detail[300];
  bool touches = false;
  results++;
  for (int numbers = VS_NUMBERS_DOUBLE; numbers <= VS_NUMBERS_LOOSE; numbers++) {
    vs_rounded settled;
    crossings_found found;
    vs_mesh own = { 0 }, *m = &own;
    bool fine = vs_mesh_copy(whole, m) && vs_mesh_round(m, (vs_numbers)numbers, NULL, &settled, NULL);
    crossings_point *at = malloc((m->vertex_count + 1) * sizeof *at);
    crossings_triangle *triangles = malloc((m->triangle_count + 1) * sizeof *triangles);
    size_t count = 0;
    for (size_t i = 0; fine && at && i < m->vertex_count; i++) {
      double x[3] = { m->vertices[i].x, m->vertices[i].y, m->vertices[i].z };
      for (int k = 0; k < 3; k++) {
        char text[40];
        snprintf(text, sizeof text, "%.12g", x[k]);
        at[i][k] = numbers >= VS_NUMBERS_SINGLE ? (double)(float)x[k] : numbers == VS_NUMBERS_DIGITS ? strtod(text, NULL) : x[k];
      }
    }
    for (size_t i = 0; fine && at && triangles && i < m->triangle_count; i++) { /* skips triangles with two equal
                                                                                 * corners after rounding, since the STL
                                                                                 * writer omits them */
      const uint32_t *v = m->triangles[i];
      bool needle = false;
      for (int k = 0; k < 3; k++) needle = needle || memcmp(at[v[k]], at[v[(k + 1) % 3]], sizeof *at) == 0;
      if (!needle) memcpy(triangles[count++], v, sizeof *triangles);
    }
    if (!fine || !at || !triangles || !crossings_find((const crossings_point *)at, m->vertex_count, (const crossings_triangle *)triangles, count, &found)) {
      complain(what, t, "out of memory");
    } else if (numbers == VS_NUMBERS_DOUBLE && crossings_sum(&found) == found.count[CROSSINGS_TOUCHING]) {
      touches = found.count[CROSSINGS_TOUCHING] > 0;
    } else if (straight && settled.met) {
      told_of++;
    } else if (numbers != VS_NUMBERS_DOUBLE && crossings_sum(&found) > (touches ? found.count[CROSSINGS_TOUCHING] : 0) && settled.met) {
      said++; /* the format's numbers cannot separate the parts of the solid, so the writer warns */
    } else if (crossings_sum(&found) > (touches ? found.count[CROSSINGS_TOUCHING] : 0)) {
      int n = snprintf(detail, sizeof detail, "meets itself as %s (%zu triangles, %zu said):", as[numbers], count, settled.met);
      for (int k = 0; k < CROSSINGS_KINDS; k++)
        if (found.count[k]) n += snprintf(detail + n, sizeof detail - (size_t)n, " %zu %s", found.count[k], crossings_names[k]);
      complain(what, t, detail);
    }
    free(at);
    free(triangles);
    vs_mesh_free(m);
  }
}

static bool in_levels; /* whether the kernel combines the leaves of the tree level by level, as it does in crowded
                        * clusters */

/* Checks the result without bends. It must be a closed manifold with the volume of the result with bends. The kernel
 * must report any self-intersection. */
static void look_straight(const char *what, const program *t, const vs_kernel_problem *problem, const vs_mesh *bent) {
  vs_mesh m = { 0 };
  vs_kernel_error e;
  vs_kernel_counts counts = { 0 };
  vs_kernel_options options = { .threads = 1, .straight = true, .counts = &counts }, three = { .threads = 3, .straight = true };
  vs_mesh by_three = { 0 };
  double v = vs_mesh_volume(bent);
  bool sure = true;
  char detail[200];
  if (!vs_kernel_evaluate(problem, &options, &m, &e)) {
    complain(what, t, e.message);
  } else if (counts.straightened) {
    straightened += counts.straightened;
    if (!vs_kernel_evaluate(problem, &three, &by_three, &e) || by_three.vertex_count != m.vertex_count || by_three.triangle_count != m.triangle_count ||
        memcmp(by_three.vertices, m.vertices, m.vertex_count * sizeof *m.vertices) != 0 || memcmp(by_three.triangles, m.triangles, m.triangle_count * sizeof *m.triangles) != 0)
      complain(what, t, "without bends three threads make something else than one");
    if (m.triangle_count + 2 * counts.straightened > bent->triangle_count || !vs_mesh_closed(&m, &sure) || !manifold(&m)) {
      snprintf(detail, sizeof detail, "without %zu bends it is no closed manifold of less triangles: %zu, not %zu", counts.straightened, m.triangle_count, bent->triangle_count);
      complain(what, t, detail);
    }
    if (fabs(vs_mesh_volume(&m) - v) > 1e-6 * fmax(1, v)) {
      snprintf(detail, sizeof detail, "without bends its volume is %.12g, not %.12g", vs_mesh_volume(&m), v);
      complain(what, t, detail);
    }
    look_at_crossings(what, t, &m, true);
  }
  vs_mesh_free(&by_three);
  vs_mesh_free(&m);
}

static double volume(const char *what, const program *t) {
  sx_problem p;
  vs_mesh m[2] = { { 0 } };
  vs_kernel_error e;
  double v = NAN;
  char detail[300];
  if (!sx_parse(t->at, &p)) {
    complain(what, t, "cannot be read");
    return NAN;
  }
  for (uint32_t i = 0; i < 2; i++) {
    vs_kernel_options options = { .threads = 1 + 2 * i, .in_levels = in_levels };
    if (!vs_kernel_evaluate(&p.problem, &options, &m[i], &e)) {
      complain(what, t, e.message);
      goto done;
    }
  }
  if (m[0].vertex_count != m[1].vertex_count || m[0].triangle_count != m[1].triangle_count ||
      (m[0].vertex_count && memcmp(m[0].vertices, m[1].vertices, m[0].vertex_count * sizeof *m[0].vertices) != 0) ||
      (m[0].triangle_count && memcmp(m[0].triangles, m[1].triangles, m[0].triangle_count * sizeof *m[0].triangles) != 0))
    complain(what, t, "three threads make something else than one");
  bool sure = true;
  if (!vs_mesh_closed(&m[0], &sure) || !manifold(&m[0])) complain(what, t, "is not a closed manifold by index");
  vs_mesh_flaws f;
  if (!vs_kernel_inspect(&m[0], NULL, &f, &e)) {
    complain(what, t, e.message);
  } else if (!vs_mesh_flawless(&f)) {
    snprintf(detail, sizeof detail, "%zu open edges, %zu faces beside space wound %d..%d times, the first at %g %g %g", f.open_count, f.wound_count, f.least, f.most,
             f.wound[0].at.x, f.wound[0].at.y, f.wound[0].at.z);
    complain(what, t, detail);
  }
  v = vs_mesh_volume(&m[0]);
  look_at_crossings(what, t, &m[0], false);
  if (!in_levels) look_straight(what, t, &p.problem, &m[0]);
done:
  vs_mesh_free(&m[0]);
  vs_mesh_free(&m[1]);
  sx_free(&p);
  return v;
}

static void expect(const char *what, const program *t, double a, double b, double scale) {
  char detail[200];
  if (fabs(a - b) <= scale) return;
  snprintf(detail, sizeof detail, "volume %.12g, but %.12g", a, b);
  complain(what, t, detail);
}

static void sow(uint64_t seed) {
  state = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du;
  for (int i = 0; i < 8; i++) any(2);
}

static double count_of(const cells *c) {
  double count = 0;
  for (int i = 0; i < CELLS * CELLS * CELLS; i++) count += ((const uint8_t *)c->in)[i];
  return count;
}

static void one(uint64_t seed) {
  static program a, b, t; /* static variables: a test program may have them, the library not */
  static cells ca, cb;
  sow(seed);
  seed_kind k = (seed_kind)any(KINDS);
  in_levels = seed % 4 == 3;
  a.count = b.count = 0;
  add_tree(&a, k, 1 + (int)any(3), &ca);
  add_tree(&b, k, 1 + (int)any(2), &cb);
  const char *open = k == TURNED ? "(rotate 33 21 17 " : "(union ";
  if (verbose) printf("%s\n%s\n", a.at, b.at);
#define V(name, ...) (t.count = 0, say(&t, "%s", open), say(&t, __VA_ARGS__), say(&t, ")"), volume(name, &t))
  double va = V("a", "%s", a.at), vb = V("b", "%s", b.at), both = V("a u b", "(union %s %s)", a.at, b.at);
  double tolerance = (k == CELL ? 1e-9 : 1e-6) * fmax(1, va + vb);
  if (k <= SPELT) {
    expect("a", &a, va, count_of(&ca), tolerance);
    combine(&ca, &cb, 0);
    expect("a u b", &t, both, count_of(&ca), tolerance);
  }
  double common = V("a n b", "(intersection %s %s)", a.at, b.at);
  expect("|a u b| = |a| + |b| - |a n b|", &t, both, va + vb - common, tolerance);
  double less = V("a - b", "(difference %s %s)", a.at, b.at);
  expect("|a - b| = |a| - |a n b|", &t, less, va - common, tolerance);
  double again = V("a - (a - b)", "(difference %s (difference %s %s))", a.at, a.at, b.at);
  expect("a - (a - b) = a n b", &t, again, common, tolerance);
  expect("a - a", &a, V("a - a", "(difference %s %s)", a.at, a.at), 0, tolerance);
  expect("a u a", &a, V("a u a", "(union %s %s)", a.at, a.at), va, tolerance);
  const char *world = "(translate -20 -20 -20 (box 50 50 50))";
  double outside = V("not a n not b", "(intersection (difference %s %s) (difference %s %s))", world, a.at, world, b.at);
  expect("De Morgan", &t, outside, 125000 - both, 1e-6 * 125000);
#undef V
}

#ifndef FUZZ_AS_A_TEST
/* Prints the program of the seed. For a program on cells, the first line contains also the volume and its tolerance,
 * and a wrong volume is reported. */
static int print(const char *name, uint64_t seed) {
  static const char *const names[] = { [CELL] = "cell", [TURNED] = "turned", [SPELT] = "spelt" };
  static program t; /* static variables: a test program may have them, the library not */
  static cells c;
  int k = CELL;
  while (k <= SPELT && strcmp(names[k], name) != 0) k++;
  if (k > SPELT) return fprintf(stderr, "fuzz: there is no kind %s\n", name), 2;
  sow(seed);
  do {
    t.count = 0;
    add_tree(&t, (seed_kind)k, 4, &c);
  } while (count_of(&c) == 0); /* tries again, because an empty result cannot be written */
  double right = k == CELL ? 1e-9 : 1e-6;
  printf("; volume %g within %g\n(define o %s%s%s)\n", count_of(&c), right, k == TURNED ? "(rotate 33 21 17 " : "", t.at, k == TURNED ? ")" : "");
  printf("(unless (<= (abs (- (volume o) %g)) %g) (printf \"volume ~a\\n\" (volume o)))\n(draw o)\n", count_of(&c), right * count_of(&c));
  return 0;
}

int main(int argc, char **argv) {
  uint64_t first = 1, count = 100, bad = 0;
  if (argc == 4 && !strcmp(argv[1], "-p")) return print(argv[2], strtoull(argv[3], NULL, 10));
  for (int i = 1; i < argc; i++) {
    if (!strcmp(argv[i], "-v")) verbose = true;
    else if (!strcmp(argv[i], "-s") && i + 1 < argc) first = strtoull(argv[++i], NULL, 10);
    else count = strtoull(argv[i], NULL, 10);
  }
  for (uint64_t seed = first; seed < first + count; seed++) {
    failed = false;
    one(seed);
    if (failed) {
      printf("seed %llu failed\n", (unsigned long long)seed);
      fflush(stdout);
      bad++;
    }
  }
  printf("%llu times one of %llu results meets itself in a format's numbers, and says so\n", (unsigned long long)said, (unsigned long long)results);
  printf("%llu bends were left out; %llu times that was told to meet itself\n", (unsigned long long)straightened, (unsigned long long)told_of);
  printf("%llu of %llu seeds failed\n", (unsigned long long)bad, (unsigned long long)count);
  return bad != 0 || said * FEW > results;
}
#endif
