/* Owns the normals of triangle corners. A corner's normal is the mean of the faces round its vertex that lean away from
 * the corner's own face by less than the crease, each weighted by its angle there; equal normals at a vertex share an
 * entry. */
#include "backends/shade.h"

#include <math.h>
#include <stdlib.h>

void vs_shading_free(vs_shading *s) {
  free(s->normals);
  free(s->corners);
  *s = (vs_shading){ .normal_count = 0 };
}

static vs_vec3 shade_unit(vs_vec3 v) {
  double length = vs_v3_length(v);
  return length > 0 ? vs_v3_scale(v, 1 / length) : v;
}

static double shade_angle(const vs_vec3 *v, const uint32_t t[3], int corner) {
  vs_vec3 p = v[t[corner]], a = shade_unit(vs_v3_sub(v[t[(corner + 1) % 3]], p)),
          b = shade_unit(vs_v3_sub(v[t[(corner + 2) % 3]], p));
  return acos(fmax(-1, fmin(1, vs_v3_dot(a, b))));
}

bool vs_shading_make(vs_emitter *e, const vs_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                     size_t triangle_count, double crease, vs_shading *out) {
  *out = (vs_shading){ .normal_count = 0 };
  size_t corner_count = 3 * triangle_count;
  vs_vec3 *faces = malloc((triangle_count + 1) * sizeof *faces);
  double *angles = malloc((corner_count + 1) * sizeof *angles);
  uint32_t *starts = calloc(vertex_count + 2, sizeof *starts), *around = malloc((corner_count + 1) * sizeof *around);
  out->normals = malloc((corner_count + 1) * sizeof *out->normals);
  out->corners = malloc((triangle_count + 1) * sizeof *out->corners);
  bool ok = faces != NULL && angles != NULL && starts != NULL && around != NULL && out->normals != NULL &&
            out->corners != NULL;
  if (!ok) {
    vs_emit_no_memory(e);
    goto done;
  }
  for (size_t i = 0; ok && i < triangle_count; i++) {
    const uint32_t *t = triangles[i];
    faces[i] =
        shade_unit(vs_v3_cross(vs_v3_sub(vertices[t[1]], vertices[t[0]]), vs_v3_sub(vertices[t[2]], vertices[t[0]])));
    for (int k = 0; k < 3; k++) {
      angles[3 * i + (size_t)k] = shade_angle(vertices, t, k);
      starts[t[k] + 2]++;
    }
    ok = vs_emit_going(e, i);
  }
  if (!ok) goto done;
  /* starts[v + 1] is v's first, and moves to its end */
  for (size_t i = 2; i < vertex_count + 2; i++) starts[i] += starts[i - 1];
  for (size_t c = 0; c < corner_count; c++) around[starts[triangles[c / 3][c % 3] + 1]++] = (uint32_t)c;
  double least = cos(crease);
  for (size_t v = 0; ok && v < vertex_count; v++) {
    size_t first_normal = out->normal_count;
    for (uint32_t i = starts[v]; i < starts[v + 1]; i++) {
      uint32_t corner = around[i];
      vs_vec3 own = faces[corner / 3], sum = vs_v3(0, 0, 0);
      for (uint32_t k = starts[v]; k < starts[v + 1]; k++) {
        vs_vec3 other = faces[around[k] / 3];
        if (vs_v3_dot(own, other) >= least) sum = vs_v3_add(sum, vs_v3_scale(other, angles[around[k]]));
      }
      vs_vec3 normal = shade_unit(sum);
      if (vs_v3_length(normal) < 0.5) normal = own;
      if (vs_v3_length(normal) < 0.5) normal = vs_v3(0, 0, 1); /* a needle without a face of its own */
      size_t at = first_normal;
      while (at < out->normal_count && vs_v3_dot(out->normals[at], normal) < 1 - 1e-9) at++;
      if (at == out->normal_count) out->normals[out->normal_count++] = normal;
      out->corners[corner / 3][corner % 3] = (uint32_t)at;
    }
    ok = vs_emit_going(e, v);
  }
done:
  free(faces);
  free(angles);
  free(starts);
  free(around);
  if (!ok) vs_shading_free(out);
  return ok;
}
