/* Inspects a mesh for flaws. It finds open edges by the coordinates as given. It computes winding numbers in the exact
 * arrangement of the mesh with itself.
 *
 * Every cell of this arrangement has a winding number, which should be 0 or 1. A cell with another number that is
 * thinner than two grid steps comes from rounding of faces that touch, and is ignored. For any other such cell, the
 * inspection reports the triangles that bound it. */
#include "kernel/mesh/inspect.h"
#include "kernel/arrange/arrange_planes.h"
#include "kernel/arrange/classify.h"
#include "kernel/arrange/cluster_frame.h"
#include "kernel/arrange/intersect_patches.h"
#include "kernel/arrange/patches.h"
#include "kernel/arrange/snap_to_grid.h"
#include "kernel/evaluate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernel/mesh/triangles_apart.h"
#include "kernel/cluster.h"
#include "kernel/threads.h"

/* ---- open edges: those that triangles contain more often in one direction than in the other ---- */

typedef struct { uint32_t low, high, triangle; int32_t way; } directed;

static int compare_vertices(const vs_vec3 *a, const vs_vec3 *b) {
  if (a->x != b->x) return a->x < b->x ? -1 : 1;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  return a->z != b->z ? (a->z < b->z ? -1 : 1) : 0;
}

static bool vertex_before(const void *context, uint32_t a, uint32_t b) {
  const vs_vec3 *v = context;
  int c = compare_vertices(&v[a], &v[b]);
  return c ? c < 0 : a < b;
}

static bool directed_before(const void *context, uint32_t a, uint32_t b) {
  const directed *e = context, *x = &e[a], *y = &e[b];
  if (x->low != y->low) return x->low < y->low;
  return x->high != y->high ? x->high < y->high : x->triangle < y->triangle;
}

/* Inserts a flaw into the list, which is sorted by triangle, and increases *count. The list keeps only the first
 * VS_FLAWS_LISTED flaws. */
static void by_triangle(vs_mesh_flaw *list, size_t *count, vs_mesh_flaw flaw) {
  size_t held = *count < VS_FLAWS_LISTED ? *count : VS_FLAWS_LISTED, i = held;
  while (i > 0 && list[i - 1].triangle > flaw.triangle) i--;
  if (i < VS_FLAWS_LISTED) {
    size_t last = held < VS_FLAWS_LISTED ? held : VS_FLAWS_LISTED - 1;
    memmove(&list[i + 1], &list[i], (last - i) * sizeof *list);
    list[i] = flaw;
  }
  ++*count;
}

static bool open_edges(vs_kernel *k, const vs_mesh *m, vs_mesh_flaws *out) {
  VS_LIST(uint32_t) order = { 0 }, scratch = { 0 }, same = { 0 };
  VS_LIST(directed) edges = { 0 };
  size_t n = m->vertex_count, most = 3 * m->triangle_count, room = (n > most ? n : most) + 1;
  bool ok = VS_ROOM(k, order.at, order.room, room) && VS_ROOM(k, scratch.at, scratch.room, room) &&
            VS_ROOM(k, same.at, same.room, n + 1) && VS_ROOM(k, edges.at, edges.room, most + 1);
  for (size_t i = 0; ok && i < n; i++) order.at[i] = (uint32_t)i;
  if (ok) {
    vs_kernel_sort(order.at, scratch.at, n, vertex_before, m->vertices);
    for (size_t i = 0; i < n; i++) {
      bool again = i && compare_vertices(&m->vertices[order.at[i]], &m->vertices[order.at[i - 1]]) == 0;
      same.at[order.at[i]] = again ? same.at[order.at[i - 1]] : order.at[i];
    }
    for (uint32_t t = 0; t < m->triangle_count; t++)
      for (int j = 0; j < 3; j++) {
        uint32_t a = same.at[m->triangles[t][j]], b = same.at[m->triangles[t][(j + 1) % 3]];
        if (a != b) edges.at[edges.count++] = (directed){ a < b ? a : b, a < b ? b : a, t, a < b ? 1 : -1 };
      }
    for (size_t i = 0; i < edges.count; i++) order.at[i] = (uint32_t)i;
    vs_kernel_sort(order.at, scratch.at, edges.count, directed_before, edges.at);
  }
  for (size_t i = 0, end; ok && i < edges.count; i = end) {
    const directed *first = &edges.at[order.at[i]];
    int32_t balance = 0;
    for (end = i;
         end < edges.count && edges.at[order.at[end]].low == first->low && edges.at[order.at[end]].high == first->high;
         end++)
      balance += edges.at[order.at[end]].way;
    if (balance != 0) {
      const vs_vec3 *a = &m->vertices[first->low], *b = &m->vertices[first->high];
      vs_mesh_flaw flaw = { first->triangle, vs_v3((a->x + b->x) / 2, (a->y + b->y) / 2, (a->z + b->z) / 2), 0 };
      for (size_t j = i; j < end; j++) /* finds the first triangle that has this edge without a partner in the opposite
                                        * direction */
        if ((edges.at[order.at[j]].way > 0) == (balance > 0)) {
          flaw.triangle = edges.at[order.at[j]].triangle;
          break;
        }
      by_triangle(out->open, &out->open_count, flaw);
    }
    ok = vs_kernel_poll(k, 0);
  }
  VS_DROP(k, order);
  VS_DROP(k, scratch);
  VS_DROP(k, same);
  VS_DROP(k, edges);
  return ok;
}

/* ---- winding numbers ---- */

typedef struct { const vs_point *origin; double volume, area; } cell;
typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  uint32_t face;
  int64_t at[3]; /* a place inside the face, in fixed-point numbers */
  uint32_t found;
} search;

static bool holds(void *context, uint32_t patch) {
  search *s = context;
  const vs_facet *f = &s->c->facets.at[s->c->patches.at[patch].facet];
  if (f->plane != s->c->faces.at[s->face].plane) return true;
  const vs_plane *p = &s->c->planes.all.at[f->plane];
  for (uint32_t t = f[0].first; t < f[1].first; t++) {
    const vs_grid_triangle *triangle = &s->c->triangles.at[s->c->facet_triangles.at[t]];
    bool left = true, right = true;
    for (int i = 0; i < 3; i++) {
      const vs_point *a = &s->c->points.all.at[triangle->v[i]], *b = &s->c->points.all.at[triangle->v[(i + 1) % 3]];
      double turn = (double)(b->fixed[p->u] - a->fixed[p->u]) * (double)(s->at[p->v] - a->fixed[p->v]) -
                    (double)(b->fixed[p->v] - a->fixed[p->v]) * (double)(s->at[p->u] - a->fixed[p->u]);
      left = left && turn >= 0;
      right = right && turn <= 0;
    }
    if ((left || right) && triangle->source < s->found) s->found = triangle->source;
  }
  return true;
}

/* Computes an approximate place inside the face, in fixed-point numbers. A line at half the face's height intersects it
 * in segments. The place is the middle of the longest segment. */
static void inside_of(const vs_cluster *c, uint32_t face, int64_t at[3]) {
  const vs_plane *p = &c->planes.all.at[c->faces.at[face].plane];
  const vs_use *uses = c->uses.at + c->faces.at[face].use;
  size_t count = c->faces.at[face].use_count;
  double low = INFINITY, high = -INFINITY, best = -1, u = 0, v;
  VS_ASSERT(c->faces.at[face].plane != VS_NONE);
  for (size_t i = 0; i < count; i++) {
    double y = (double)c->points.all.at[uses[i].from].fixed[p->v];
    low = fmin(low, y);
    high = fmax(high, y);
  }
  v = low + 0.4871 * (high - low);
  for (size_t i = 0; i < count; i++) { /* pairs each crossing of the line with the face's border with the next crossing
                                        * to its right */
    double x[2] = { 0, INFINITY };
    for (int pass = 0; pass < 2; pass++)
      for (size_t j = pass ? 0 : i; j < (pass ? count : i + 1); j++) {
        const vs_use *use = &uses[j];
        const vs_point *a = &c->points.all.at[use->from], *b = &c->points.all.at[use->to];
        double ay = (double)a->fixed[p->v], by = (double)b->fixed[p->v];
        if ((ay > v) == (by > v)) {
          if (!pass) x[0] = NAN;
          continue;
        }
        double cross = (double)a->fixed[p->u] + (v - ay) / (by - ay) * (double)(b->fixed[p->u] - a->fixed[p->u]);
        if (!pass) x[0] = ay > by ? cross : NAN; /* A face lies to the left of its boundary edges. Therefore the face is
                                                  * to the right along u if the edge goes down. */
        else if (cross > x[0] && cross < x[1]) x[1] = cross;
      }
    if (isfinite(x[0]) && isfinite(x[1]) && x[1] - x[0] > best) best = x[1] - x[0], u = (x[0] + x[1]) / 2;
  }
  at[p->u] = (int64_t)u;
  at[p->v] = (int64_t)v;
  at[p->k] = (int64_t)(((double)p->d * 0x1p30 - (double)p->n[p->u] * u - (double)p->n[p->v] * v) / (double)p->n[p->k]);
}

/* Computes the volume of each cell, in cubic steps, and its area, in square steps. The volume is a sum of cones whose
 * tip is a corner of the cell. This corner is near, so rounding errors are small even for a small cell. */
static void measure_cells(const vs_cluster *c, cell *cells) {
  for (uint32_t f = 0; f < c->faces.count; f++) {
    uint32_t begin = c->faces.at[f].use, end = begin + c->faces.at[f].use_count;
    if (begin == end) continue;
    const vs_plane *p = &c->planes.all.at[c->faces.at[f].plane];
    const vs_point *o = &c->points.all.at[c->uses.at[begin].from];
    double n[3] = { (double)p->n[0], (double)p->n[1], (double)p->n[2] },
           length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), seen = 0;
    for (uint32_t i = begin; i < end; i++) {
      const vs_point *a = &c->points.all.at[c->uses.at[i].from], *b = &c->points.all.at[c->uses.at[i].to];
      double au = (double)(a->fixed[p->u] - o->fixed[p->u]) * 0x1p-30,
             av = (double)(a->fixed[p->v] - o->fixed[p->v]) * 0x1p-30;
      double bu = (double)(b->fixed[p->u] - o->fixed[p->u]) * 0x1p-30,
             bv = (double)(b->fixed[p->v] - o->fixed[p->v]) * 0x1p-30;
      seen += (au * bv - av * bu) / 2; /* area of the face as seen along axis k, in square steps */
    }
    double area = seen * length / fabs(n[p->k]);
    for (uint32_t side = 0; side < 2; side++) {
      cell *x = &cells[c->side_cell.at[2 * f + side]];
      if (!x->origin) x->origin = o;
      double height = 0;
      for (int j = 0; j < 3; j++) height += n[j] * ((double)(o->fixed[j] - x->origin->fixed[j]) * 0x1p-30);
      x->area += area;
      /* the plane's normal points out of the cell on the - side of the face */
      x->volume += (side ? area : -area) * height / length / 3;
    }
  }
}

static bool name_triangles(vs_kernel *k, vs_cluster *c, vs_mesh_flaws *out) {
  VS_LIST(cell) cells = { 0 };
  VS_LIST(uint8_t) named = { 0 };
  size_t n = c->wound.count, f = c->faces.count;
  bool ok = VS_ROOM(k, cells.at, cells.room, n + 1) &&
            VS_ROOM(k, named.at, named.room, c->problem->leaves[0].mesh->triangle_count + 1);
  if (ok && c->uses.count) {
    memset(cells.at, 0, (n + 1) * sizeof *cells.at);
    memset(named.at, 0, c->problem->leaves[0].mesh->triangle_count + 1);
    measure_cells(c, cells.at);
  }
  for (uint32_t i = 0; ok && i < 2 * f; i++) {
    uint32_t at = c->side_cell.at[i];
    int32_t winding = c->wound.at[at];
    /* Ignores cells thinner than two grid steps, which rounding may cause: their volume is at most half their area
     * times two steps. */
    if ((winding == 0 || winding == 1) || fabs(cells.at[at].volume) <= cells.at[at].area) continue;
    if (winding < out->least) out->least = winding;
    if (winding > out->most) out->most = winding;
    search s = { k, c, i / 2, { 0 }, VS_NONE };
    inside_of(c, i / 2, s.at);
    vs_bvh_box box;
    for (int j = 0; j < 3; j++) box.min[j] = (int32_t)(s.at[j] >> VS_FIXED_BITS) - 1, box.max[j] = box.min[j] + 3;
    ok = vs_bvh_query(&c->bvh, &box, holds, &s) && vs_kernel_poll(k, 0.9);
    if (s.found == VS_NONE || named.at[s.found]) continue;
    named.at[s.found] = 1;
    vs_point place = { .fixed = { s.at[0], s.at[1], s.at[2] } };
    by_triangle(out->wound, &out->wound_count, (vs_mesh_flaw){ s.found, vs_grid_world(&c->grid, &place), winding });
  }
  VS_DROP(k, cells);
  VS_DROP(k, named);
  return ok;
}

/* ---- a quick test that finds most meshes without flaws ---- */

/* Sets *apart to true if every shell (connected triangles) faces outwards and the boxes of the shells do not
 * intersect. */
static bool shells_apart(vs_kernel *k, const vs_part *p, bool *apart) {
  enum { FEW = 64 };
  const vs_mesh *m = p->mesh;
  VS_LIST(uint32_t) shell = { 0 };
  VS_LIST(vs_bounds) bounds = { 0 };
  VS_LIST(double) volumes = { 0 };
  size_t n = m->triangle_count, count = 0;
  bool ok = VS_ROOM(k, shell.at, shell.room, n) && VS_ROOM(k, bounds.at, bounds.room, FEW) &&
            VS_ROOM(k, volumes.at, volumes.room, FEW);
  *apart = ok;
  if (ok) vs_disjoint(shell.at, (uint32_t)n);
  for (uint32_t i = 0; ok && i < 3 * n; i++) {
    if (p->twins[i] != VS_NONE) vs_unite(shell.at, i / 3, p->twins[i] / 3);
    ok = vs_kernel_poll(k, k->part);
  }
  for (uint32_t t = 0; ok && *apart && t < n; t++) { /* The root of each shell's set is its least index. Therefore one
                                                      * pass can replace the parents by numbers of shells. */
    uint32_t root = vs_find(shell.at, t);
    if (root != t) continue;
    if (count == FEW) *apart = false;
    else bounds.at[count] = vs_bounds_empty(), volumes.at[count++] = 0;
  }
  VS_LIST(uint32_t) number = { 0 };
  ok = ok && VS_ROOM(k, number.at, number.room, n);
  for (uint32_t t = 0, next = 0; ok && *apart && t < n; t++) {
    uint32_t root = vs_find(shell.at, t);
    number.at[t] = root == t ? next++ : number.at[root];
    vs_vec3 v[3];
    for (int i = 0; i < 3; i++)
      vs_bounds_add(&bounds.at[number.at[t]],
                    v[i] = vs_v3_sub(m->vertices[m->triangles[t][i]], m->vertices[m->triangles[root][0]]));
    volumes.at[number.at[t]] += vs_v3_dot(v[0], vs_v3_cross(v[1], v[2])) / 6;
    ok = vs_kernel_poll(k, k->part);
  }
  for (uint32_t t = 0; ok && *apart && t < n; t++) /* restores the union-find parents that the numbers of shells had
                                                    * replaced */
    if (vs_find(shell.at, t) == t) {
      vs_bounds *b = &bounds.at[number.at[t]];
      b->min = vs_v3_add(b->min, m->vertices[m->triangles[t][0]]);
      b->max = vs_v3_add(b->max, m->vertices[m->triangles[t][0]]);
    }
  for (size_t i = 0; ok && i < count && *apart; i++) {
    vs_vec3 size = vs_v3_sub(bounds.at[i].max, bounds.at[i].min);
    *apart = volumes.at[i] > 1e-9 * size.x * size.y * size.z;
    for (size_t j = 0; j < i; j++) {
      vs_bounds both = bounds.at[i];
      vs_bounds_meet(&both, &bounds.at[j]);
      *apart = *apart && vs_bounds_is_empty(&both);
    }
  }
  VS_DROP(k, number);
  VS_DROP(k, shell);
  VS_DROP(k, bounds);
  VS_DROP(k, volumes);
  return ok;
}

/* Sets *whole to true if the triangles at each vertex form a single fan. Unites triangle corners that follow each other
 * around a vertex, and compares the number of sets with the number of vertices. */
static bool fans_whole(vs_kernel *k, const vs_part *p, bool *whole) {
  const vs_mesh *m = p->mesh;
  size_t n = 3 * m->triangle_count, sets = 0, corners = 0;
  VS_LIST(uint32_t) set = { 0 };
  VS_LIST(uint8_t) seen = { 0 };
  bool ok = VS_ROOM(k, set.at, set.room, n + 1) && VS_ROOM(k, seen.at, seen.room, m->vertex_count + 1);
  if (ok) {
    memset(seen.at, 0, m->vertex_count + 1);
    vs_disjoint(set.at, (uint32_t)n);
    for (uint32_t c = 0; ok && c < n; c++) {
      uint32_t twin = p->twins[c], at = m->triangles[c / 3][c % 3];
      if (twin != VS_NONE) vs_unite(set.at, c, twin % 3 == 2 ? twin - 2 : twin + 1);
      corners += !seen.at[at];
      seen.at[at] = 1;
      ok = vs_kernel_poll(k, k->part);
    }
    for (uint32_t c = 0; ok && c < n; c++) {
      sets += vs_find(set.at, c) == c;
      ok = vs_kernel_poll(k, k->part);
    }
  }
  *whole = ok && sets == corners;
  VS_DROP(k, set);
  VS_DROP(k, seen);
  return ok;
}

bool vs_part_plainly_good(vs_kernel *k, const vs_part *p, bool *good) {
  bool apart, whole;
  size_t edges;
  *good = false;
  if (p->star) return *good = true;
  if (!p->twins) return true;
  if (!shells_apart(k, p, good) || !*good) return k->error->status == VS_KERNEL_FINE;
  *good = false;
  if (!fans_whole(k, p, &whole) || !vs_mesh_is_apart(k, p->mesh, &apart, &edges)) return false;
  /* The last condition excludes a mesh with edges of four triangles, because these can be paired in several ways. */
  *good = whole && apart && 2 * edges == 3 * p->mesh->triangle_count;
  return true;
}

/* Returns true if facets of the cluster intersect or touch. Facets in different planes then have cuts; facets of one
 * plane are then united to a group. */
static bool touches(const vs_cluster *c) {
  for (uint32_t f = 0; f < c->facets.count; f++)
    if (c->facets.at[f].group != f) return true;
  return c->cuts.count > 0;
}

bool vs_kernel_inspect(const vs_mesh *mesh, const vs_kernel_options *options, vs_mesh_flaws *out,
                       vs_kernel_error *error) {
  vs_kernel_error ignored;
  vs_kernel k = {
    .options = options, .error = error ? error : &ignored, .threads = vs_kernel_threads(options), .share = 1
  };
  *k.error = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
  *out = (vs_mesh_flaws){ 0 };
  vs_kernel_time(&k, options && options->counts ? options->counts->seconds : NULL);
  if (mesh->triangle_count == 0) return true;
  for (size_t i = 0; i < mesh->vertex_count; i++) {
    const vs_vec3 *v = &mesh->vertices[i];
    if (!isfinite(v->x) || !isfinite(v->y) || !isfinite(v->z))
      return vs_kernel_fail(&k, VS_KERNEL_NOT_FINITE, 0, "a corner is not at a finite place");
  }
  vs_kernel_leaf leaf = { mesh, vs_affine_identity(), 0, false };
  vs_kernel_term term = { VS_TERM_LEAF, 0, 0 };
  vs_kernel_problem problem = { .leaves = &leaf, .terms = &term, .leaf_count = 1, .term_count = 1 };
  uint32_t only = 0;
  vs_parts parts = { .all = { 0 } };
  vs_expression e = { .root = 0 };
  vs_cluster c = {
    .problem = &problem, .parts = &parts, .expression = &e, .leaves = &only, .leaf_count = 1, .inspect = true
  };
  bool good = false, ok = vs_parts_prepare(&k, &parts, &problem, &only, &only, 1) &&
                          vs_part_plainly_good(&k, &parts.all.at[0], &good);
  if (good) out->most = 1;
  ok = ok && (good || parts.all.at[0].twins || open_edges(&k, mesh, out));
  out->volume = vs_mesh_volume(mesh);
  if (ok && !good && !out->open_count) {
    ok = vs_expression_build(&k, &e, &problem) && vs_snap_to_grid(&k, &c) && vs_patches_build(&k, &c) &&
         vs_meet_patches(&k, &c) && vs_arrange_planes(&k, &c) && vs_classify_faces(&k, &c, &e);
    for (size_t i = 0; ok && i < c.wound.count; i++)
      if (c.wound.at[i] == 1) out->most = 1;
    out->touches = ok && touches(&c);
    ok = ok && name_triangles(&k, &c, out);
  }
  vs_kernel_lap(&k, VS_STEP_INSPECT);
  vs_cluster_free(&k, &c);
  vs_expression_free(&k, &e);
  vs_parts_free(&k, &parts);
  return ok;
}

bool vs_kernel_resolve(const vs_mesh *mesh, uint32_t tag, const vs_kernel_options *options, vs_mesh *out,
                       vs_kernel_error *error) {
  vs_kernel_leaf leaf = { mesh, vs_affine_identity(), tag, false };
  vs_kernel_term term = { VS_TERM_LEAF, 0, 0 };
  vs_kernel_problem problem = { .leaves = &leaf, .terms = &term, .leaf_count = 1, .term_count = 1 };
  return vs_kernel_evaluate(&problem, options, out, error);
}
