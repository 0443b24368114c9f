/* Makes the triangles between the sections of a sweep, an extrusion or a pipe. */
#include "geometry/profiles/swept_mesh.h"

#include <stdlib.h>

#include "geometry/profiles/grid.h"
#include "geometry/profiles/overturn.h"
#include "model/store/array.h"

/* Points of a sweep's sections. `at`: the points of all sections, one section after another, and then those of the
 * first section again. `turns[i]`: true if a part of the profile goes backwards from section i to the next. `numbers`:
 * memory for the vertex of each point. */
typedef struct {
  vs_vec3 *at;
  bool *turns;
  uint32_t *numbers;
} laid;

static void laid_free(laid *l) {
  free(l->at);
  free(l->turns);
  free(l->numbers);
}

static bool lay(const vs_swept *s, laid *l) {
  size_t n = s->profile_count, rows = s->section_count, room = n * (rows + 1) + 1;
  *l = (laid){ .at = vs_fresh(room, sizeof *l->at),
               .turns = vs_zeros(rows + 1, sizeof *l->turns),
               .numbers = vs_fresh(room, sizeof *l->numbers) };
  if (!l->at || !l->turns || !l->numbers) return false;
  vs_vec3 *at = l->at;
  vs_bounds b = vs_bounds_empty();
  for (size_t r = 0; r <= rows; r++) {
    const vs_section *section = &s->sections[r < rows ? r : 0];
    for (size_t i = 0; i < n; i++)
      *at++ = vs_v3_add(
          vs_v3_add(vs_v3_scale(section->x, s->profile[i].x), vs_v3_scale(section->y, s->profile[i].y)), section->at);
  }
  for (size_t i = 0; i < n * rows; i++) vs_bounds_add(&b, l->at[i]);
  double size = vs_bounds_diagonal(&b);
  for (size_t r = 0; s->across && s->filled && r + !s->joined < rows; r++)
    l->turns[r] = !s->sections[r].ends && vs_overturns(s, l->at, r, size);
  return true;
}

/* Returns the grid of `rows` sections, beginning with section `first`: a piece of the sweep, some of its steps, or all
 * of it. */
static vs_quad_grid grid_of(const vs_swept *s, const laid *l, size_t first, size_t rows) {
  return (vs_quad_grid){ .at = l->at + first * s->profile_count, .rows = rows, .columns = s->profile_count,
                         .sizes = s->sizes, .hole = s->hole, .loop_count = s->loop_count, .round = s->filled,
                         .capped = s->filled, .shared = true, .flat = s->profile, .by_number = l->turns + first,
                         .numbers = l->numbers };
}

static bool mesh_of(const vs_swept *s, const vs_quad_grid *g, bool may_be_inside_out, vs_mesh *out) {
  size_t first = out->triangle_count, steps = g->rows - !g->joined;
  if (steps < 1) return true;
  bool back = false;
  for (size_t r = 0; r < steps; r++) back = back || g->by_number[r];
  if (!vs_grid_mesh(g, out)) return false;
  bool inside_out = may_be_inside_out && s->filled && vs_mesh_turn_outwards(out, first);
  return !back || vs_overturn_fill(&(vs_overturn_rows){ s, g->numbers, g->by_number, steps, inside_out }, first, out);
}

/* Returns the index of the last section of the piece that begins with section `first`. A sweep may consist of pieces
 * that no walls connect. */
static size_t piece_end(const vs_swept *s, size_t first) {
  size_t end = first;
  while (end + 1 < s->section_count && !s->sections[end].ends) end++;
  return end;
}

/* ---- strips: the wall of each edge by itself, for points with different strides ---- */

/* A column of the wall: the point of the profile with this index. */
typedef struct { const vs_swept *s; const laid *l; size_t point; } column;

/* Returns the vertex of the column's point in row r. r is a multiple of the stride, the distance between rows in which
 * the point has a vertex. */
static uint32_t vertex_of(const column *c, size_t r) {
  return c->l->numbers[r % c->s->section_count * c->s->profile_count + c->point];
}

static bool add_facet(vs_mesh *out, bool turned, const uint32_t v[3]) {
  return vs_mesh_add_triangle(out, v[0], v[turned ? 2 : 1], v[turned ? 1 : 2]);
}

/* Adds the triangles between the columns p and q, from row r to row r + S. S is the stride of p, the distance between
 * rows in which p has a vertex; that of q is equal or smaller. turned: true if p follows q in the profile. */
static bool strip_block(const column *p, const column *q, size_t r, bool turned, vs_mesh *out) {
  size_t coarse = p->s->stride[p->point], fine = q->s->stride[q->point], middle = r + coarse / fine / 2 * fine;
  uint32_t low = vertex_of(p, r), high = vertex_of(p, r + coarse);
  bool ok = true;
  if (coarse == fine) {
    uint32_t a = vertex_of(q, r), b = vertex_of(q, r + coarse);
    const vs_vec3 *v = out->vertices;
    return vs_grid_cut(v[low], v[a], v[high], v[b]) ? add_facet(out, turned, (uint32_t[]){ low, a, high }) &&
                                                          add_facet(out, turned, (uint32_t[]){ a, b, high })
                                                    : add_facet(out, turned, (uint32_t[]){ low, a, b }) &&
                                                          add_facet(out, turned, (uint32_t[]){ low, b, high });
  }
  for (size_t at = r; ok && at < r + coarse; at += fine) {
    uint32_t tip = at < middle ? low : high;
    if (at == middle) ok = add_facet(out, turned, (uint32_t[]){ low, vertex_of(q, middle), high });
    ok = ok && add_facet(out, turned, (uint32_t[]){ tip, vertex_of(q, at), vertex_of(q, at + fine) });
  }
  return ok;
}

static bool strip(const vs_swept *s, const laid *l, size_t i, size_t j, vs_mesh *out) {
  column p = { s, l, i }, q = { s, l, j };
  bool turned = s->stride[i] < s->stride[j], ok = true;
  size_t stride = s->stride[turned ? j : i], rows = s->section_count - !s->joined;
  for (size_t r = 0; ok && r < rows; r += stride) ok = strip_block(turned ? &q : &p, turned ? &p : &q, r, turned, out);
  return ok;
}

static bool mesh_of_strips(const vs_swept *s, const laid *l, vs_mesh *out) {
  size_t n = s->profile_count, rows = s->section_count, before = out->triangle_count;
  VS_ASSERT(!s->seam && rows > 1);
  bool ok = true;
  for (size_t i = 0; i < n; i++)
    for (size_t r = 0; ok && r < rows; r += s->stride[i])
      ok = vs_mesh_add_vertex(out, l->at[r * n + i], &l->numbers[r * n + i]);
  for (size_t k = 0, first = 0; ok && k < s->loop_count; first += s->sizes[k], k++)
    for (size_t i = 0; ok && i + !s->filled < s->sizes[k]; i++)
      ok = strip(s, l, first + i, first + (i + 1) % s->sizes[k], out);
  vs_cap_loops loops = { s->profile, s->sizes, s->hole, s->loop_count };
  if (s->filled && !s->joined)
    ok = ok && vs_grid_cap(&loops, l->numbers, out, true) &&
         vs_grid_cap(&loops, l->numbers + (rows - 1) * n, out, false);
  if (ok && s->filled) vs_mesh_turn_outwards(out, before);
  return ok;
}

bool vs_swept_mesh(const vs_swept *s, vs_mesh *out) {
  laid l;
  bool ok = lay(s, &l), even = ok && s->stride;
  for (size_t r = 0; even && r < s->section_count; r++) even = !l.turns[r];
  if (even) {
    ok = mesh_of_strips(s, &l, out);
    laid_free(&l);
    return ok;
  }
  for (size_t first = 0, end; ok && first < s->section_count; first = end + 1) {
    end = piece_end(s, first);
    vs_quad_grid g = grid_of(s, &l, first, end + 1 - first);
    g.joined = s->joined;
    g.seam = s->seam;
    ok = mesh_of(s, &g, true, out);
  }
  laid_free(&l);
  return ok;
}

bool vs_swept_turns(const vs_swept *s, bool *turns) {
  laid l;
  bool ok = lay(s, &l);
  *turns = false;
  for (size_t r = 0; ok && r < s->section_count; r++) *turns = *turns || l.turns[r];
  laid_free(&l);
  return ok;
}

bool vs_swept_samples(const vs_swept *s, vs_step_point *out, size_t most, size_t *count) {
  laid l;
  *count = 0;
  bool ok = lay(s, &l) && vs_overturn_samples(&(vs_overturn_steps){ s, l.at, l.turns }, out, most, count);
  laid_free(&l);
  return ok;
}

bool vs_swept_runs(const vs_swept *s, size_t steps, vs_mesh **runs, size_t *count) {
  size_t n = s->profile_count, room = 0;
  laid l;
  bool ok = lay(s, &l);
  *runs = NULL;
  *count = 0;
  if (ok && s->seam)
    for (size_t i = 0; i < n; i++) l.at[(s->section_count - 1) * n + i] = l.at[s->seam[i]];
  for (size_t first = 0, end; ok && first < s->section_count; first = end + 1) {
    end = piece_end(s, first);
    size_t last = end + s->joined;
    for (size_t from = first; ok && from < last; from += steps) {
      size_t to = from + steps + 1 < last ? from + steps + 1 : last;
      vs_quad_grid g = grid_of(s, &l, from, to + 1 - from);
      ok = VS_GROW(*runs, room, *count + 1);
      if (!ok) break;
      (*runs)[(*count)++] = (vs_mesh){ 0 };
      ok = mesh_of(s, &g, false, &(*runs)[*count - 1]);
    }
  }
  laid_free(&l);
  while (!ok && *count) vs_mesh_free(&(*runs)[--*count]);
  if (!ok) free(*runs), *runs = NULL;
  return ok;
}

bool vs_outline_mesh(const vs_outline *o, vs_mesh *out) {
  size_t n = 0;
  for (size_t l = 0; l < o->count; l++) n += o->loops[l].count;
  uint32_t *row = vs_fresh(n, sizeof *row);
  vs_vec2 *flat = vs_fresh(n, sizeof *flat);
  size_t *sizes = vs_fresh(o->count, sizeof *sizes);
  bool ok = row && flat && sizes;
  size_t k = 0;
  for (size_t l = 0; ok && l < o->count; l++) {
    sizes[l] = o->loops[l].count;
    for (size_t i = 0; ok && i < o->loops[l].count; i++, k++) {
      vs_vec3 p = o->loops[l].at[i];
      flat[k] = (vs_vec2){ p.x * o->frame.m[0][0] + p.y * o->frame.m[1][0] + p.z * o->frame.m[2][0],
                           p.x * o->frame.m[0][1] + p.y * o->frame.m[1][1] + p.z * o->frame.m[2][1] };
      ok = vs_mesh_add_vertex(out, p, &row[k]);
    }
  }
  ok = ok && vs_grid_cap(&(vs_cap_loops){ flat, sizes, o->hole, o->count }, row, out, false);
  free(row);
  free(flat);
  free(sizes);
  return ok;
}
