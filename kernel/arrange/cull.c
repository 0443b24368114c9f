/* Removes triangles and cuts that lie well inside settled space, before anything is cut.
 *
 * A lid is a convex leaf whose inside is settled: an operand of a union, or a hole of a difference. The grid moves
 * every corner by less than one step. If all corners of a triangle are more than two steps inside a lid, the triangle
 * is also inside on the grid. The same holds for triangles outside of a box around a gate, a term outside of which the
 * result is false. This removes most of an operand that is far larger than the result. Pairs of patches are found by
 * their boxes. These contain only the parts outside of lids: the box of a rod that ends in two joints only contains the
 * part between the joints. */
#include "kernel/arrange/cull.h"

#include "kernel/cluster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(uint32_t) pairs; /* pairs of numbers: the index of a leaf, and the index of a lid (a convex leaf whose inside
                            * is decided) near it */
} finding;

static bool note(void *context, uint32_t a, uint32_t b) {
  finding *f = context;
  const vs_placed *p = &f->c->placed.at[a], *q = &f->c->placed.at[b];
  if (!vs_kernel_poll(f->k, 0)) return false;
  if (p->lid && q->lid) { /* Leaf and lid are convex. Therefore the lid counts as near only if the boxes and the
                           * inscribed balls of the two intersect. */
    double x = p->middle[0] - q->middle[0], y = p->middle[1] - q->middle[1], z = p->middle[2] - q->middle[2];
    if (sqrt(x * x + y * y + z * z) > sqrt(p->outside) + sqrt(q->outside)) return true;
  }
  if (q->lid && (!VS_PUSH(f->k, f->pairs, a) || !VS_PUSH(f->k, f->pairs, b))) return false;
  return !p->lid || (VS_PUSH(f->k, f->pairs, b) && VS_PUSH(f->k, f->pairs, a));
}

static double box_size(const vs_bvh_box *b) {
  return ((double)b->max[0] - b->min[0]) * ((double)b->max[1] - b->min[1]) * ((double)b->max[2] - b->min[2]);
}

/* Sets p->to_local, the map from grid steps to the coordinates of the leaf's mesh, and p->margin, the length of two
 * grid steps there. Returns false if the placement cannot be inverted because it is flat. */
static bool find_local(const vs_grid *g, const vs_affine *to_frame, vs_placed *p) {
  double step = g->unit / g->scale, sum = 0;
  vs_affine inverse;
  if (!vs_affine_invert(to_frame, &inverse)) return false;
  for (int i = 0; i < 3; i++) {
    p->to_local.m[i][3] = inverse.m[i][3];
    for (int j = 0; j < 3; j++) {
      p->to_local.m[i][j] = inverse.m[i][j] * step;
      p->to_local.m[i][3] += inverse.m[i][j] * g->offset[j] * step;
      sum += inverse.m[i][j] * inverse.m[i][j];
    }
  }
  p->margin = 2 * step * sqrt(sum);
  vs_vec3 middle = vs_affine_point(to_frame, p->part->middle);
  /* If the placement scales equally in all directions, a single factor converts grid steps to lengths. */
  double x[3] = { middle.x, middle.y, middle.z }, scale = sqrt(sum / 3) * step;
  bool similar = true;
  for (int i = 0; i < 3; i++) {
    p->middle[i] = x[i] / step - g->offset[i];
    for (int j = i; j < 3; j++) {
      double dot = 0;
      for (int r = 0; r < 3; r++) dot += inverse.m[r][i] * inverse.m[r][j];
      similar = similar && fabs(dot - (i == j ? sum / 3 : 0)) < 1e-9 * sum;
    }
  }
  double inner = (p->part->inner - p->margin) / scale * (1 - 1e-6), outer = p->part->outer / scale * (1 + 1e-6) + 1;
  p->well_inside = similar && inner > 0 ? inner * inner : -1;
  p->outside = similar ? outer * outer : INFINITY;
  return isfinite(p->margin);
}

bool vs_cull_prepare(vs_kernel *k, vs_cluster *c, const vs_affine *to_frame) {
  finding f = { .k = k, .c = c };
  uint32_t n = c->leaf_count;
  if (!VS_ROOM(k, c->leaf_boxes.at, c->leaf_boxes.room, (size_t)n + 1)) return false;
  bool any = false;
  for (uint32_t i = 0; i < n; i++) {
    vs_placed *p = &c->placed.at[i];
    c->leaf_boxes.at[i] = p->box;
    p->lid = n > 1 && c->expression->forces.at[c->leaves[i]] && p->part->convex && p->part->volume > 0 &&
             find_local(&c->grid, &to_frame[i], p);
    any = any || p->lid;
    p->lids_count = 0;
    if (!vs_kernel_poll(k, 0)) return false;
  }
  if (!vs_bvh_build(k, &c->leaf_bvh, c->leaf_boxes.at, n)) return false;
  if (!any) return true;
  bool ok = vs_bvh_pairs(k, &c->leaf_bvh, 0, UINT32_MAX, note, &f);
  for (size_t i = 0; ok && i < f.pairs.count; i += 2) c->placed.at[f.pairs.at[i]].lids_count++;
  size_t sum = 0;
  for (uint32_t i = 0; ok && i < n; i++) {
    vs_placed *p = &c->placed.at[i];
    p->lids_first = (uint32_t)sum;
    sum += p->lids_count < VS_LIDS ? (p->lids_count + 3) / 4 * 4 : VS_LIDS; /* The boxes of the lids (convex leaves
                                                                             * whose inside is decided) near a leaf are
                                                                             * stored in packs of four. */
    p->lids_count = 0;
  }
  ok = ok && VS_ROOM(k, c->lids.at, c->lids.room, sum + 1) &&
       VS_ROOM(k, c->lid_boxes.at, c->lid_boxes.room, sum / 4 + 1);
  for (size_t i = 0; ok && i < f.pairs.count; i += 2) { /* keeps the largest lids (convex leaves whose inside is
                                                         * decided) near each leaf, in descending order of size, then in
                                                         * order of index */
    vs_placed *p = &c->placed.at[f.pairs.at[i]];
    uint32_t lid = f.pairs.at[i + 1], *list = c->lids.at + p->lids_first, at = p->lids_count;
    double size = box_size(&c->placed.at[lid].box);
    if (p->lids_count < VS_LIDS) p->lids_count++;
    else at = VS_LIDS;
    for (; at > 0; at--) {
      double other = box_size(&c->placed.at[list[at - 1]].box);
      if (other > size || (!(other < size) && list[at - 1] < lid)) break;
      if (at < VS_LIDS) list[at] = list[at - 1];
    }
    if (at < VS_LIDS) list[at] = lid;
    ok = vs_kernel_poll(k, 0);
  }
  for (uint32_t i = 0; ok && i < n; i++) {
    ok = vs_kernel_poll(k, 0);
    const vs_placed *p = &c->placed.at[i];
    for (uint32_t j = 0; j < (p->lids_count + 3) / 4 * 4; j++) {
      uint32_t at = p->lids_first + j;
      vs_pack_put(&c->lid_boxes.at[at / 4], at % 4,
                  j < p->lids_count ? &c->placed.at[c->lids.at[at]].box : &vs_box_nowhere);
    }
  }
  VS_DROP(k, f.pairs);
  return ok;
}

/* Computes the box outside of which the result is empty, in grid steps and enlarged by two steps. Returns false if the
 * expression has no such box. */
static bool gate_box(const vs_cluster *c, double low[3], double high[3]) {
  if (!c->gate) return false;
  double step = c->grid.unit / c->grid.scale;
  vs_bounds b = *c->gate;
  if (c->grid.framed) {
    vs_affine back;
    if (!vs_affine_invert(&c->grid.frame, &back)) return false;
    b = vs_bounds_transform(&b, &back);
  }
  double x[3] = { b.min.x, b.min.y, b.min.z }, y[3] = { b.max.x, b.max.y, b.max.z };
  for (int a = 0; a < 3; a++) {
    low[a] = x[a] / step - c->grid.offset[a] - 4;
    high[a] = y[a] / step - c->grid.offset[a] + 4;
  }
  return true;
}

static bool in_box(const vs_bvh_box *b, const double p[3]) {
  return p[0] > b->min[0] && p[0] < b->max[0] && p[1] > b->min[1] && p[1] < b->max[1] && p[2] > b->min[2] &&
         p[2] < b->max[2];
}

/* Returns true if point p is more than two grid steps inside the convex leaf `lid`. square: squared distance of p from
 * the leaf's middle. */
static bool in_lid_at(const vs_placed *lid, double square, const double p[3]) {
  if (square > lid->outside) return false;
  if (square < lid->well_inside) return true;
  return in_box(&lid->box, p) &&
         vs_part_holds(lid->part, vs_affine_point(&lid->to_local, vs_v3(p[0], p[1], p[2])), lid->margin);
}

static bool in_lid(const vs_placed *lid, const double p[3]) {
  double x = p[0] - lid->middle[0], y = p[1] - lid->middle[1], z = p[2] - lid->middle[2];
  return in_lid_at(lid, x * x + y * y + z * z, p);
}

bool vs_cull_needed(const vs_cluster *c, uint32_t place) {
  const vs_placed *p = &c->placed.at[place];
  double low[3], high[3];
  if (c->layered && c->layered[c->leaves[place]]) return false; /* While solids are united level by level, the leaf that
                                                                 * contains this one may belong to another level.
                                                                 * Therefore nothing is removed. */
  if (p->lids_count) return true;
  bool out = false;
  if (gate_box(c, low, high)) /* a leaf that lies entirely in the box outside of which the result is empty keeps all its
                               * triangles */
    for (int a = 0; a < 3; a++) out = out || p->box.min[a] < low[a] || p->box.max[a] > high[a];
  return out;
}

bool vs_cull_vertices(vs_kernel *k, const vs_cluster *c, uint32_t place, size_t begin, size_t end, uint64_t *masks) {
  const vs_placed *p = &c->placed.at[place];
  double low[3], high[3];
  bool gated = gate_box(c, low, high);
  enum { BLOCK = 64 };
  double x[3][BLOCK], square[BLOCK];
  VS_ASSERT(begin <= end && place < c->leaf_count);
  masks += begin;
  for (; begin < end; begin += BLOCK, masks += BLOCK) {
    size_t n = end - begin < BLOCK ? end - begin : BLOCK;
    for (size_t v = 0; v < n; v++) {
      masks[v] = 0;
      for (int a = 0; a < 3; a++) {
        x[a][v] = c->corners[p->first + begin + v][a];
        if (gated && x[a][v] < low[a]) masks[v] |= (uint64_t)1 << (VS_LIDS + 2 * a);
        if (gated && x[a][v] > high[a]) masks[v] |= (uint64_t)1 << (VS_LIDS + 2 * a + 1);
      }
    }
    for (size_t v = n; v < BLOCK; v++) x[0][v] = x[1][v] = x[2][v] = 0;
    for (uint32_t i = 0; i < p->lids_count; i++) {
      const vs_placed *lid = &c->placed.at[c->lids.at[p->lids_first + i]];
      double mx = lid->middle[0], my = lid->middle[1], mz = lid->middle[2];
      for (size_t v = 0; v < BLOCK; v++) { /* computes all elements of the block, so that the compiler can use vector
                                            * instructions */
        double dx = x[0][v] - mx, dy = x[1][v] - my, dz = x[2][v] - mz;
        square[v] = dx * dx + dy * dy + dz * dz;
      }
      for (size_t v = 0; v < n; v++)
        if (square[v] <= lid->outside && in_lid_at(lid, square[v], (const double[3]){ x[0][v], x[1][v], x[2][v] }))
          masks[v] |= (uint64_t)1 << i;
    }
    if (!vs_kernel_report(k, 0)) return false;
  }
  return true;
}

bool vs_cull_point(const vs_cluster *c, uint32_t place, const double p[3]) {
  const vs_placed *leaf = &c->placed.at[place];
  for (uint32_t i = 0; i < leaf->lids_count; i++)
    if (in_lid(&c->placed.at[c->lids.at[leaf->lids_first + i]], p)) return true;
  return false;
}

bool vs_cull_segment(const vs_cluster *c, uint32_t place, uint32_t other, const double p[3], const double q[3]) {
  const vs_placed *leaf = &c->placed.at[place];
  vs_bvh_box box; /* a point two grid steps inside a leaf is at least one step inside the leaf's box */
  for (int a = 0; a < 3 && leaf->lids_count; a++)
    box.min[a] = (int32_t)floor(p[a] < q[a] ? p[a] : q[a]), box.max[a] = (int32_t)ceil(p[a] > q[a] ? p[a] : q[a]);
  for (uint32_t i = 0; i < leaf->lids_count; i += 4)
    for (uint32_t set = vs_pack_bits(vs_pack_holding(&c->lid_boxes.at[(leaf->lids_first + i) / 4], &box)); set;
         set &= set - 1) {
      uint32_t lid = c->lids.at[leaf->lids_first + i + (uint32_t)__builtin_ctz(set)];
      const vs_placed *l = &c->placed.at[lid];
      if (lid != other && in_lid(l, p) && in_lid(l, q)) return true;
    }
  return false;
}

/* Removes a ball around the lid's middle from a convex outline of n corners. Replaces the outline by points on its
 * edges whose convex hull contains the remaining part. Returns the number of these points; 0 if nothing remains or
 * rounding errors prevent a decision. */
static uint32_t clip_outline(const vs_placed *lid, double radius, double (*at)[3], uint32_t n, uint32_t room) {
  /* SURELY: fraction by which the ball's squared radius is reduced, more than all rounding errors; FAR: greatest ratio
   * of a corner's squared distance to the squared radius for which this holds */
  static const double SURELY = 1e-6, FAR = 1e6;
  double (*out)[3] = at + room; /* the result uses the second half of the caller's array */
  uint32_t count = 0;
  VS_ASSERT(n <= room);
  for (uint32_t i = 0; i < n; i++) {
    const double *p = at[i], *q = at[i + 1 == n ? 0 : i + 1];
    vs_vec3 d = vs_v3_sub(vs_affine_point(&lid->to_local, vs_v3(p[0], p[1], p[2])), lid->part->middle);
    vs_vec3 e = vs_affine_vector(&lid->to_local, vs_v3(q[0] - p[0], q[1] - p[1], q[2] - p[2]));
    double a = vs_v3_dot(e, e), b = vs_v3_dot(d, e), c = vs_v3_dot(d, d) - radius * radius, square = b * b - a * c,
           from = 1, to = 1;
    if (square > 0 && a > 0) from = (-b - sqrt(square)) / a, to = (-b + sqrt(square)) / a;
    if (to <= 0) from = to = 1;
    if (count + 3 > room || c > FAR * radius * radius) return 0;
    if (c > -SURELY * radius * radius) out[count][0] = p[0], out[count][1] = p[1], out[count++][2] = p[2];
    for (int end = 0; end < 2; end++) {
      double t = end ? to : from;
      if (t <= 0 || t >= 1) continue;
      for (int x = 0; x < 3; x++) out[count][x] = p[x] + t * (q[x] - p[x]);
      count++;
    }
  }
  memcpy(at, out, count * sizeof *at);
  return count;
}

void vs_cull_box(const vs_cluster *c, uint32_t place, const vs_patch_corner *corners, uint32_t count, vs_bvh_box *box) {
  enum { ROOM = 48 };
  const vs_placed *leaf = &c->placed.at[place];
  double at[2 * ROOM][3];
  bool begun = false;
  for (uint32_t i = 0; count <= ROOM / 2 && i < leaf->lids_count; i++) {
    const vs_placed *lid = &c->placed.at[c->lids.at[leaf->lids_first + i]];
    double radius = (lid->part->inner - lid->margin) * (1 - 1e-9), size = 0, other = 0;
    if (!(radius > 0) || !vs_box_meet(&lid->box, box)) continue;
    for (int a = 0; a < 3; a++) {
      size = fmax(size, (double)box->max[a] - box->min[a]);
      other = fmax(other, (double)lid->box.max[a] - lid->box.min[a]);
    }
    if (size < other / 2) continue; /* the box of the patch is less than half as large as the box of the lid (convex
                                     * leaf), so a smaller box would save little work */
    for (uint32_t j = 0; !begun && j < count; j++)
      for (int a = 0; a < 3; a++) at[j][a] = corners[j].at[a];
    begun = true;
    uint32_t left = clip_outline(lid, radius, at, count, ROOM);
    if (!left) return;
    count = left;
    for (int a = 0; a < 3; a++) {
      double low = INFINITY, high = -INFINITY;
      for (uint32_t j = 0; j < count; j++) low = fmin(low, at[j][a]), high = fmax(high, at[j][a]);
      if (floor(low) - 1 > box->min[a]) box->min[a] = (int32_t)floor(low) - 1;
      if (ceil(high) + 1 < box->max[a]) box->max[a] = (int32_t)ceil(high) + 1;
    }
  }
}
