/* Cuts curves, regions and surfaces by a plane. The point where an edge crosses the plane is always computed from the
 * end that is kept. Therefore both triangles at the edge get the same point. */
#include "geometry/plane/slice.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "model/store/array.h"

/* Returns the point where an edge crosses the plane. The kept end is at height a >= 0 above the plane, the removed end
 * at height b < 0. */
static vs_vec3 slice_crossing(vs_vec3 kept, double a, vs_vec3 lost, double b) {
  VS_ASSERT(a >= 0 && b < 0);
  return vs_v3_add(kept, vs_v3_scale(vs_v3_sub(lost, kept), a / (a - b)));
}

/* Returns the height of a point above the plane; 0 if its absolute value is at most `nothing`, the rounding error. */
static double slice_side(vs_vec3 p, vs_vec3 point, vs_vec3 normal, double nothing) {
  double d = vs_v3_dot(normal, vs_v3_sub(p, point));
  return fabs(d) <= nothing ? 0 : d;
}

static bool slice_flush(vs_polyline *piece, bool (*put)(void *context, const vs_polyline *piece), void *context) {
  bool ok = piece->count < 2 || put(context, piece);
  piece->count = 0;
  return ok;
}

bool vs_slice_polyline(const vs_polyline *p, vs_vec3 point, vs_vec3 normal,
                       bool (*put)(void *context, const vs_polyline *piece), void *context) {
  if (!p->count) return true;
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < p->count; i++) vs_bounds_add(&b, p->at[i]);
  double nothing = 1e-13 * vs_bounds_diagonal(&b);
  size_t outside = p->count; /* for a closed line, begins at a point on the removed side, so that no piece continues
                              * across the line's start */
  for (size_t i = p->count; i-- > 0;)
    if (slice_side(p->at[i], point, normal, nothing) < 0) outside = i;
  if (outside == p->count) return put(context, p);
  vs_polyline piece = { .at = vs_fresh(p->count + 3, sizeof *piece.at) };
  bool ok = piece.at != NULL;
  size_t start = p->closed ? outside : 0, steps = p->closed ? p->count : p->count - 1;
  double d = slice_side(p->at[start], point, normal, nothing);
  if (ok && d >= 0) piece.at[piece.count++] = p->at[start];
  for (size_t i = 0; ok && i < steps; i++) {
    vs_vec3 from = p->at[(start + i) % p->count], to = p->at[(start + i + 1) % p->count];
    double e = slice_side(to, point, normal, nothing);
    if (d < 0 && e > 0) piece.at[piece.count++] = slice_crossing(to, e, from, d);
    if (e >= 0) piece.at[piece.count++] = to;
    if (d > 0 && e < 0) piece.at[piece.count++] = slice_crossing(from, d, to, e);
    if (e < 0) ok = slice_flush(&piece, put, context);
    d = e;
  }
  ok = ok && slice_flush(&piece, put, context);
  free(piece.at);
  return ok;
}

bool vs_slice_mesh(const vs_mesh *m, vs_vec3 point, vs_vec3 normal, vs_mesh *out) {
  vs_bounds b = vs_mesh_bounds(m);
  double nothing = 1e-13 * vs_bounds_diagonal(&b);
  uint32_t *place = vs_fresh(m->vertex_count + 1, sizeof *place);
  bool ok = place != NULL;
  for (size_t i = 0; ok && i < m->vertex_count; i++) place[i] = UINT32_MAX;
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    uint32_t ring[4];
    int n = 0;
    for (int k = 0; ok && k < 3; k++) {
      uint32_t v = m->triangles[t][k], w = m->triangles[t][(k + 1) % 3];
      double d = slice_side(m->vertices[v], point, normal, nothing),
             e = slice_side(m->vertices[w], point, normal, nothing);
      if (d >= 0) {
        if (place[v] == UINT32_MAX) ok = vs_mesh_add_vertex(out, m->vertices[v], &place[v]);
        ring[n++] = place[v];
      }
      if (ok && ((d > 0 && e < 0) || (d < 0 && e > 0)))
        ok = vs_mesh_add_vertex(out,
                                d > 0 ? slice_crossing(m->vertices[v], d, m->vertices[w], e)
                                      : slice_crossing(m->vertices[w], e, m->vertices[v], d),
                                &ring[n++]);
    }
    for (int k = 1; ok && k + 1 < n; k++) ok = vs_mesh_add_triangle(out, ring[0], ring[k], ring[k + 1]);
  }
  free(place);
  return ok;
}

vs_node *vs_slice_region(vs_ref region, const vs_shape_plane *flat, const vs_bounds *b, vs_vec3 point, vs_vec3 normal) {
  vs_store *s = region.node->store;
  vs_vec3 middle = vs_v3_scale(vs_v3_add(b->min, b->max), 0.5), n = vs_v3_unit(normal), f = vs_v3_unit(flat->normal);
  middle = vs_v3_sub(middle, vs_v3_scale(f, vs_v3_dot(f, vs_v3_sub(middle, flat->point))));
  vs_vec3 in = vs_v3_sub(n, vs_v3_scale(f, vs_v3_dot(n, f))); /* in: direction within the region's plane that points to
                                                               * the side that is kept */
  double steep = vs_v3_length(in), height = vs_v3_dot(n, vs_v3_sub(middle, point)), reach = vs_bounds_diagonal(b);
  if (steep < 1e-12 || fabs(height) > steep * reach)
    return height >= -1e-13 * reach ? vs_node_retain(region.node)
                                    : vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
  in = vs_v3_unit(in);
  vs_vec3 along = vs_v3_cross(f, in), foot = vs_v3_sub(middle, vs_v3_scale(in, height / steep));
  vs_vec3 corner[4] = { vs_v3_add(foot, vs_v3_scale(along, reach)), vs_v3_sub(foot, vs_v3_scale(along, reach)) };
  corner[2] = vs_v3_add(corner[1], vs_v3_scale(in, 3 * reach)),
  corner[3] = vs_v3_add(corner[0], vs_v3_scale(in, 3 * reach));
  vs_points *points = vs_points_new(s, corner, 4);
  vs_ref line = { points ? vs_node_new(s, VS_LINE, &(struct vs_line){ .points = points, .closed = true }, NULL, 0)
                         : NULL,
                  region.origin };
  vs_ref pair[2] = {
    region, { line.node ? vs_node_new(s, VS_REGION, &(struct vs_region){ 0 }, &line, 1) : NULL, region.origin }
  };
  vs_node *made = pair[1].node ? vs_node_new(s, VS_INTERSECTION, &(struct vs_intersection){ 0 }, pair, 2) : NULL;
  vs_node_release(pair[1].node);
  vs_node_release(line.node);
  if (points) vs_points_release(s, points);
  return made;
}
