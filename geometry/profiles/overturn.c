/* Owns the steps of a sweep in which a bend is tighter than its profile.
 *
 * There the inner side of the profile goes backwards from one section to the next, and walls of the whole profile would
 * wind around what it passes through the wrong way: -1 where it should count. A sweep is the union of all that the
 * profile passes through. Therefore the profile is cut along the line that stands still: the part that goes forwards
 * makes one solid, that which goes backwards another, turned inside out, as long as the line leaves the same corners on
 * either side. They may overlap; solids/primitive_meshes.c unites them. At their ends they reach a little past their
 * section, so that they overlap what follows: between solids that only touched, rounding would leave cracks.
 *
 * Sections are affine maps, so how far a point of the profile advances is affine over the profile, and what stands
 * still is a line. A profile that is not convex is cut into triangles first, each for itself. */
#include "geometry/profiles/overturn.h"

#include <stdlib.h>

typedef struct {
  const vs_swept *s;
  const vs_vec3 *at;   /* the points of the sections, one after the other */
  size_t from, to;     /* the first and the last section of the steps */
  double size;
  double *rise;        /* of each step, of each point of the profile: the way it goes forwards */
  vs_mesh *out;
} turning;

static double rise_of(const turning *t, size_t step, size_t point) {
  return t->rise[(step - t->from) * t->s->profile_count + point];
}
static bool forwards(const turning *t, size_t step, size_t point) { return rise_of(t, step, point) > -1e-9 * t->size; }

static vs_vec3 way_of(const turning *t, size_t step) { /* an apex has no normal: the other's then */
  const vs_section *p = &t->s->sections[step], *q = &t->s->sections[(step + 1) % t->s->section_count];
  return vs_v3_unit(vs_v3_add(vs_v3_unit(vs_v3_cross(p->x, p->y)), vs_v3_unit(vs_v3_cross(q->x, q->y))));
}

/* Where in section r the line crosses the side from point i to point j: the mean of the steps before and after it in
 * which it does, the same for all cells that have this side. */
static double crossing(const turning *t, size_t r, size_t i, size_t j) {
  double sum = 0, count = 0;
  for (size_t step = r > t->from ? r - 1 : r; step <= r && step < t->to; step++) {
    if (forwards(t, step, i) == forwards(t, step, j)) continue;
    double p = rise_of(t, step, i), q = rise_of(t, step, j), at = p / (p - q);
    sum += at > 0 ? fmin(at, 1) : 0, count++;
  }
  return count > 0 ? sum / count : 0;
}

/* a point of the profile, or where the line crosses a side, from the lower number to the higher */
typedef struct { size_t i, j; bool cut; } corner;

static vs_vec3 corner_at(const turning *t, size_t r, const corner *c) {
  const vs_vec3 *row = t->at + r * t->s->profile_count;
  if (!c->cut) return row[c->i];
  double k = crossing(t, r, c->i, c->j);
  return vs_v3_add(vs_v3_scale(row[c->i], 1 - k), vs_v3_scale(row[c->j], k));
}

/* Parts that share a side have the same triangles there: which way a side is cut depends on its corners alone. */
static bool before(const corner *p, const corner *q) {
  return p->i < q->i || (p->i == q->i && !p->cut && q->cut) || (p->i == q->i && p->cut == q->cut && p->j < q->j);
}

/* The solid that these corners pass through from section a to section b */
static bool add_part(turning *t, const corner *c, size_t n, size_t a, size_t b, bool forth) {
  uint32_t first = (uint32_t)t->out->vertex_count, m = (uint32_t)n, last = first + m * (uint32_t)(b - a);
  size_t triangle = t->out->triangle_count;
  double past = forth ? 4e-7 * t->size : -4e-7 * t->size;
  bool ok = true;
  for (size_t r = a; ok && r <= b; r++)
    for (size_t i = 0; ok && i < n; i++) {
      vs_vec3 p = corner_at(t, r, &c[i]);
      if (r == a) p = vs_v3_sub(p, vs_v3_scale(way_of(t, a), past));
      if (r == b) p = vs_v3_add(p, vs_v3_scale(way_of(t, b - 1), past));
      ok = vs_mesh_add_vertex(t->out, p, NULL);
    }
  for (uint32_t i = 2; ok && i < m; i++)
    ok = vs_mesh_add_triangle(t->out, first, first + i, first + i - 1) &&
         vs_mesh_add_triangle(t->out, last, last + i - 1, last + i);
  for (uint32_t low = first; ok && low < last; low += m)
    for (uint32_t i = 0; ok && i < m; i++) {
      uint32_t j = (i + 1) % m, p = low + i, q = low + j;
      ok = before(&c[i], &c[j])
               ? vs_mesh_add_triangle(t->out, p, q, q + m) && vs_mesh_add_triangle(t->out, p, q + m, p + m)
               : vs_mesh_add_triangle(t->out, p, q, p + m) && vs_mesh_add_triangle(t->out, p + m, q, q + m);
    }
  if (ok && !forth) vs_mesh_turn(t->out, triangle);
  return ok;
}

/* A convex cell of the profile, over steps a to b that leave the same corners on the same sides; room for count + 2
 * corners */
static bool add_cell(turning *t, const uint32_t *cell, size_t count, size_t a, size_t b, corner *room) {
  bool ok = true;
  for (int forth = 1; ok && forth >= 0; forth--) {
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
      size_t p = cell ? cell[i] : i, q = cell ? cell[(i + 1) % count] : (i + 1) % count;
      bool here = forwards(t, a, p) == forth;
      if (here) room[n++] = (corner){ p, p, false };
      if (here != (forwards(t, a, q) == forth)) room[n++] = (corner){ p < q ? p : q, p < q ? q : p, true };
    }
    if (n >= 3) ok = add_part(t, room, n, a, b, forth);
  }
  return ok;
}

static bool is_convex(const vs_vec2 *p, size_t n) { /* counter-clockwise, one turn */
  double turned = 0;
  for (size_t i = 0; i < n; i++) {
    vs_vec2 a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
    double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y, cross = ux * vy - uy * vx;
    if (cross < 0) return false;
    turned += atan2(cross, ux * vx + uy * vy);
  }
  return turned < 7; /* a star of two turns is not */
}

/* The profile as convex cells: triangles, or nothing where it is one convex loop */
static bool make_cells(const vs_swept *s, vs_mesh *cells) {
  if (s->loop_count == 1 && is_convex(s->profile, s->profile_count)) return true;
  uint32_t *row = malloc(s->profile_count * sizeof *row);
  bool ok = row != NULL;
  for (size_t i = 0; ok && i < s->profile_count; i++) row[i] = (uint32_t)i;
  for (size_t l = 0, first = 0; ok && l < s->loop_count;) {
    size_t end = l + 1, points = s->sizes[l];
    while (end < s->loop_count && s->hole[end]) points += s->sizes[end++];
    ok = vs_triangulate(s->profile + first, s->sizes + l, end - l, cells, row + first, false);
    first += points;
    l = end;
  }
  free(row);
  return ok;
}

bool vs_overturns(const vs_swept *s, const vs_vec3 *at, size_t step, double size) {
  size_t n = s->profile_count;
  turning t = { .s = s };
  vs_vec3 way = way_of(&t, step);
  for (size_t i = 0; i < n; i++)
    if (vs_v3_dot(vs_v3_sub(at[(step + 1) * n + i], at[step * n + i]), way) < -1e-7 * size)
      return true; /* less is what rounding makes */
  return false;
}

bool vs_overturn_mesh(const vs_swept *s, const vs_vec3 *at, size_t from, size_t to, double size, vs_mesh *out) {
  size_t n = s->profile_count;
  turning t = { s, at, from, to, size, malloc((to - from) * n * sizeof *t.rise), out };
  corner *room = malloc((n + 4) * sizeof *room);
  vs_mesh cells = { 0 };
  bool ok = t.rise && room && make_cells(s, &cells);
  for (size_t step = from; ok && step < to; step++) {
    vs_vec3 way = way_of(&t, step);
    for (size_t i = 0; i < n; i++)
      t.rise[(step - from) * n + i] = vs_v3_dot(vs_v3_sub(at[(step + 1) * n + i], at[step * n + i]), way);
  }
  size_t count = cells.triangle_count ? cells.triangle_count : 1, corners = cells.triangle_count ? 3 : n;
  for (size_t c = 0; ok && c < count; c++) {
    const uint32_t *cell = cells.triangle_count ? cells.triangles[c] : NULL;
    for (size_t a = from, b; ok && a < to; a = b) {
      bool same = true;
      for (b = a + 1; same && b < to; b++) {
        for (size_t i = 0; same && i < corners; i++)
          same = forwards(&t, a, cell ? cell[i] : i) == forwards(&t, b, cell ? cell[i] : i);
        if (!same) break;
      }
      ok = add_cell(&t, cell, corners, a, b, room);
    }
  }
  vs_mesh_free(&cells);
  free(t.rise);
  free(room);
  return ok;
}
