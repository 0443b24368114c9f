/* Thickens surfaces that consist of triangles: makes two copies at a distance, and walls along the border.
 *
 * A vertex moves along the sum n of its facets' normals, weighted by their angles at the vertex. It moves until it
 * reaches the mean of the facets' shifted planes, but at most four times the distance. If the surface is flat or has
 * one fold at the vertex, the vertex then lies in all of these planes. */
#include "geometry/profiles/thicken.h"

#include <stdlib.h>

#include "geometry/files/polyface.h"
#include "model/store/array.h"

typedef struct { uint64_t key; bool forward; uint32_t a, b; } vs_border;

static int border_compare(const void *p, const void *q) {
  const vs_border *x = p, *y = q;
  return x->key < y->key ? -1 : x->key > y->key;
}

/* Appends walls between the two copies along the surface's border: edges that facets contain more often in one
 * direction than in the other. up, down: first vertices of the two copies. Returns false when memory is out. */
static bool thicken_walls(vs_mesh *out, uint32_t (*facets)[3], size_t count, uint32_t up, uint32_t down) {
  vs_border *edges = vs_fresh(3 * count, sizeof *edges);
  bool ok = edges != NULL;
  for (size_t i = 0; ok && i < 3 * count; i++) {
    uint32_t a = facets[i / 3][i % 3], b = facets[i / 3][(i + 1) % 3];
    edges[i] = (vs_border){ a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a, a < b, a, b };
  }
  if (ok) qsort(edges, 3 * count, sizeof *edges, border_compare);
  for (size_t i = 0, end; ok && i < 3 * count; i = end) {
    long over = 0;
    for (end = i; end < 3 * count && edges[end].key == edges[i].key; end++) over += edges[end].forward ? 1 : -1;
    uint32_t a = (uint32_t)(edges[i].key >> 32), b = (uint32_t)edges[i].key;
    for (; ok && over != 0; over += over > 0 ? -1 : 1) {
      uint32_t p = over > 0 ? a : b, q = over > 0 ? b : a;
      ok = vs_mesh_add_triangle(out, up + q, up + p, down + p) && vs_mesh_add_triangle(out, up + q, down + p, down + q);
    }
  }
  free(edges);
  return ok;
}

/* Returns true if the facets of a copy of the surface face as those of the surface do. copy: first vertex of this copy
 * in out. Otherwise sets *at to the position of a reversed facet. */
static bool thicken_keeps(const vs_mesh *m, uint32_t (*facets)[3], size_t count, const vs_mesh *out, uint32_t copy,
                          vs_vec3 *at) {
  for (size_t i = 0; i < count; i++) {
    vs_vec3 p[3], q[3];
    for (int k = 0; k < 3; k++) p[k] = m->vertices[facets[i][k]], q[k] = out->vertices[copy + facets[i][k]];
    vs_vec3 a = vs_v3_cross(vs_v3_sub(p[1], p[0]), vs_v3_sub(p[2], p[0]));
    vs_vec3 b = vs_v3_cross(vs_v3_sub(q[1], q[0]), vs_v3_sub(q[2], q[0]));
    bool keeps = vs_v3_dot(a, b) > 0;
    for (int k = 0; k < 3; k++) /* compares the directions of edges, too: a facet that is inverted through its centre
                                 * has an unchanged normal */
      keeps = keeps && vs_v3_dot(vs_v3_sub(p[(k + 1) % 3], p[k]), vs_v3_sub(q[(k + 1) % 3], q[k])) > 0;
    if (!keeps) return *at = p[0], false;
  }
  return true;
}

bool vs_thicken_surface(const vs_mesh *m, double outwards, double inwards, vs_mesh *out, vs_vec3 *turned,
                        bool *turns) {
  size_t n = m->vertex_count, count = 0;
  uint32_t *place = vs_fresh(n, sizeof *place),
           (*facets)[3] = vs_fresh(m->triangle_count, sizeof *facets);
  vs_vec3 *normal = vs_zeros(n, sizeof *normal),
          *face = vs_fresh(m->triangle_count, sizeof *face);
  double *cosine = vs_zeros(n, sizeof *cosine), *weight = vs_zeros(n, sizeof *weight);
  bool ok = place && facets && normal && face && cosine && weight && vs_polyface_merge(m->vertices, n, place);
  for (size_t i = 0; ok && i < m->triangle_count; i++) {
    uint32_t t[3];
    for (int k = 0; k < 3; k++) t[k] = place[m->triangles[i][k]];
    vs_vec3 c =
        vs_v3_cross(vs_v3_sub(m->vertices[t[1]], m->vertices[t[0]]), vs_v3_sub(m->vertices[t[2]], m->vertices[t[0]]));
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || vs_v3_dot(c, c) == 0) continue;
    face[count] = vs_v3_unit(c);
    for (int k = 0; k < 3; k++) {
      facets[count][k] = t[k];
      vs_vec3 p = vs_v3_sub(m->vertices[t[(k + 1) % 3]], m->vertices[t[k]]),
              q = vs_v3_sub(m->vertices[t[(k + 2) % 3]], m->vertices[t[k]]);
      double angle = atan2(vs_v3_length(vs_v3_cross(p, q)), vs_v3_dot(p, q));
      normal[t[k]] = vs_v3_add(normal[t[k]], vs_v3_scale(face[count], angle));
    }
    count++;
  }
  for (size_t i = 0; ok && i < count; i++)
    for (int k = 0; k < 3; k++) {
      cosine[facets[i][k]] += vs_v3_dot(vs_v3_unit(normal[facets[i][k]]), face[i]);
      weight[facets[i][k]]++;
    }
  uint32_t up = (uint32_t)out->vertex_count, down = up + (uint32_t)n;
  for (int side = 1; ok && side >= -1; side -= 2)
    for (size_t i = 0; ok && i < n; i++) {
      double mean = weight[i] > 0 ? cosine[i] / weight[i] : 1;
      double distance = side > 0 ? outwards : -inwards;
      vs_vec3 shift = vs_v3_scale(vs_v3_unit(normal[i]), distance / fmax(mean, 0.25));
      ok = vs_mesh_add_vertex(out, vs_v3_add(m->vertices[i], shift), NULL);
    }
  for (size_t i = 0; ok && i < count; i++)
    ok = vs_mesh_add_triangle(out, up + facets[i][0], up + facets[i][1], up + facets[i][2]) &&
         vs_mesh_add_triangle(out, down + facets[i][2], down + facets[i][1], down + facets[i][0]);
  ok = ok && thicken_walls(out, facets, count, up, down);
  if (ok && turns)
    *turns = !thicken_keeps(m, facets, count, out, up, turned) || !thicken_keeps(m, facets, count, out, down, turned);
  free(place);
  free(facets);
  free(normal);
  free(face);
  free(cosine);
  free(weight);
  return ok;
}
