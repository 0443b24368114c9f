/* Checks the result of a cluster by its volume. The check takes very little time.
 *
 * The volume of an expression lies between bounds that follow from its leaves' volumes. A union has at least the volume
 * of its largest operand, and at most the sum of all volumes. An intersection has at most the volume of its smallest
 * operand. A difference has at most the volume of its first operand. It has at least this volume less the volume of the
 * other operands within the first operand's box. A fault that loses or adds a part of the result would give a closed
 * but wrong mesh. Most such meshes exceed these bounds.
 *
 * A star that remains a star on the grid has the volume of its rounded triangles. If rounding to the grid has folded a
 * star, its winding numbers have changed only in space that triangles swept. Each corner moves by less than one step.
 * The swept volume of a triangle is at most its area plus its outline plus two, in steps. Any other leaf may overlap
 * itself, so its volume is bounded only by its box. */
#include "kernel/check.h"

#include <math.h>
#include <string.h>

static double step_volume(const vs_grid *g) {
  double step = g->unit / g->scale;
  return step * step * step * fabs(vs_affine_determinant(&g->frame));
}

static double box_volume(const vs_bvh_box *b) {
  double v = 1;
  for (int a = 0; a < 3; a++) v *= (double)b->max[a] - b->min[a];
  return v > 0 ? v : 0;
}

/* Returns an upper bound, in cubic steps, for the volume that a triangle sweeps while each of its corners moves by less
 * than one step. */
static double sweep_of(double x[3][3]) {
  vs_vec3 at[3];
  for (int j = 0; j < 3; j++) at[j] = vs_v3(x[j][0], x[j][1], x[j][2]);
  vs_vec3 a = vs_v3_sub(at[1], at[0]), b = vs_v3_sub(at[2], at[1]);
  return vs_v3_length(vs_v3_cross(a, b)) / 2 + vs_v3_length(a) + vs_v3_length(b) +
         vs_v3_length(vs_v3_sub(at[0], at[2])) + 2;
}

bool vs_check_leaves(vs_kernel *k, const vs_cluster *c, vs_check *check, vs_kernel_counts *counts) {
  /* CHANGED: a greater change of a leaf's volume, as a fraction of the volume, is reported. SOLID: a leaf whose volume
   * is a smaller fraction of its bounding box is not checked, because rounding errors dominate. */
  static const double CHANGED = 0.01, SOLID = 1e-9;
  if (!VS_ROOM(k, check->leaves.at, check->leaves.room, (size_t)c->leaf_count + 1)) return false;
  double unit = step_volume(&c->grid);
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_placed *p = &c->placed.at[i];
    const vs_mesh *m = p->part->mesh;
    const int32_t(*at)[3] = (const int32_t(*)[3])c->corners + p->first;
    bool folded = p->part->star && !p->star;
    double six = 0, swept = 0;
    for (size_t t = 0; t < m->triangle_count; t++) {
      const uint32_t *v = m->triangles[t];
      double x[3][3]; /* coordinates of the triangle's three corners relative to the first vertex of the leaf; otherwise
                       * the products would be inaccurate for a small leaf far from the origin */
      for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) x[j][a] = (double)at[v[j]][a] - at[0][a];
      six += x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) - x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) +
             x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]);
      if (folded) swept += sweep_of(x);
      if (!vs_kernel_poll(k, 0)) return false;
    }
    double box = box_volume(&p->box), grid = fabs(six / 6),
           exact = fabs(p->part->volume * vs_affine_determinant(&c->problem->leaves[c->leaves[i]].placement)) / unit;
    check->leaves.at[i] = p->star  ? (vs_leaf_volume){ grid, grid }
                          : folded ? (vs_leaf_volume){ fmax(0, exact - swept), fmin(exact + swept, box) }
                                   : (vs_leaf_volume){ 0, box };
    if (!(fabs(grid - exact) > CHANGED * exact) || !(exact > SOLID * box)) continue;
    if (counts->coarse++ == 0)
      counts->coarse_leaf = c->leaves[i], counts->coarse_step = c->grid.unit / c->grid.scale,
      counts->coarse_by = (grid - exact) / exact;
  }
  check->leaves.count = c->leaf_count;
  return true;
}

static vs_bvh_box common_box(const vs_bvh_box *x, const vs_bvh_box *y) {
  vs_bvh_box b;
  for (int a = 0; a < 3; a++)
    b.min[a] = x->min[a] > y->min[a] ? x->min[a] : y->min[a], b.max[a] = x->max[a] < y->max[a] ? x->max[a] : y->max[a];
  for (int a = 0; a < 3; a++)
    if (b.min[a] >= b.max[a]) return vs_box_nowhere;
  return b;
}

static void unite_box(vs_bvh_box *x, const vs_bvh_box *y) {
  for (int a = 0; a < 3; a++) {
    if (y->min[a] < x->min[a]) x->min[a] = y->min[a];
    if (y->max[a] > x->max[a]) x->max[a] = y->max[a];
  }
}

/* Bounds on the volume of a leaf or term, in cubic grid steps, and its bounding box, in steps. A leaf outside of the
 * checked cluster has volume 0. */
typedef struct { double least, most; vs_bvh_box box; } bounds;

/* Returns the bounds on the volume of a term (union, intersection or difference) with the operands a and b. */
static bounds combine(vs_term_kind kind, bounds a, const bounds *b) {
  vs_bvh_box both = common_box(&a.box, &b->box);
  switch (kind) {
  case VS_TERM_UNION:
    a.least = fmax(a.least, b->least);
    a.most += b->most;
    unite_box(&a.box, &b->box);
    break;
  case VS_TERM_INTERSECTION:
    a.least = 0;
    a.most = fmin(fmin(a.most, b->most), box_volume(&both));
    a.box = both;
    break;
  case VS_TERM_DIFFERENCE: a.least = fmax(0, a.least - fmin(b->most, box_volume(&both))); break;
  case VS_TERM_LEAF: break;
  }
  return a;
}

/* Computes bounds on the volume of the result from the volumes of the leaves, and of all terms unless that would take
 * too long. */
static bool find_bounds(vs_kernel *k, const vs_cluster *c, const vs_check *check, double *least, double *most) {
  const vs_kernel_problem *p = c->problem;
  const vs_expression *e = c->expression;
  VS_LIST(bounds) all = { 0 }; /* bounds on the volumes of the leaves, followed by the bounds on the volumes of the
                                * terms */
  size_t terms = p->term_count, n = terms + p->leaf_count;
  *least = *most = 0;
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_leaf_volume *v = &check->leaves.at[i];
    if (e->forced && e->forces.at[c->leaves[i]]) *least = fmax(*least, v->least);
    *most += v->most;
  }
  if (n > 4 * (size_t)c->leaf_count + 1000 || !terms) return true;
  if (!VS_ROOM(k, all.at, all.room, n + 1)) return false;
  for (size_t i = 0; i < n; i++) all.at[i] = (bounds){ 0, 0, vs_box_nowhere };
  for (uint32_t i = 0; i < c->leaf_count; i++)
    all.at[c->leaves[i]] = (bounds){ check->leaves.at[i].least, check->leaves.at[i].most, c->placed.at[i].box };
  bounds *of = all.at + p->leaf_count;
  for (uint32_t i = 0; i < terms; i++) {
    const vs_kernel_term *t = &p->terms[i];
    if (t->kind == VS_TERM_LEAF) of[i] = all.at[t->first];
    for (uint32_t j = 0; t->kind != VS_TERM_LEAF && j < t->count; j++)
      of[i] = j == 0 ? of[p->operands[t->first]] : combine(t->kind, of[i], &of[p->operands[t->first + j]]);
  }
  *least = fmax(*least, of[terms - 1].least), *most = fmin(*most, of[terms - 1].most);
  VS_DROP(k, all);
  return true;
}

/* Returns a normal of triangle t of the mesh whose length is twice the triangle's area. Computes it from the two
 * shorter edges: in a very thin triangle, the product of two long edges would be mostly rounding error. *a: the corner
 * between the two shorter edges. */
static vs_vec3 twice_area(const vs_mesh *m, size_t t, vs_vec3 *a) {
  vs_vec3 at[3], edge[3];
  int longest = 0;
  VS_ASSERT(t < m->triangle_count);
  for (int j = 0; j < 3; j++) at[j] = m->vertices[m->triangles[t][j]];
  for (int j = 0; j < 3; j++) {
    edge[j] = vs_v3_sub(at[(j + 1) % 3], at[j]);
    if (vs_v3_dot(edge[j], edge[j]) > vs_v3_dot(edge[longest], edge[longest])) longest = j;
  }
  *a = at[(longest + 2) % 3];
  return vs_v3_cross(edge[(longest + 1) % 3], edge[(longest + 2) % 3]);
}

bool vs_check_result(vs_kernel *k, const vs_cluster *c, const vs_check *check, const vs_mesh *out, size_t first) {
  double six = 0, area = 0, far = 0, least, most, sum = 0, unit = step_volume(&c->grid);
  VS_ASSERT(first <= out->triangle_count);
  if (!find_bounds(k, c, check, &least, &most)) return false;
  for (uint32_t i = 0; i < c->leaf_count; i++) sum += check->leaves.at[i].most;
  for (size_t t = first; t < out->triangle_count; t++) {
    vs_vec3 a, n = twice_area(out, t, &a), o = out->vertices[out->triangles[first][0]];
    six += vs_v3_dot(n, vs_v3_sub(a, o));
    area += vs_v3_length(n) / 2;
    far = fmax(far, fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))));
    if (!vs_kernel_poll(k, 1)) return false;
  }
  double volume = six / 6 / unit, slack = 1e-9 * sum + 0x1p-48 * far * area / unit; /* slack: upper bound, in cubic
                                                                                     * steps, for the error from
                                                                                     * rounding to doubles */
  if (c->straightened) slack += 2 * area * cbrt(unit) / unit; /* Removing the bends of cuts (straighten.c) moves the
                                                               * surface by at most two grid steps. The volume changes
                                                               * by at most twice the area, here in cubic steps. */
  if (volume >= least - slack && volume <= most + slack) return true;
  return VS_BROKEN(k, volume < least - slack ? "the result is smaller than its parts allow"
                                             : "the result is larger than its parts allow");
}

void vs_check_free(vs_kernel *k, vs_check *check) { VS_DROP(k, check->leaves); }

/* ---- checks of the cluster's state between two steps of the kernel ---- */

static size_t point_count(const vs_cluster *c) { return c->points.all.count; }
static size_t plane_count(const vs_cluster *c) { return c->planes.all.count; }

bool vs_holds_grid(const vs_cluster *c) {
  for (size_t i = 0; i < c->triangles.count; i++) {
    const vs_grid_triangle *t = &c->triangles.at[i];
    if (t->v[0] == t->v[1] || t->v[1] == t->v[2] || t->v[2] == t->v[0]) return false;
    for (int j = 0; j < 3; j++)
      if (t->v[j] >= point_count(c)) return false;
    if (t->plane >= plane_count(c) || t->facet >= c->facets.count) return false;
    const vs_facet *f = &c->facets.at[t->facet];
    if (f->plane != t->plane || f->leaf != t->leaf || f->flip != t->flip || f->place >= c->leaf_count) return false;
  }
  return true;
}

bool vs_holds_patches(const vs_cluster *c) {
  for (size_t i = 0; i < c->patches.count; i++) {
    const vs_patch *p = &c->patches.at[i];
    if (p->facet >= c->facets.count || p->count < 3 || p->first + p->count > c->patch_corners.count) return false;
    for (uint32_t j = p->first; j < p->first + p->count; j++)
      if (c->patch_corners.at[j].point >= point_count(c)) return false;
  }
  return true;
}

bool vs_holds_cuts(const vs_cluster *c) {
  for (size_t i = 0; i < c->cuts.count; i++) {
    const vs_facet_cut *cut = &c->cuts.at[i];
    if (cut->facet >= c->facets.count || cut->p >= point_count(c) || cut->q >= point_count(c)) return false;
    if (cut->plane != VS_NONE && cut->plane >= plane_count(c)) return false;
  }
  for (size_t i = 0; i < c->facets.count; i++)
    if (c->facets.at[i].group >= c->facets.count) return false;
  return true;
}

bool vs_holds_faces(const vs_cluster *c) {
  for (size_t i = 0; i < c->faces.count; i++) {
    const vs_face *f = &c->faces.at[i];
    if (f->plane != VS_NONE && f->plane >= plane_count(c)) return false;
    if (f->cover + f->cover_count > c->covers.count || f->use + f->use_count > c->uses.count) return false;
    for (uint32_t j = f->use; j < f->use + f->use_count; j++) {
      const vs_use *use = &c->uses.at[j];
      if (use->face != i || use->from == use->to) return false;
      if (use->from >= point_count(c) || use->to >= point_count(c)) return false;
    }
  }
  return true;
}

bool vs_holds_kept(const vs_cluster *c) {
  if (c->kept.count != c->faces.count) return false;
  for (size_t i = 0; i < c->kept.count; i++)
    if (c->kept.at[i] > 2) return false;
  return true;
}

bool vs_holds_result(const vs_mesh *m, size_t first_triangle) {
  for (size_t i = first_triangle; i < m->triangle_count; i++) {
    const uint32_t *v = m->triangles[i];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return false;
    for (int j = 0; j < 3; j++)
      if (v[j] >= m->vertex_count) return false;
  }
  return true;
}
