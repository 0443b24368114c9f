/* Finds the shells of a mesh, and computes their volumes and areas. */
#include "kernel/mesh/shells.h"

#include <stdlib.h>

#include "model/store/array.h"
#include "model/store/disjoint.h"

static double reach(vs_vec3 p) { return fmax(fmax(fabs(p.x), fabs(p.y)), fabs(p.z)); }

bool vs_shells_find(const vs_mesh *m, vs_shells *out) {
  uint32_t n = (uint32_t)m->vertex_count, *set = vs_fresh((size_t)n + 1, sizeof *set);
  *out = (vs_shells){ .of = set };
  if (!set) return false;
  vs_disjoint(set, n);
  for (size_t t = 0; t < m->triangle_count; t++)
    for (int j = 1; j < 3; j++) vs_unite(set, m->triangles[t][0], m->triangles[t][j]);
  for (uint32_t v = 0; v < n; v++) /* The root of each set is its first vertex. Therefore one pass can replace parents
                                    * by numbers of shells. */
    set[v] = set[v] == v ? out->count++ : set[set[v]];
  out->at = vs_zeros((size_t)out->count + 1, sizeof *out->at);
  if (!out->at) return false;
  for (size_t t = 0; t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    vs_shell *s = &out->at[set[v[0]]];
    vs_vec3 a = m->vertices[v[0]], b = m->vertices[v[1]], c = m->vertices[v[2]];
    if (s->area == 0 && s->reach == 0) s->from = a;
    vs_vec3 normal = vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
    /* Coordinates are relative to a corner of the shell, so that rounding errors do not grow with the distance from the
     * origin. */
    s->volume += vs_v3_dot(normal, vs_v3_sub(a, s->from)) / 6;
    s->area += vs_v3_length(normal) / 2;
    s->reach = fmax(s->reach, fmax(reach(a), fmax(reach(b), reach(c))));
  }
  return true;
}

void vs_shells_free(vs_shells *s) {
  free(s->of);
  free(s->at);
}
