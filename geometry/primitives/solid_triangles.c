/* Makes the triangles of the primitive solids.
 *
 * Rings run counter-clockwise about the axis from +X of its frame. Facets are counter-clockwise as seen from outside.
 * Poles, apexes, centres of discs and corners at quarter turns equal the exact formula to the last bit. The kernel
 * relies on this where the nodes of a truss share such points. vs_mesh_reserve refuses meshes with more than 32 bits of
 * indices. */
#include "geometry/primitives/solid_triangles.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "geometry/files/polyface.h"
#include "geometry/plane/ear_clipping.h"
#include "model/store/array.h"

static bool solid_eight(vs_mesh *out, const vs_vec3 *corners, size_t n, const unsigned char (*faces)[3],
                        size_t face_count) {
  uint32_t base = (uint32_t)out->vertex_count;
  bool ok = true;
  for (size_t i = 0; ok && i < n; i++) ok = vs_mesh_add_vertex(out, corners[i], NULL);
  for (size_t i = 0; ok && i < face_count; i++)
    ok = vs_mesh_add_triangle(out, base + faces[i][0], base + faces[i][1], base + faces[i][2]);
  return ok;
}

bool vs_solid_box(vs_mesh *out, vs_vec3 p, vs_vec3 q) {
  vs_vec3 corners[8];
  for (int i = 0; i < 8; i++) corners[i] = vs_v3(i & 1 ? q.x : p.x, i & 2 ? q.y : p.y, i & 4 ? q.z : p.z);
  static const unsigned char faces[12][3] = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 },
                                              { 0, 1, 5 }, { 0, 5, 4 }, { 2, 6, 7 }, { 2, 7, 3 },
                                              { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return solid_eight(out, corners, 8, faces, 12);
}

bool vs_solid_wedge(vs_mesh *out, vs_vec3 p, vs_vec3 q) {
  vs_vec3 corners[6] = { { p.x, p.y, p.z }, { q.x, p.y, p.z }, { p.x, q.y, p.z },
                         { q.x, q.y, p.z }, { p.x, p.y, q.z }, { p.x, q.y, q.z } };
  static const unsigned char faces[8][3] = { { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 4 }, { 2, 5, 3 },
                                             { 0, 4, 5 }, { 0, 5, 2 }, { 1, 3, 5 }, { 1, 5, 4 } };
  return solid_eight(out, corners, 6, faces, 8);
}

bool vs_solid_fits(int around, int across, const char *what, vs_error *e) {
  double triangles = 2.0 * around * across;
  return triangles <= 4e6 || vs_error_set(e, VS_ERROR_MODEL, NULL,
                                          "a %s of %d facets a turn has %.0f million triangles, and one shape may have "
                                          "4 million: give fewer #:segments, or a larger tolerance",
                                          what, around, triangles / 1e6);
}

/* ---- rings and bands ---- */

/* Appends n >= 3 corners of an ellipse; its half axes lie along X and Y of the frame. */
static bool solid_oval(vs_mesh *out, const vs_affine *frame, vs_oval oval, int n) {
  bool ok = true;
  VS_ASSERT(n >= 3);
  for (int i = 0; ok && i < n; i++) {
    double s, c;
    vs_turn_sincos(i, n, &s, &c);
    vs_vec3 across = vs_affine_vector(frame, vs_v3(oval.radius * c, oval.across * s, 0));
    ok = vs_mesh_add_vertex(out, vs_v3_add(oval.center, across), NULL);
  }
  return ok;
}

bool vs_solid_ring(vs_mesh *out, const vs_affine *frame, vs_vec3 center, double r, int n) {
  return solid_oval(out, frame, (vs_oval){ center, r, r }, n);
}

bool vs_solid_band(vs_mesh *out, uint32_t low, uint32_t high, uint32_t n) {
  bool ok = true;
  VS_ASSERT(low != high && n >= 3);
  for (uint32_t i = 0; ok && i < n; i++) {
    uint32_t j = i + 1 == n ? 0 : i + 1;
    ok =
        vs_mesh_add_triangle(out, low + i, low + j, high + j) && vs_mesh_add_triangle(out, low + i, high + j, high + i);
  }
  return ok;
}

bool vs_solid_fan(vs_mesh *out, uint32_t ring, uint32_t n, uint32_t tip, bool back) {
  bool ok = true;
  VS_ASSERT(n >= 3);
  for (uint32_t i = 0; ok && i < n; i++) {
    uint32_t j = i + 1 == n ? 0 : i + 1;
    ok = vs_mesh_add_triangle(out, ring + (back ? j : i), ring + (back ? i : j), tip);
  }
  return ok;
}

/* Fills a ring of n corners with triangles. If `hub` is true, they all have the centre as a corner. Otherwise they
 * have only the ring's corners, and cut off every second corner repeatedly. back: true if the disc faces against the
 * axis. */
static bool solid_disc(vs_mesh *out, vs_vec3 center, uint32_t ring, uint32_t n, bool back, bool hub) {
  uint32_t tip;
  if (hub) return vs_mesh_add_vertex(out, center, &tip) && vs_solid_fan(out, ring, n, tip, back);
  bool ok = true;
  for (uint32_t step = 1; ok && step < n; step *= 2)
    for (uint32_t i = 0; ok && i + step < n; i += 2 * step) {
      uint32_t end = i + 2 * step >= n ? 0 : i + 2 * step;
      if (end == 0 && i == 0) continue;
      ok = vs_mesh_add_triangle(out, ring + i, ring + (back ? end : i + step), ring + (back ? i + step : end));
    }
  return ok;
}

bool vs_solid_frustum(vs_mesh *out, vs_disc base, vs_disc top, int n, bool hubs) {
  return vs_solid_oval_frustum(out, (vs_oval){ base.center, base.radius, base.radius },
                               (vs_oval){ top.center, top.radius, top.radius }, n, hubs);
}

bool vs_solid_oval_frustum(vs_mesh *out, vs_oval base, vs_oval top, int n, bool hubs) {
  vs_affine frame = vs_frame_on_axis(base.center, vs_v3_sub(top.center, base.center));
  uint32_t first = (uint32_t)out->vertex_count, sides = (uint32_t)n, low = first, high = first, tip;
  bool ok = vs_mesh_reserve(out, out->vertex_count + 2 * (size_t)sides + 2, out->triangle_count + 4 * (size_t)sides);
  bool below = base.radius > 0, above = top.radius > 0;
  VS_ASSERT(n >= 3);
  if (below) {
    ok = ok && solid_oval(out, &frame, base, n);
    high = first + sides;
  }
  if (above) ok = ok && solid_oval(out, &frame, top, n);
  if (below) ok = ok && solid_disc(out, base.center, low, sides, true, hubs);
  if (above) ok = ok && solid_disc(out, top.center, high, sides, false, hubs);
  if (below && above) return ok && vs_solid_band(out, low, high, sides);
  if (below) return ok && vs_mesh_add_vertex(out, top.center, &tip) && vs_solid_fan(out, low, sides, tip, false);
  if (above) return ok && vs_mesh_add_vertex(out, base.center, &tip) && vs_solid_fan(out, high, sides, tip, true);
  return ok;
}

bool vs_solid_sphere(vs_mesh *out, vs_vec3 center, double radius, int n) {
  int rings = n / 2 < 2 ? 2 : n / 2;
  uint32_t first = (uint32_t)out->vertex_count, around = (uint32_t)n, south, north;
  vs_affine level = vs_affine_identity();
  bool ok = vs_mesh_reserve(out, out->vertex_count + (size_t)n * (size_t)(rings - 1) + 2,
                            out->triangle_count + 2 * (size_t)n * (size_t)(rings - 1));
  VS_ASSERT(n >= 3);
  for (int j = 1; ok && j < rings; j++) { /* makes the rings of corners, beginning near the south pole */
    double s, c;
    vs_turn_sincos(j, 2 * rings, &s, &c);
    ok = vs_solid_ring(out, &level, vs_v3(center.x, center.y, center.z - radius * c), radius * s, n);
  }
  for (uint32_t j = 1; ok && j + 1 < (uint32_t)rings; j++)
    ok = vs_solid_band(out, first + (j - 1) * around, first + j * around, around);
  return ok && vs_mesh_add_vertex(out, vs_v3(center.x, center.y, center.z - radius), &south) &&
         vs_mesh_add_vertex(out, vs_v3(center.x, center.y, center.z + radius), &north) &&
         vs_solid_fan(out, first, around, south, true) &&
         vs_solid_fan(out, first + (uint32_t)(rings - 2) * around, around, north, false);
}

/* If the tube's radius is larger than the path's, the surface would intersect itself on the axis. Then only the outer
 * surface is made, from pole to pole. around and tube_turn are at least 3. */
bool vs_solid_torus(vs_mesh *out, vs_vec3 center, double radius, double tube, int around, int tube_turn) {
  uint32_t first = (uint32_t)out->vertex_count, n = (uint32_t)around, south, north;
  vs_affine level = vs_affine_identity();
  bool ok = true;
  VS_ASSERT(around >= 3 && tube_turn >= 3);
  if (radius > tube) {
    uint32_t rows = (uint32_t)tube_turn;
    for (int j = 0; ok && j < tube_turn; j++) {
      double s, c;
      vs_turn_sincos(j, tube_turn, &s, &c);
      ok = vs_solid_ring(out, &level, vs_v3(center.x, center.y, center.z + tube * s), radius + tube * c, around);
    }
    for (uint32_t j = 0; ok && j < rows; j++)
      ok = vs_solid_band(out, first + j * n, first + (j + 1 == rows ? 0 : j + 1) * n, n);
    return ok;
  }
  double reach = acos(-radius / tube), pole = sqrt((tube - radius) * (tube + radius));
  int rows = 2 * (int)ceil(reach / 6.28318530717958647693 * tube_turn);
  if (rows < 4) rows = 4;
  for (int j = 1; ok && j < rows; j++) {
    double s, c, angle = reach * (2 * j - rows) / rows;
    vs_sincos(angle, &s, &c);
    ok = vs_solid_ring(out, &level, vs_v3(center.x, center.y, center.z + tube * s), radius + tube * c, around);
  }
  for (uint32_t j = 1; ok && j + 1 < (uint32_t)rows; j++)
    ok = vs_solid_band(out, first + (j - 1) * n, first + j * n, n);
  return ok && vs_mesh_add_vertex(out, vs_v3(center.x, center.y, center.z - pole), &south) &&
         vs_mesh_add_vertex(out, vs_v3(center.x, center.y, center.z + pole), &north) &&
         vs_solid_fan(out, first, n, south, true) &&
         vs_solid_fan(out, first + (uint32_t)(rows - 2) * n, n, north, false);
}

/* ---- polyface meshes ---- */

bool vs_solid_polyface(vs_mesh *out, const vs_points *points, const vs_faces *faces) {
  uint32_t *place = vs_fresh(points->count, sizeof *place);
  bool ok = place && vs_polyface_merge(points->at, points->count, place) &&
            vs_solid_polyface_merged(out, points, faces, place);
  free(place);
  return ok;
}

/* Appends a polyface mesh. Points with equal positions become one vertex. */
bool vs_solid_polyface_merged(vs_mesh *out, const vs_points *points, const vs_faces *faces, uint32_t *place) {
  const uint32_t *starts = vs_faces_starts(faces), *corners = vs_faces_corners(faces);
  vs_vec2 *flat = vs_fresh(faces->corner_count, sizeof *flat);
  uint32_t *ring = vs_fresh(faces->corner_count, sizeof *ring);
  uint32_t base = (uint32_t)out->vertex_count;
  size_t triangles =
      faces->corner_count > 2 * (size_t)faces->count ? faces->corner_count - 2 * (size_t)faces->count : 0;
  bool ok = flat && ring && vs_mesh_reserve(out, out->vertex_count + points->count, out->triangle_count + triangles);
  uint32_t next = base;
  for (uint32_t i = 0; ok && i < points->count;
       i++) { /* place[i] is first the index of the earliest point with the position of point i, and later the vertex of
               * point i */
    if (place[i] == i) {
      ok = vs_mesh_add_vertex(out, points->at[i], NULL);
      place[i] = next++;
    } else place[i] = place[place[i]];
  }
  size_t tagged = out->triangle_count;
  for (uint32_t f = 0; ok && f <= faces->count; f++) {
    for (; out->tags && tagged < out->triangle_count; tagged++) out->tags[tagged] = f - 1; /* sets the tags of the
                                                                                            * previous face's triangles
                                                                                            * to its number, f - 1 */
    if (f == faces->count) break;
    size_t n = 0;
    vs_vec3 normal = vs_v3(0, 0, 0);
    for (uint32_t c = starts[f]; c < starts[f + 1]; c++) {
      uint32_t v = place[corners[c]];
      if (n && ring[n - 1] == v) continue; /* skips a repeated corner: some files write a triangle as a quadrilateral */
      ring[n++] = v;
    }
    while (n > 1 && ring[n - 1] == ring[0]) n--;
    if (n < 3) continue;
    if (n == 3) {
      ok = vs_mesh_add_triangle(out, ring[0], ring[1], ring[2]);
      continue;
    }
    vs_vec3 o = out->vertices[ring[0]];
    for (size_t i = 0; i < n; i++)
      normal = vs_v3_add(
          normal, vs_v3_cross(vs_v3_sub(out->vertices[ring[i]], o), vs_v3_sub(out->vertices[ring[(i + 1) % n]], o)));
    if (n == 4) { /* divides a quadrilateral along the diagonal from its first corner, or along the other diagonal if it
                   * is concave at its second or fourth corner */
      vs_vec3 a = vs_v3_sub(out->vertices[ring[1]], o), b = vs_v3_sub(out->vertices[ring[2]], o),
              c = vs_v3_sub(out->vertices[ring[3]], o);
      bool convex = vs_v3_dot(vs_v3_cross(a, b), normal) > 0 && vs_v3_dot(vs_v3_cross(b, c), normal) > 0;
      int k = convex ? 0 : 1;
      ok = vs_mesh_add_triangle(out, ring[k], ring[k + 1], ring[k + 2]) &&
           vs_mesh_add_triangle(out, ring[k], ring[k + 2], ring[(k + 3) % 4]);
      continue;
    }
    vs_affine frame = vs_frame_on_axis(o, vs_v3_length(normal) > 0 ? normal : vs_v3(0, 0, 1));
    for (size_t i = 0; i < n; i++) {
      vs_vec3 d = vs_v3_sub(out->vertices[ring[i]], o);
      flat[i] = (vs_vec2){ d.x * frame.m[0][0] + d.y * frame.m[1][0] + d.z * frame.m[2][0],
                           d.x * frame.m[0][1] + d.y * frame.m[1][1] + d.z * frame.m[2][1] };
    }
    ok = vs_triangulate(flat, &n, 1, out, ring, false);
  }
  free(flat);
  free(ring);
  return ok;
}
