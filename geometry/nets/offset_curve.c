/* Computes offset curves on a mesh (offset_curve.h).
 *
 * A walk goes straight over a triangle to an edge. The triangle on the other side of this edge is unfolded into the
 * same plane. The walk continues with the same components along the edge and across it (K. Polthier, M. Schmies,
 * Straightest geodesics on polyhedral surfaces, 1998). The ends of all walks, joined, are the offset curve. If the
 * distance exceeds the curve's radius of curvature, a part of the offset runs backwards, and the offset intersects
 * itself. The loop that ends at this intersection is cut off. */
#include "geometry/nets/offset_curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { MOST_TRIANGLES = 1000000 }; /* greatest number of triangles that one walk may cross */
#define BEYOND .01 /* points that are farther beyond a border of the mesh than this fraction of the offset distance are
                    * omitted */

/* ---- a straight walk over triangles ---- */

typedef struct {
  uint32_t triangle;
  vs_vec3 at, way; /* at: position of the walker; way: unit vector of its direction, in the plane of the triangle where
                    * it is */
} walker;

static vs_vec3 normal_of(const vs_mesh_edges *s, uint32_t t) {
  vs_vec3 a = vs_mesh_edges_place(s, t, 0), b = vs_mesh_edges_place(s, t, 1), c = vs_mesh_edges_place(s, t, 2);
  return vs_v3_unit(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)));
}

/* Returns the part of v perpendicular to the unit vector `along`. */
static vs_vec3 across(vs_vec3 v, vs_vec3 along) { return vs_v3_sub(v, vs_v3_scale(along, vs_v3_dot(v, along))); }

/* Returns the edge (0, 1 or 2) at which the walker leaves its triangle, or 3 if there is none. came: the edge at which
 * it entered, which is excluded. *far: distance to the edge along the walk. */
static int edge_ahead(const vs_mesh_edges *s, const walker *w, uint32_t came, double *far) {
  vs_vec3 up = normal_of(s, w->triangle);
  int best = 3;
  *far = INFINITY;
  for (int k = 0; k < 3; k++) {
    if (s->of[w->triangle][k] == came) continue;
    vs_vec3 a = vs_mesh_edges_place(s, w->triangle, (k + 1) % 3), b = vs_mesh_edges_place(s, w->triangle, (k + 2) % 3);
    vs_vec3 out = vs_v3_cross(vs_v3_sub(b, a), up);
    double speed = vs_v3_dot(w->way, out);
    if (!(speed > 0)) continue;
    double d = fmax(0, vs_v3_dot(vs_v3_sub(a, w->at), out) / speed);
    if (d < *far) *far = d, best = k;
  }
  return best;
}

/* Moves the walker across edge k (0, 1 or 2) of its triangle into the neighbouring triangle. *came: receives the number
 * of this edge in the neighbouring triangle. Returns false if the edge is a border. */
static bool cross_edge(const vs_mesh_edges *s, walker *w, int k, uint32_t *came) {
  uint32_t e = s->of[w->triangle][k];
  const vs_mesh_edge *edge = &s->edges[e];
  uint32_t next = edge->side[0] == w->triangle ? edge->side[1] : edge->side[0];
  VS_ASSERT(k >= 0 && k < 3);
  if (next == VS_MESH_NONE) return false;
  vs_vec3 a = s->m->vertices[edge->a], along = vs_v3_unit(vs_v3_sub(s->m->vertices[edge->b], a));
  double ahead = vs_v3_length(across(w->way, along));
  int third = 0;
  while (third < 2 && s->of[next][third] != e) third++;
  vs_vec3 into = across(vs_v3_sub(vs_mesh_edges_place(s, next, third), a), along);
  into = vs_v3_length(into) > 0 ? vs_v3_unit(into) : vs_v3_unit(across(w->way, along)); /* in a triangle without area,
                                                                                         * the direction across the edge
                                                                                         * is undefined, so the old
                                                                                         * direction is used */
  w->way = vs_v3_unit(vs_v3_add(vs_v3_scale(along, vs_v3_dot(w->way, along)), vs_v3_scale(into, ahead)));
  w->triangle = next, *came = e;
  return true;
}

/* Moves the walker straight ahead by the given length. Returns false at a border of the mesh. */
static bool walk(const vs_mesh_edges *s, walker *w, double length) {
  uint32_t came = VS_MESH_NONE;
  for (int i = 0; i < MOST_TRIANGLES; i++) {
    double far;
    int k = edge_ahead(s, w, came, &far);
    if (k == 3) return false;
    w->at = vs_v3_add(w->at, vs_v3_scale(w->way, fmin(far, length)));
    if (far >= length) return true;
    length -= far;
    if (!cross_edge(s, w, k, &came)) return false;
  }
  return false;
}

/* Returns true if p is more than `far` beyond a border of the mesh. place: the point of the mesh nearest to p, which
 * lies on triangle t. */
static bool beyond_border(const vs_mesh_edges *s, uint32_t t, vs_vec3 place, vs_vec3 p, double far) {
  if (vs_v3_length(vs_v3_sub(p, place)) <= far) return false;
  for (int k = 0; k < 3; k++) {
    if (s->edges[s->of[t][k]].side[1] != VS_MESH_NONE) continue;
    vs_vec3 a = vs_mesh_edges_place(s, t, (k + 1) % 3), b = vs_mesh_edges_place(s, t, (k + 2) % 3);
    if (vs_v3_length(across(vs_v3_sub(place, a), vs_v3_unit(vs_v3_sub(b, a)))) <= 1e-9 * far) return true;
  }
  return false;
}

/* ---- loops of the offset ---- */

typedef struct {
  vs_vec3 at, tangent, up; /* at: end of a walk; tangent: direction of the original curve, carried along the walk; up:
                            * normal of the mesh at the end */
  bool there;
} reached;

typedef struct {
  reached *at;
  size_t count; /* number of points of a run; a run is a part of the offset curve without a gap */
  bool closed;
} run;

static size_t after(const run *r, size_t i) { return i + 1 < r->count ? i + 1 : 0; }
/* Returns true if segment i of the run goes against the direction of the original curve. */
static bool goes_back(const run *r, size_t i) {
  VS_ASSERT(i < r->count);
  return vs_v3_dot(vs_v3_sub(r->at[after(r, i)].at, r->at[i].at), r->at[i].tangent) < 0;
}

/* Returns true if segments i and j of the run (part of the offset curve) intersect as seen along the mesh's normal, and
 * are near each other. *place: their intersection. */
static bool cross_at(const run *r, size_t i, size_t j, vs_vec3 *place) {
  vs_vec3 p = r->at[i].at, u = vs_v3_sub(r->at[after(r, i)].at, p), q = r->at[j].at;
  vs_vec3 v = vs_v3_sub(r->at[after(r, j)].at, q), up = r->at[i].up, d = vs_v3_sub(q, p);
  double whole = vs_v3_dot(vs_v3_cross(u, v), up);
  if (whole == 0) return false;
  double a = vs_v3_dot(vs_v3_cross(d, v), up) / whole, b = vs_v3_dot(vs_v3_cross(d, u), up) / whole;
  if (!(a >= 0 && a <= 1 && b >= 0 && b <= 1)) return false;
  vs_vec3 on_u = vs_v3_add(p, vs_v3_scale(u, a)), on_v = vs_v3_add(q, vs_v3_scale(v, b));
  if (vs_v3_length(vs_v3_sub(on_u, on_v)) > .5 * (vs_v3_length(u) + vs_v3_length(v))) return false;
  *place = vs_v3_scale(vs_v3_add(on_u, on_v), .5);
  return true;
}

/* Returns the number of segments of the run between i and j that go against the direction of the original curve. */
static size_t backward(const run *r, size_t i, size_t j) {
  size_t n = 0;
  for (size_t k = after(r, i); k != j; k = after(r, k)) n += goes_back(r, k);
  return n;
}

/* Cuts off the loop between the intersecting segments i and j of the run: the points after i up to j are replaced by
 * the point `place`. */
static void cut_loop(run *r, size_t i, size_t j, vs_vec3 place) {
  size_t n = 0, stop = after(r, j);
  reached corner = r->at[i];
  VS_ASSERT(i < r->count && j < r->count);
  corner.at = place;
  if (i < j) { /* the points that are cut off do not include the end of the array */
    r->at[i + 1] = corner;
    memmove(r->at + i + 2, r->at + j + 1, (r->count - j - 1) * sizeof *r->at);
    r->count -= j - i - 1;
    return;
  }
  for (size_t k = stop; k <= i; k++) r->at[n++] = r->at[k]; /* the points that are cut off include the end of the
                                                             * array */
  r->at[n++] = corner;
  r->count = n;
}

/* Cuts off every loop of the run (part of the offset curve) that contains a backward segment and is shorter than the
 * rest. Returns false if interrupted. */
static bool cut_loops(run *r, vs_poller poll) {
  size_t segments = r->closed ? r->count : r->count - 1;
  for (size_t i = 0; i + 2 < segments; i++) {
    if (!poll.ask(poll.context)) return false;
    for (size_t j = i + 2; j < segments; j++) {
      if (r->closed && after(r, j) == i) continue;
      vs_vec3 place;
      if (!cross_at(r, i, j, &place)) continue;
      bool inner = 2 * (j - i) <= r->count || !r->closed;
      if (!backward(r, inner ? i : j, inner ? j : i)) continue;
      cut_loop(r, inner ? i : j, inner ? j : i, place);
      segments = r->closed ? r->count : r->count - 1;
      i = i > 1 ? i - 2 : 0, j = segments;
    }
  }
  return true;
}

/* ---- the offset curve ---- */

static bool put_run(run *r, vs_offset_points *out, vs_poller poll) {
  if (r->count < 2) return true;
  if (!cut_loops(r, poll)) return false;
  size_t back = 0, segments = r->closed ? r->count : r->count - 1;
  for (size_t i = 0; i < segments; i++) back += goes_back(r, i);
  if (2 * back > segments) return true; /* If most segments go backwards, the distance exceeds the curve's radius of
                                         * curvature everywhere, and no offset remains. */
  if (!VS_GROW(out->at, out->room, out->count + r->count + 1)) return false;
  for (size_t i = 0; i < r->count; i++) out->at[out->count++] = (vs_offset_point){ r->at[i].at, i == 0 };
  if (r->closed) out->at[out->count++] = (vs_offset_point){ r->at[0].at, false };
  return true;
}

bool vs_mesh_offset_curve(const vs_mesh_edges *s, const vs_offset_row *from, double distance, vs_poller poll,
                          vs_offset_points *out) {
  reached *ends = NULL;
  size_t count = from->count, room = 0, gap = count;
  bool closed = from->closed;
  *out = (vs_offset_points){ 0 };
  bool ok = VS_GROW(ends, room, 2 * count + 1);
  for (size_t i = 0; ok && i < count; i++) {
    walker w = { 0 };
    w.triangle = vs_mesh_edges_nearest(s, from->at[i].at, &w.at);
    vs_vec3 up = normal_of(s, w.triangle), left = vs_v3_cross(up, from->at[i].tangent);
    double side = distance < 0 ? -1 : 1;
    ends[i].there = vs_v3_length(left) > 1e-9 &&
                    !beyond_border(s, w.triangle, w.at, from->at[i].at, BEYOND * fabs(distance));
    w.way = vs_v3_unit(vs_v3_scale(left, side));
    if (ends[i].there) ends[i].there = walk(s, &w, fabs(distance));
    up = normal_of(s, w.triangle);
    ends[i].at = w.at, ends[i].up = up, ends[i].tangent = vs_v3_cross(vs_v3_scale(w.way, side), up);
    if (!ends[i].there) gap = i;
    ok = poll.ask(poll.context);
  }
  if (ok && closed && gap == count) {
    run whole = { ends, count, true };
    ok = put_run(&whole, out, poll);
  } else if (ok) {
    /* A closed curve begins at a gap, so that no part without a gap continues across the end of the array. */
    size_t first = closed ? gap : 0;
    memcpy(ends + count, ends, count * sizeof *ends);
    for (size_t i = 0; ok && i < count;) {
      size_t n = 0;
      while (i + n < count && ends[first + i + n].there) n++;
      run part = { ends + first + i, n, false };
      ok = put_run(&part, out, poll);
      i += n ? n : 1;
    }
  }
  free(ends);
  return ok;
}
