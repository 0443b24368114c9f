/* Makes outlines of loops: finds the loops' common plane, and which loops are holes. */
#include "geometry/plane/outline.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "model/store/array.h"

void vs_polyline_free(vs_polyline *p) {
  free(p->at);
  *p = (vs_polyline){ 0 };
}

void vs_outline_free(vs_outline *o) {
  for (size_t i = 0; i < o->count; i++) vs_polyline_free(&o->loops[i]);
  free(o->loops);
  free(o->hole);
  *o = (vs_outline){ 0 };
}

/* Returns the normal vector of a polygon, with twice the polygon's area as length (Newell). */
static vs_vec3 polyline_area(const vs_polyline *p) {
  vs_vec3 sum = { 0, 0, 0 };
  for (size_t i = 1; i + 1 < p->count; i++)
    sum = vs_v3_add(sum, vs_v3_cross(vs_v3_sub(p->at[i], p->at[0]), vs_v3_sub(p->at[i + 1], p->at[0])));
  return sum;
}

static void polyline_turn(vs_polyline *p) {
  for (size_t i = 0, j = p->count; i < j; i++) {
    vs_vec3 swap = p->at[i];
    p->at[i] = p->at[--j];
    p->at[j] = swap;
  }
}

static bool outline_loop_holds(const vs_affine *frame, const vs_polyline *p, vs_vec3 at) {
  bool inside = false;
  vs_vec3 x = { frame->m[0][0], frame->m[1][0], frame->m[2][0] },
          y = { frame->m[0][1], frame->m[1][1], frame->m[2][1] };
  double u = vs_v3_dot(at, x), v = vs_v3_dot(at, y);
  for (size_t i = 0; i < p->count; i++) {
    vs_vec3 a = p->at[i], b = p->at[i + 1 < p->count ? i + 1 : 0];
    double au = vs_v3_dot(a, x), av = vs_v3_dot(a, y), bu = vs_v3_dot(b, x), bv = vs_v3_dot(b, y);
    if ((av > v) != (bv > v) && u < au + (v - av) / (bv - av) * (bu - au)) inside = !inside;
  }
  return inside;
}

typedef struct { double low[2], high[2]; } vs_loop_box; /* bounding box of a loop in the coordinates of the outline's
                                                         * plane */

static vs_loop_box outline_box(const vs_affine *frame, const vs_polyline *p) {
  vs_loop_box b = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
  for (int k = 0; k < 2; k++) {
    vs_vec3 x = { frame->m[0][k], frame->m[1][k], frame->m[2][k] };
    for (size_t i = 0; i < p->count; i++) {
      double u = vs_v3_dot(p->at[i], x);
      b.low[k] = fmin(b.low[k], u);
      b.high[k] = fmax(b.high[k], u);
    }
  }
  return b;
}

static bool outline_apart(const vs_loop_box *a, const vs_loop_box *b) {
  return a->high[0] < b->low[0] || b->high[0] < a->low[0] || a->high[1] < b->low[1] || b->high[1] < a->low[1];
}

/* Returns true if loop p contains loop q. The loops do not cross but may touch. Therefore the majority of the midpoints
 * of q's edges decides; about thirty of them are tested. */
static bool outline_loop_in(const vs_affine *frame, const vs_polyline *p, const vs_polyline *q) {
  size_t step = q->count / 30 + 1, votes = 0, asked = 0;
  for (size_t i = 0; i < q->count; i += step, asked++)
    votes += outline_loop_holds(frame, p, vs_v3_scale(vs_v3_add(q->at[i], q->at[i + 1 < q->count ? i + 1 : 0]), 0.5));
  return 2 * votes > asked;
}

/* Returns the normal of the plane of an open profile. A straight profile lies in many planes: uses the vertical plane
 * through it, or the plane XZ if the profile itself is vertical. */
static vs_vec3 outline_normal_of_open(const vs_polyline *p) {
  vs_vec3 sum = { 0, 0, 0 }, along = { 0, 0, 0 };
  double length = 0;
  for (size_t i = 1; i < p->count; i++) {
    vs_vec3 d = vs_v3_sub(p->at[i], p->at[0]);
    length += vs_v3_length(vs_v3_sub(p->at[i], p->at[i - 1]));
    if (vs_v3_dot(d, d) > vs_v3_dot(along, along)) along = d;
  }
  sum = polyline_area(p);
  if (vs_v3_length(sum) > 1e-9 * length * length) return sum;
  vs_vec3 across = vs_v3_cross(along, vs_v3(0, 0, 1));
  return vs_v3_length(across) > 1e-12 * length ? across : vs_v3(0, 1, 0);
}

/* Orders the loops of o: each outer loop is followed by its holes. depth[i]: number of loops that contain loop i. If it
 * is odd, loop i is a hole of the smallest outer loop around it. */
static bool outline_nest(vs_outline *o) {
  size_t n = o->count, done = 0;
  size_t *depth = vs_zeros(n, sizeof *depth), *parent = vs_fresh(n, sizeof *parent);
  vs_polyline *sorted = vs_fresh(n, sizeof *sorted);
  vs_loop_box *box = vs_fresh(n, sizeof *box); /* bounding boxes of the loops, for a quick test: in a perforated sheet,
                                                * most pairs of loops do not overlap */
  o->hole = vs_zeros(n, sizeof *o->hole);
  bool ok = depth && parent && sorted && box && o->hole;
  for (size_t i = 0; ok && i < n; i++) box[i] = outline_box(&o->frame, &o->loops[i]);
  for (size_t i = 0; ok && i < n; i++)
    for (size_t j = 0; j < n; j++)
      depth[i] += i != j && !outline_apart(&box[i], &box[j]) && outline_loop_in(&o->frame, &o->loops[j], &o->loops[i]);
  for (size_t i = 0; ok && i < n; i++) {
    parent[i] = i;
    for (size_t j = 0; j < n && depth[i] % 2; j++)
      if (depth[j] + 1 == depth[i] && !outline_apart(&box[i], &box[j]) &&
          outline_loop_in(&o->frame, &o->loops[j], &o->loops[i]))
        parent[i] = j;
  }
  for (size_t i = 0; ok && i < n; i++) {
    if (depth[i] % 2) continue;
    for (size_t k = 0; k <= n; k++) { /* appends the outer loop itself (k = 0), then its holes */
      size_t j = k ? k - 1 : i;
      if (k && (parent[j] != i || !(depth[j] % 2))) continue;
      bool hole = k > 0, clockwise = vs_v3_dot(polyline_area(&o->loops[j]), o->normal) < 0;
      if (o->loops[j].closed && hole != clockwise) polyline_turn(&o->loops[j]);
      o->hole[done] = hole;
      sorted[done++] = o->loops[j];
    }
  }
  if (ok) { /* every hole has an outer loop, so the new order contains all loops */
    free(o->loops);
    o->loops = sorted;
    sorted = NULL;
  }
  free(depth);
  free(parent);
  free(sorted);
  free(box);
  return ok;
}

bool vs_outline_plane(vs_outline *o, vs_error *e) {
  vs_vec3 most = { 0, 0, 0 };
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < o->count; i++) {
    vs_vec3 area = o->loops[i].closed ? polyline_area(&o->loops[i]) : outline_normal_of_open(&o->loops[i]);
    if (vs_v3_dot(area, area) > vs_v3_dot(most, most)) most = area;
    for (size_t k = 0; k < o->loops[i].count; k++) vs_bounds_add(&b, o->loops[i].at[k]);
  }
  double size = vs_bounds_diagonal(&b), off = 0;
  if (!(vs_v3_length(most) > 1e-14 * size * size))
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "the curve encloses no area");
  o->normal = vs_plane_up(most);
  o->point = o->loops[0].at[0];
  o->frame = vs_frame_on_axis(vs_v3_scale(o->normal, vs_v3_dot(o->normal, o->point)), o->normal);
  for (size_t i = 0; i < o->count; i++)
    for (size_t k = 0; k < o->loops[i].count; k++)
      off = fmax(off, fabs(vs_v3_dot(o->normal, vs_v3_sub(o->loops[i].at[k], o->point))));
  if (off > 1e-6 * size)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "the curve must lie in one plane, and deviates from a plane by %.6g",
                        off);
  return true;
}

void vs_outline_orient(vs_outline *o) {
  for (size_t i = 0; i < o->count; i++)
    if (o->hole[i] != (vs_v3_dot(polyline_area(&o->loops[i]), o->normal) < 0)) polyline_turn(&o->loops[i]);
}

bool vs_outline_of_loops(vs_polyline *loops, size_t count, vs_outline *out, vs_error *e) {
  *out = (vs_outline){ 0 };
  out->loops = vs_zeros(count, sizeof *out->loops);
  bool ok = out->loops || vs_error_memory(e, NULL);
  for (size_t i = 0; ok && i < count; i++) {
    out->loops[out->count++] = loops[i];
    loops[i] = (vs_polyline){ 0 };
  }
  for (size_t i = 0; i < count; i++) vs_polyline_free(&loops[i]);
  ok = ok && vs_outline_plane(out, e) && (outline_nest(out) || vs_error_memory(e, NULL));
  if (!ok) vs_outline_free(out);
  return ok;
}

double vs_outline_measure(const vs_outline *o, vs_vec3 *centroid) {
  double total = 0;
  vs_vec3 sum = { 0, 0, 0 }, ref = o->count ? o->loops[0].at[0] : o->point;
  for (size_t l = 0; l < o->count; l++) {
    const vs_polyline *p = &o->loops[l];
    for (size_t i = 0; i + (p->closed ? 0 : 1) < p->count; i++) {
      vs_vec3 a = vs_v3_sub(p->at[i], ref), b = vs_v3_sub(p->at[i + 1 < p->count ? i + 1 : 0], ref);
      double w = p->closed ? vs_v3_dot(vs_v3_cross(a, b), o->normal) / 2 : vs_v3_length(vs_v3_sub(b, a));
      total += w;
      sum = vs_v3_add(sum, vs_v3_scale(vs_v3_add(a, b), w / (p->closed ? 3 : 2)));
    }
  }
  if (centroid) *centroid = total != 0 ? vs_v3_add(ref, vs_v3_scale(sum, 1 / total)) : ref;
  return total;
}
