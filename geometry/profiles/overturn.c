/* Repairs the steps of a sweep in which a bend of the path is tighter than the profile is wide.
 *
 * In such a step, the inner side of the profile goes backwards from one section to the next. The walls of this part
 * then wind around its volume in the wrong direction: the winding number is -1. A sweep is the union of all places that
 * the profile passes through. Therefore the profile is cut into triangles. Between two sections, each triangle sweeps a
 * prism, which is cut into three tetrahedra. The tetrahedra fill the step without a gap, and neighbours have equal
 * faces. The walls are the border of all tetrahedra, each counted with its sign. A backwards tetrahedron counts -1. If
 * its border is added twice, facing outwards, it counts 1. solids/overlaps.c keeps the volume with winding numbers
 * above 0, which is the union of the tetrahedra. Faces between two backwards tetrahedra cancel, so only the fold and a
 * part of the walls remain.
 *
 * Let a < b < c be the numbers of a triangle's points. The walls of its prism are cut from the lower number in the
 * first section to the higher number in the second. Therefore two prisms cut their common wall in the same way. */
#include "geometry/profiles/overturn.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/profiles/grid.h"
#include "model/net.h"
#include "model/store/array.h"

static vs_vec3 way_of(const vs_swept *s, size_t step) { /* returns the direction of a step, from one section to the
                                                         * next: the sum of the sections' normals; an apex has no
                                                         * normal */
  const vs_section *p = &s->sections[step], *q = &s->sections[(step + 1) % s->section_count];
  return vs_v3_unit(vs_v3_add(vs_v3_unit(vs_v3_cross(p->x, p->y)), vs_v3_unit(vs_v3_cross(q->x, q->y))));
}

bool vs_overturns(const vs_swept *s, const vs_vec3 *at, size_t step, double size) {
  size_t n = s->profile_count;
  vs_vec3 way = way_of(s, step);
  for (size_t i = 0; i < n; i++)
    if (vs_v3_dot(vs_v3_sub(at[(step + 1) * n + i], at[step * n + i]), way) < -1e-7 * size)
      return true; /* a point that goes backwards by less than this does so only because of rounding errors */
  return false;
}

/* Returns the difference between the greatest and the least distance by which points of the profile go forwards in a
 * step, from one section to the next. Returns 0 if no point goes backwards by more than a quarter of the tolerance. */
static double rises_differ(const vs_swept *s, size_t step, double tolerance) {
  const vs_section *a = &s->sections[step], *b = &s->sections[(step + 1) % s->section_count];
  vs_vec3 way = way_of(s, step);
  double x = vs_v3_dot(vs_v3_sub(b->x, a->x), way), y = vs_v3_dot(vs_v3_sub(b->y, a->y), way),
         at = vs_v3_dot(vs_v3_sub(b->at, a->at), way), least = INFINITY, most = -INFINITY;
  for (size_t i = 0; i < s->profile_count; i++) {
    double rise = x * s->profile[i].x + y * s->profile[i].y + at;
    least = fmin(least, rise);
    most = fmax(most, rise);
  }
  return least < -tolerance / 4 && most > 0 ? most - least : 0;
}

/* Returns the factor, at most 1, by which the profile must be scaled down so that no point goes backwards in this
 * step. */
static double fits_in(const vs_swept *s, size_t step) {
  const vs_section *a = &s->sections[step], *b = &s->sections[(step + 1) % s->section_count];
  vs_vec3 way = way_of(s, step);
  double x = vs_v3_dot(vs_v3_sub(b->x, a->x), way), y = vs_v3_dot(vs_v3_sub(b->y, a->y), way),
         middle = x * s->base.x + y * s->base.y + vs_v3_dot(vs_v3_sub(b->at, a->at), way), fits = 1;
  for (size_t i = 0; i < s->profile_count; i++) {
    double less = -(x * (s->profile[i].x - s->base.x) + y * (s->profile[i].y - s->base.y));
    if (less > middle) fits = fmin(fits, fmax(middle, 0) / less);
  }
  return fits;
}

void vs_overturn_tightest(const vs_swept *s, const vs_vec3 *near, vs_vec3 *at, double *fits) {
  double least = INFINITY;
  for (size_t r = 0; s->across && r + !s->joined < s->section_count; r++) {
    const vs_section *p = &s->sections[r];
    double fit = p->ends ? 1 : fits_in(s, r);
    vs_vec3 place = vs_v3_add(vs_v3_add(vs_v3_scale(p->x, s->base.x), vs_v3_scale(p->y, s->base.y)), p->at);
    double score = near ? vs_v3_length(vs_v3_sub(place, *near)) : fit;
    if (!(fit < 1) || !(score < least)) continue;
    least = score;
    *at = place;
    *fits = fit;
  }
}

/* MOST: greatest number of parts into which a step is divided. HALVES: greatest number of halvings of a step at an end
 * of the sweep or at a corner, where no other step covers a tetrahedron that extends beyond its step. */
enum { MOST = 64, HALVES = 16 };
typedef struct { double at[MOST + 2 * HALVES]; size_t count; } parts;

static parts parts_of(double differ, double tolerance, bool begins, bool ends) {
  enum { SHOWS = 256 }; /* SHOWS: factor by which the deviation of tetrahedra may exceed the tolerance. Most of the
                         * deviation lies inside the union of the tetrahedra; measurements at its surface found a
                         * thirty-second of it. */
  parts p = { .count = 0 };
  double n = fmax(1, fmin(MOST, ceil(differ / (SHOWS * tolerance)))), halves = ceil(log2(differ / n / (4 * tolerance)));
  int fine = halves > 0 ? (int)fmin(HALVES, halves) : 0;
  p.at[p.count++] = 0;
  for (int i = fine; begins && i > 0; i--) p.at[p.count++] = ldexp(1 / n, -i);
  for (double k = 1; k < n; k++) p.at[p.count++] = k / n;
  for (int i = 1; ends && i <= fine; i++) p.at[p.count++] = 1 - ldexp(1 / n, -i);
  return p;
}

/* Returns true if this step begins at an end of the sweep, or if the sweep turns there more sharply than on a smooth
 * path. */
static bool turns_sharply(const vs_swept *s, size_t step) {
  size_t rows = s->section_count, before = (step + rows - 1) % rows;
  if (!s->joined && (step == 0 || step + 1 == rows)) return true;
  return s->sections[before].ends || s->sections[step].ends || vs_v3_dot(way_of(s, before), way_of(s, step)) < 0.95;
}

/* Divides each step of the sweep: step r at the fractions in divided[r]. */
static bool divide(vs_swept *s, const parts *divided) {
  vs_section *fine = NULL;
  size_t count = 0, room = 0;
  bool ok = true;
  for (size_t r = 0; ok && r < s->section_count; r++) {
    const vs_section *from = &s->sections[r], *to = &s->sections[(r + 1) % s->section_count];
    ok = VS_GROW(fine, room, count + divided[r].count);
    if (ok) fine[count++] = *from;
    for (size_t k = 1; ok && k < divided[r].count; k++)
      fine[count++] = vs_section_between(from, to, divided[r].at[k]);
  }
  if (!ok) return free(fine), false;
  free(s->sections);
  s->sections = fine;
  s->section_count = count;
  s->section_room = room;
  free(s->stride); /* the steps are no longer equal, so no point can skip sections regularly */
  s->stride = NULL;
  return true;
}

static bool goes_on(const vs_swept *s, size_t step) { /* returns true if a step follows the section number `step`, that
                                                       * is, if no piece of the sweep ends there */
  return !s->sections[step].ends && (s->joined || step + 1 < s->section_count);
}

bool vs_overturn_refine(vs_swept *s, const bool *marked, double tolerance) {
  size_t rows = s->section_count;
  parts *divided = vs_fresh(rows, sizeof *divided);
  bool ok = divided != NULL, cut = false;
  for (size_t r = 0; ok && r < rows; r++) {
    double differ = (!marked || marked[r]) && goes_on(s, r) ? rises_differ(s, r, tolerance) : 0;
    divided[r].count = 1;
    if (differ > 0) divided[r] = parts_of(differ, tolerance, turns_sharply(s, r), turns_sharply(s, (r + 1) % rows));
    cut = cut || divided[r].count > 1;
  }
  ok = ok && (!cut || divide(s, divided));
  free(divided);
  return ok;
}

/* ---- tetrahedra ---- */

static double six_volumes(const vs_mesh *m, const uint32_t t[4]) {
  const vs_vec3 *v = m->vertices;
  vs_vec3 a = vs_v3_sub(v[t[1]], v[t[0]]), b = vs_v3_sub(v[t[2]], v[t[0]]), c = vs_v3_sub(v[t[3]], v[t[0]]);
  return vs_v3_dot(vs_v3_cross(a, b), c);
}

/* The corners of the three tetrahedra that fill a prism. 0 to 2: corners of the prism's triangle (cell) in the first
 * section; 3 to 5: the same corners in the second section. */
static const uint8_t corner[3][4] = { { 0, 1, 2, 5 }, { 0, 1, 5, 4 }, { 0, 3, 4, 5 } };

/* Sorts the three numbers of c. Returns 1 if their orientation is unchanged, -1 if it is reversed by the sorting. */
static int sort_cell(uint32_t c[3]) {
  int even = 1;
  for (int i = 0; i < 3; i++) {
    int j = i % 2;
    if (c[j] <= c[j + 1]) continue;
    uint32_t swap = c[j];
    c[j] = c[j + 1];
    c[j + 1] = swap;
    even = -even;
  }
  return even;
}

/* Appends the faces of those tetrahedra of a prism that have a negative volume, twice and facing outwards. `low`,
 * `high`: vertices of the two sections; `cell`: the prism's triangle; `hand`: 1, or -1 if this triangle is clockwise in
 * its section. Returns false when memory is out. */
static bool add_prism(vs_mesh *m, const uint32_t *low, const uint32_t *high, const uint32_t cell[3], int hand) {
  uint32_t c[3] = { cell[0], cell[1], cell[2] };
  int even = sort_cell(c);
  bool ok = true;
  for (int i = 0; ok && i < 3; i++) {
    uint32_t t[4];
    for (int j = 0; j < 4; j++) t[j] = corner[i][j] < 3 ? low[c[corner[i][j]]] : high[c[corner[i][j] - 3]];
    if (!(six_volumes(m, t) * even * hand < 0)) continue;
    uint32_t p = t[0], q = t[even > 0 ? 1 : 2], r = t[even > 0 ? 2 : 1], s = t[3]; /* the corners of the tetrahedron,
                                                                                    * ordered so that its faces are
                                                                                    * reversed */
    for (int times = 0; ok && times < 2; times++)
      ok = vs_mesh_add_triangle(m, p, q, r) && vs_mesh_add_triangle(m, p, s, q) && vs_mesh_add_triangle(m, q, s, r) &&
           vs_mesh_add_triangle(m, p, r, s);
  }
  return ok;
}

/* Divides the profile into triangles. The corners of a triangle are indices of the profile's points. Returns false when
 * memory is out. */
static bool make_cells(const vs_swept *s, vs_mesh *cells) {
  uint32_t *row = vs_fresh(s->profile_count, sizeof *row);
  bool ok = row != NULL;
  for (size_t i = 0; ok && i < s->profile_count; i++) row[i] = (uint32_t)i;
  ok = ok && vs_grid_cap(&(vs_cap_loops){ s->profile, s->sizes, s->hole, s->loop_count }, row, cells, false);
  free(row);
  return ok;
}

static int hand_of(const vs_swept *s, const uint32_t cell[3]) { /* returns 1, or -1 if the triangle is clockwise, which
                                                                 * occurs if the profile crosses itself */
  const vs_vec2 *a = &s->profile[cell[0]], *b = &s->profile[cell[1]], *c = &s->profile[cell[2]];
  return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x) < 0 ? -1 : 1;
}

bool vs_overturn_fill(const vs_overturn_rows *rows, size_t first, vs_mesh *out) {
  size_t n = rows->s->profile_count;
  vs_mesh cells = { 0 };
  bool ok = make_cells(rows->s, &cells);
  if (rows->inside_out) vs_mesh_turn(out, first);
  for (size_t r = 0; ok && r < rows->steps; r++) {
    const uint32_t *low = rows->numbers + r * n;
    for (size_t c = 0; ok && rows->turns[r] && c < cells.triangle_count; c++) {
      int hand = hand_of(rows->s, cells.triangles[c]);
      ok = add_prism(out, low, low + n, cells.triangles[c], rows->inside_out ? -hand : hand);
    }
  }
  if (rows->inside_out) vs_mesh_turn(out, first);
  ok = ok && vs_mesh_net(out, first);
  vs_mesh_free(&cells);
  return ok;
}

/* ---- chance points ---- */

/* State of the choice of random points in tetrahedra. `chance`: state of the generator (SplitMix64: Steele, Lea, Flood,
 * 2014). `passed`: volume of the tetrahedra so far. `next`: volume at which the next point is chosen. `every`: volume
 * between two points; if it is 0, only `passed` is computed. */
typedef struct {
  uint64_t chance;
  double passed, next, every;
  size_t step; /* number of the step to which the next prisms belong */
  vs_step_point *out;
  size_t most, count;
} sampling;

static double chance(sampling *s) { /* returns a random number, evenly distributed between 0 and 1 */
  uint64_t z = s->chance += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* Returns a random point of the tetrahedron t, evenly distributed: three random cuts divide an interval into four
 * parts, which are the weights of the corners. */
static vs_vec3 point_within(sampling *s, const vs_vec3 t[4]) {
  double cut[5] = { 0, chance(s), chance(s), chance(s), 1 };
  for (int i = 0; i < 3; i++) {
    int j = 1 + i % 2;
    double low = fmin(cut[j], cut[j + 1]);
    cut[j + 1] = fmax(cut[j], cut[j + 1]);
    cut[j] = low;
  }
  vs_vec3 p = { 0, 0, 0 };
  for (int i = 0; i < 4; i++) p = vs_v3_add(p, vs_v3_scale(t[i], cut[i + 1] - cut[i]));
  return p;
}

static void sample_prism(sampling *s, const vs_vec3 *low, const vs_vec3 *high, const uint32_t cell[3]) {
  uint32_t c[3] = { cell[0], cell[1], cell[2] };
  sort_cell(c);
  for (int i = 0; i < 3; i++) {
    vs_vec3 t[4];
    for (int j = 0; j < 4; j++) t[j] = corner[i][j] < 3 ? low[c[corner[i][j]]] : high[c[corner[i][j] - 3]];
    s->passed += fabs(vs_v3_dot(vs_v3_cross(vs_v3_sub(t[1], t[0]), vs_v3_sub(t[2], t[0])), vs_v3_sub(t[3], t[0])));
    for (; s->every > 0 && s->next < s->passed && s->count < s->most; s->next += s->every)
      s->out[s->count++] = (vs_step_point){ point_within(s, t), s->step };
  }
}

bool vs_overturn_samples(const vs_overturn_steps *steps, vs_step_point *out, size_t most, size_t *count) {
  size_t n = steps->s->profile_count;
  vs_mesh cells = { 0 };
  sampling s = { .out = out, .most = most };
  bool ok = make_cells(steps->s, &cells);
  for (int pass = 0; ok && pass < 2; pass++) { /* the first pass computes the total volume, the second pass chooses the
                                                * points */
    s.every = s.passed / (double)(most ? most : 1);
    s.next = s.every / 2;
    s.passed = 0;
    for (s.step = 0; s.step < steps->s->section_count; s.step++)
      for (size_t c = 0; steps->turns[s.step] && c < cells.triangle_count; c++)
        sample_prism(&s, steps->at + s.step * n, steps->at + (s.step + 1) * n, cells.triangles[c]);
  }
  vs_mesh_free(&cells);
  *count = s.count;
  return ok;
}
