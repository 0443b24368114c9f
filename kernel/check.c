/* Owns what a cluster is held to that costs next to nothing.
 *
 * The volume of an expression lies between bounds that follow from its leaves' volumes: a union holds at least its largest operand and at most their sum, an
 * intersection at most its smallest, a difference at most its first and at least that less the others. A fault that lost or invented a part of the result would be
 * written as a mesh that is closed and wrong; most of them would fall out of these bounds. */
#include "kernel/check.h"

#include <math.h>
#include <string.h>

static double step_volume(const vs_grid *g) {
  double step = g->unit / g->scale;
  return step * step * step * fabs(vs_affine_determinant(&g->frame));
}

static double box_volume(const vs_box *b) {
  double v = 1;
  for (int a = 0; a < 3; a++) v *= (double)b->max[a] - b->min[a];
  return v > 0 ? v : 0;
}

bool vs_check_leaves(vs_kernel *k, const vs_cluster *c, vs_check *check, vs_kernel_counts *counts) {
  static const double CHANGED = 0.01, SOLID = 1e-9; /* of its volume; of its box: less is not known well enough to compare */
  if (!VS_ROOM(k, check->leaves.at, check->leaves.room, (size_t)c->leaf_count + 1)) return false;
  double unit = step_volume(&c->grid);
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_placed *p = &c->placed.at[i];
    const vs_mesh *m = p->part->mesh;
    const int32_t(*at)[3] = (const int32_t(*)[3])c->corners + p->first;
    double six = 0;
    for (size_t t = 0; t < m->triangle_count; t++) {
      const uint32_t *v = m->triangles[t];
      double x[3][3]; /* from the first corner of all: small numbers where the leaf is small */
      for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++) x[j][a] = (double)(at[v[j]][a] - at[0][a]);
      six += x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) - x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) + x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]);
      if (!vs_kernel_poll(k, 0)) return false;
    }
    double box = box_volume(&p->box), grid = fabs(six / 6), exact = fabs(p->part->volume * vs_affine_determinant(&c->problem->leaves[c->leaves[i]].placement)) / unit;
    check->leaves.at[i] = (vs_leaf_volume){ grid, p->star ? grid : box, p->star };
    if (!(fabs(grid - exact) > CHANGED * exact) || !(exact > SOLID * box)) continue;
    if (counts->coarse++ == 0) counts->coarse_leaf = c->leaves[i], counts->coarse_step = c->grid.unit / c->grid.scale, counts->coarse_by = (grid - exact) / exact;
  }
  check->leaves.count = c->leaf_count;
  return true;
}

/* In steps. Where the cluster is a small part of a large expression, by the leaves alone. */
static bool find_bounds(vs_kernel *k, const vs_cluster *c, const vs_check *check, double *least, double *most) {
  const vs_kernel_problem *p = c->problem;
  const vs_expression *e = c->expression;
  VS_LIST(double) low = { 0 }, high = { 0 }; /* of leaves, then of terms */
  size_t terms = p->term_count, n = terms + p->leaf_count;
  *least = *most = 0;
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_leaf_volume *v = &check->leaves.at[i];
    uint32_t leaf = c->leaves[i];
    if (e->forced && e->forces.at[leaf] && v->sure) *least = fmax(*least, v->grid);
    *most += v->most;
  }
  if (n > 4 * (size_t)c->leaf_count + 1000) return true;
  if (!VS_ROOM(k, low.at, low.room, n + 1) || !VS_ROOM(k, high.at, high.room, n + 1)) return VS_DROP(k, low), VS_DROP(k, high), false;
  memset(low.at, 0, n * sizeof *low.at);
  memset(high.at, 0, n * sizeof *high.at);
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_leaf_volume *v = &check->leaves.at[i];
    low.at[c->leaves[i]] = v->sure ? v->grid : 0;
    high.at[c->leaves[i]] = v->most;
  }
  double *tl = low.at + p->leaf_count, *th = high.at + p->leaf_count;
  for (uint32_t i = 0; i < terms; i++) {
    const vs_kernel_term *t = &p->terms[i];
    if (t->kind == VS_TERM_LEAF) tl[i] = low.at[t->first], th[i] = high.at[t->first];
    for (uint32_t j = 0; t->kind != VS_TERM_LEAF && j < t->count; j++) {
      uint32_t o = p->operands[t->first + j];
      if (j == 0) tl[i] = tl[o], th[i] = th[o];
      else if (t->kind == VS_TERM_UNION) tl[i] = fmax(tl[i], tl[o]), th[i] += th[o];
      else if (t->kind == VS_TERM_INTERSECTION) tl[i] = 0, th[i] = fmin(th[i], th[o]);
      else tl[i] = fmax(0, tl[i] - th[o]);
    }
  }
  if (terms) *least = fmax(*least, tl[terms - 1]), *most = fmin(*most, th[terms - 1]);
  VS_DROP(k, low);
  VS_DROP(k, high);
  return true;
}

bool vs_check_result(vs_kernel *k, const vs_cluster *c, const vs_check *check, const vs_mesh *out, size_t first) {
  double six = 0, area = 0, far = 0, least, most, sum = 0, unit = step_volume(&c->grid);
  if (!find_bounds(k, c, check, &least, &most)) return false;
  for (uint32_t i = 0; i < c->leaf_count; i++) sum += check->leaves.at[i].most;
  for (size_t t = first; t < out->triangle_count; t++) {
    vs_vec3 o = out->vertices[out->triangles[first][0]], a = out->vertices[out->triangles[t][0]];
    vs_vec3 n = vs_v3_cross(vs_v3_sub(out->vertices[out->triangles[t][1]], a), vs_v3_sub(out->vertices[out->triangles[t][2]], a));
    six += vs_v3_dot(n, vs_v3_sub(a, o));
    area += vs_v3_length(n) / 2;
    far = fmax(far, fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))));
    if (!vs_kernel_poll(k, 1)) return false;
  }
  double volume = six / 6 / unit, slack = 1e-9 * sum + 0x1p-48 * far * area / unit; /* what rounding to doubles moves */
  if (volume >= least - slack && volume <= most + slack) return true;
  return VS_BROKEN(k, volume < least - slack ? "the result is smaller than its parts allow" : "the result is larger than its parts allow");
}

void vs_check_free(vs_kernel *k, vs_check *check) { VS_DROP(k, check->leaves); }
