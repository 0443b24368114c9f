/* Implements the parts of a mesh (mesh_parts.h). Shells, sets of triangles with common points, are found first. A shell
 * with a negative volume is the wall of a cavity. It becomes part of the smallest shell that winds around it. */
#include "geometry/measure/mesh_parts.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/files/polyface.h"
#include "model/store/array.h"
#include "model/store/disjoint.h"

void vs_mesh_parts_free(vs_mesh_parts *p) {
  free(p->of);
  *p = (vs_mesh_parts){ 0 };
}

typedef struct {
  double volume;
  vs_bounds box;
  uint32_t joins; /* number of the outer shell if this shell (connected set of triangles) is the wall of a cavity; else
                   * its own number */
  uint32_t first; /* index of the shell's first triangle */
} shell;

/* Returns the solid angle of the shell number `which` as seen from p, in full turns: 1 if p is inside the shell, 0
 * outside. */
static double turns(const vs_mesh *m, const uint32_t *of, uint32_t which, vs_vec3 p) {
  double sum = 0;
  for (size_t t = 0; t < m->triangle_count; t++) {
    if (of[t] != which) continue;
    const uint32_t *c = m->triangles[t];
    const vs_vec3 *v = m->vertices;
    vs_vec3 a = vs_v3_sub(v[c[0]], p), b = vs_v3_sub(v[c[1]], p), d = vs_v3_sub(v[c[2]], p);
    double la = vs_v3_length(a), lb = vs_v3_length(b), ld = vs_v3_length(d);
    double whole = la * lb * ld + vs_v3_dot(a, b) * ld + vs_v3_dot(b, d) * la + vs_v3_dot(d, a) * lb;
    sum += 2 * atan2(vs_v3_dot(a, vs_v3_cross(b, d)), whole);
  }
  return sum / (4 * 3.14159265358979323846);
}

static void measure(const vs_mesh *m, const uint32_t *of, shell *s) {
  for (size_t t = 0; t < m->triangle_count; t++) {
    const vs_vec3 *v = m->vertices;
    const uint32_t *c = m->triangles[t];
    shell *h = &s[of[t]];
    vs_vec3 from = v[m->triangles[h->first][0]];
    h->volume += vs_v3_dot(vs_v3_sub(v[c[0]], from), vs_v3_cross(vs_v3_sub(v[c[1]], from), vs_v3_sub(v[c[2]], from)));
    for (int k = 0; k < 3; k++) vs_bounds_add(&h->box, v[c[k]]);
  }
}

/* For each shell (connected set of triangles) that is the wall of a cavity, finds the smallest shell that surrounds
 * it. */
static void enclose(const vs_mesh *m, const uint32_t *of, shell *s, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    if (!(s[i].volume < 0)) continue;
    vs_vec3 p = m->vertices[m->triangles[s[i].first][0]];
    double least = INFINITY;
    for (uint32_t k = 0; k < count; k++) {
      if (!(s[k].volume > 0) || s[k].volume >= least || !vs_bounds_overlap(&s[k].box, &s[i].box, 0)) continue;
      if (turns(m, of, k, p) > .5) least = s[k].volume, s[i].joins = k;
    }
  }
}

/* Numbers the parts of the mesh in the order of their first triangles. */
static bool number(vs_mesh_parts *p, size_t triangles, const shell *s, uint32_t shells) {
  uint32_t *name = NULL;
  if (!VS_FRESH(name, shells + 1)) return false;
  memset(name, 0xFF, (shells + 1) * sizeof *name);
  for (size_t t = 0; t < triangles; t++) {
    uint32_t k = s[p->of[t]].joins;
    if (name[k] == UINT32_MAX) name[k] = p->count++;
    p->of[t] = name[k];
  }
  free(name);
  return true;
}

bool vs_mesh_parts_find(const vs_mesh *m, vs_mesh_parts *out) {
  uint32_t *up = NULL, *name = NULL, shells = 0;
  shell *s = NULL;
  *out = (vs_mesh_parts){ 0 };
  bool ok = VS_FRESH(up, m->vertex_count + 1) && VS_FRESH(name, m->vertex_count + 1) &&
            VS_FRESH(out->of, m->triangle_count + 1) && VS_FRESH(s, m->triangle_count + 1) &&
            vs_polyface_merge(m->vertices, m->vertex_count, up);
  for (size_t t = 0; ok && t < m->triangle_count; t++)
    for (int k = 1; k < 3; k++) vs_unite(up, m->triangles[t][0], m->triangles[t][k]);
  if (ok) memset(name, 0xFF, (m->vertex_count + 1) * sizeof *name);
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    uint32_t a = vs_find(up, m->triangles[t][0]);
    if (name[a] == UINT32_MAX) {
      s[shells] = (shell){ .box = vs_bounds_empty(), .joins = shells, .first = (uint32_t)t };
      name[a] = shells++;
    }
    out->of[t] = name[a];
  }
  if (ok) measure(m, out->of, s), enclose(m, out->of, s, shells);
  ok = ok && number(out, m->triangle_count, s, shells);
  free(up), free(name), free(s);
  return ok;
}

bool vs_mesh_parts_copy(const vs_mesh *m, const vs_mesh_parts *parts, uint32_t part, vs_mesh *to) {
  uint32_t *name = NULL;
  bool ok = VS_FRESH(name, m->vertex_count + 1);
  if (ok) memset(name, 0xFF, (m->vertex_count + 1) * sizeof *name);
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    const uint32_t *c = m->triangles[t];
    if (parts->of[t] != part) continue;
    for (int k = 0; ok && k < 3; k++)
      if (name[c[k]] == UINT32_MAX) ok = vs_mesh_add_vertex(to, m->vertices[c[k]], &name[c[k]]);
    ok = ok && vs_mesh_add_triangle(to, name[c[0]], name[c[1]], name[c[2]]);
  }
  free(name);
  if (!ok) vs_mesh_free(to);
  return ok;
}
