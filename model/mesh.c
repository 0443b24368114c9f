/* Implements the indexed triangle mesh: adds vertices and triangles, and computes its volume and bounds. */
#include "model/mesh.h"
#include "model/store/array.h"

#include <stdlib.h>
#include <string.h>

void vs_mesh_free(vs_mesh *m) {
  free(m->vertices);
  free(m->triangles);
  free(m->tags);
  *m = (vs_mesh){ 0 };
}

bool vs_mesh_reserve(vs_mesh *m, size_t vertices, size_t triangles) {
  if (vertices > UINT32_MAX || triangles > UINT32_MAX) return false;
  if (m->most && (triangles > m->most || vertices / 3 > m->most)) {
    m->over = true;
    return false;
  }
  if (vertices > m->vertex_room) {
    vs_vec3 *grown = realloc(m->vertices, vertices * sizeof *grown);
    if (!grown) return false;
    m->vertices = grown;
    m->vertex_room = vertices;
  }
  if (triangles > m->triangle_room) {
    void *grown = realloc(m->triangles, triangles * sizeof *m->triangles);
    if (!grown) return false;
    m->triangles = grown;
    if (m->tags) {
      uint32_t *tags = realloc(m->tags, triangles * sizeof *tags);
      if (!tags) return false; /* triangle_room stays unchanged: it is the room of both arrays, and the array of tags
                                * has not grown */
      m->tags = tags;
    }
    m->triangle_room = triangles;
  }
  return true;
}

bool vs_mesh_want_tags(vs_mesh *m) {
  return m->tags || (vs_mesh_reserve(m, 0, m->triangle_count + 1) &&
                     (m->tags = vs_zeros(m->triangle_room, sizeof *m->tags)) != NULL);
}

bool vs_mesh_copy(const vs_mesh *from, vs_mesh *to) {
  VS_ASSERT(to->vertex_count == 0 && to->triangle_count == 0);
  if (!vs_mesh_reserve(to, from->vertex_count + 1, from->triangle_count + 1) || (from->tags && !vs_mesh_want_tags(to)))
    return vs_mesh_free(to), false;
  to->vertex_count = from->vertex_count;
  to->triangle_count = from->triangle_count;
  if (from->vertex_count) memcpy(to->vertices, from->vertices, from->vertex_count * sizeof *to->vertices);
  if (from->triangle_count) memcpy(to->triangles, from->triangles, from->triangle_count * sizeof *to->triangles);
  if (from->tags && from->triangle_count) memcpy(to->tags, from->tags, from->triangle_count * sizeof *to->tags);
  return true;
}

/* Returns a larger number of elements for an array: half as many again as `room`, but at most `most` (0: no limit),
 * unless `room` already exceeds it. */
static size_t mesh_next_room(size_t room, size_t most) {
  size_t next = room < 16 ? 16 : room + room / 2;
  return most && room < most && next > most ? most : next;
}

bool vs_mesh_add_vertex(vs_mesh *m, vs_vec3 v, uint32_t *index) {
  if (m->vertex_count == m->vertex_room && !vs_mesh_reserve(m, mesh_next_room(m->vertex_room, 3 * m->most), 0))
    return false;
  if (index) *index = (uint32_t)m->vertex_count;
  m->vertices[m->vertex_count++] = v;
  return true;
}

bool vs_mesh_add_triangle(vs_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  if (m->triangle_count == m->triangle_room && !vs_mesh_reserve(m, 0, mesh_next_room(m->triangle_room, m->most)))
    return false;
  uint32_t *t = m->triangles[m->triangle_count];
  t[0] = a;
  t[1] = b;
  t[2] = c;
  if (m->tags) m->tags[m->triangle_count] = 0;
  m->triangle_count++;
  return true;
}

double vs_mesh_volume(const vs_mesh *m) {
  if (!m->triangle_count) return 0;
  vs_vec3 o = m->vertices[m->triangles[0][0]]; /* Volumes are computed relative to a corner of the mesh, because large
                                                * coordinates would lose digits. */
  double six = 0;
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    vs_vec3 a = vs_v3_sub(m->vertices[t[0]], o), b = vs_v3_sub(m->vertices[t[1]], o),
            c = vs_v3_sub(m->vertices[t[2]], o);
    six += vs_v3_dot(a, vs_v3_cross(b, c));
  }
  return six / 6;
}

double vs_mesh_area(const vs_mesh *m) {
  double twice = 0;
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    vs_vec3 a = m->vertices[t[0]];
    twice += vs_v3_length(vs_v3_cross(vs_v3_sub(m->vertices[t[1]], a), vs_v3_sub(m->vertices[t[2]], a)));
  }
  return twice / 2;
}

vs_bounds vs_mesh_bounds(const vs_mesh *m) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < m->triangle_count; i++)
    for (int k = 0; k < 3; k++) vs_bounds_add(&b, m->vertices[m->triangles[i][k]]);
  return b;
}

vs_bounds vs_mesh_placed_bounds(const vs_mesh *m, const vs_affine *a) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < m->vertex_count; i++) vs_bounds_add(&b, vs_affine_point(a, m->vertices[i]));
  return b;
}

static int mesh_compare_keys(const void *a, const void *b) {
  uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
  return x < y ? -1 : x > y;
}

/* Returns true if every directed edge occurs as often as its reverse. Sorts a list of the edges and a list of their
 * reverses; the two lists must then be equal. */
bool vs_mesh_closed(const vs_mesh *m, bool *ok) {
  size_t n = m->triangle_count * 3;
  if (ok) *ok = true;
  if (!n) return true;
  uint64_t *keys = m->triangle_count < SIZE_MAX / (6 * sizeof *keys) ? vs_fresh(2 * n, sizeof *keys) : NULL;
  if (!keys) {
    if (ok) *ok = false;
    return false;
  }
  for (size_t i = 0; i < n; i++) {
    const uint32_t *t = m->triangles[i / 3];
    uint64_t a = t[i % 3], b = t[(i + 1) % 3];
    keys[i] = a << 32 | b;
    keys[n + i] = b << 32 | a;
  }
  qsort(keys, n, sizeof *keys, mesh_compare_keys);
  qsort(keys + n, n, sizeof *keys, mesh_compare_keys);
  bool closed = true;
  for (size_t i = 0; i < n && closed; i++) closed = keys[i] == keys[n + i];
  free(keys);
  return closed;
}

void vs_mesh_turn(vs_mesh *m, size_t first_triangle) {
  VS_ASSERT(first_triangle <= m->triangle_count);
  m->settled = false;
  for (size_t i = first_triangle; i < m->triangle_count; i++) {
    uint32_t swap = m->triangles[i][1];
    m->triangles[i][1] = m->triangles[i][2];
    m->triangles[i][2] = swap;
  }
}

bool vs_mesh_turn_outwards(vs_mesh *m, size_t first_triangle) {
  VS_ASSERT(first_triangle <= m->triangle_count);
  vs_mesh part = { .vertices = m->vertices,
                   .triangles = m->triangles + first_triangle,
                   .triangle_count = m->triangle_count - first_triangle };
  bool inside_out = vs_mesh_volume(&part) < 0;
  if (inside_out) vs_mesh_turn(m, first_triangle);
  return inside_out;
}

void vs_mesh_transform_from(vs_mesh *m, const vs_affine *a, size_t first_vertex, size_t first_triangle) {
  VS_ASSERT(first_vertex <= m->vertex_count && first_triangle <= m->triangle_count);
  m->settled = false;
  for (size_t i = first_vertex; i < m->vertex_count; i++) m->vertices[i] = vs_affine_point(a, m->vertices[i]);
  if (vs_affine_determinant(a) < 0) vs_mesh_turn(m, first_triangle);
}

void vs_mesh_transform(vs_mesh *m, const vs_affine *a) { vs_mesh_transform_from(m, a, 0, 0); }

void vs_mesh_squeeze(vs_mesh *m, const uint8_t *gone) {
  size_t kept = 0;
  m->settled = false;
  for (size_t t = 0; t < m->triangle_count; t++) {
    if (gone[t]) continue;
    memmove(m->triangles[kept], m->triangles[t], sizeof *m->triangles);
    if (m->tags) m->tags[kept] = m->tags[t];
    kept++;
  }
  m->triangle_count = kept;
}
