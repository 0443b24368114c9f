/* Owns the normals of triangle corners. A corner's normal is the mean of the faces round its vertex that lean away from
 * the corner's own face by less than the crease, each weighted by its angle there; equal normals at a vertex share an
 * entry. */
#include "backends/shade.h"

#include <math.h>
#include <string.h>

#include "model/store/store.h"

void vs_shading_free(vs_shading *s) {
  if (s->normals) s->memory(s->context, s->normals, s->normal_room * sizeof *s->normals, 0);
  if (s->corners) s->memory(s->context, s->corners, s->corner_room * sizeof *s->corners, 0);
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

/* Arrays that are needed while normals are made. */
typedef struct {
  vs_vec3 *faces;             /* a triangle's unit normal */
  double *angles;             /* at each corner */
  const uint32_t *groups;     /* a triangle's; NULL: all are one */
  uint32_t *starts, *around;  /* the corners round vertex v are around[starts[v]] to around[starts[v + 1] - 1] */
} shade_work;

static void shade_work_free(const vs_shading *s, shade_work *w, size_t vertices, size_t triangles) {
  if (w->faces) s->memory(s->context, w->faces, (triangles + 1) * sizeof *w->faces, 0);
  if (w->angles) s->memory(s->context, w->angles, (3 * triangles + 1) * sizeof *w->angles, 0);
  if (w->starts) s->memory(s->context, w->starts, (vertices + 2) * sizeof *w->starts, 0);
  if (w->around) s->memory(s->context, w->around, (3 * triangles + 1) * sizeof *w->around, 0);
}

static bool shade_work_new(vs_shading *s, shade_work *w, size_t vertices, size_t triangles) {
  s->normal_room = 3 * triangles + 1, s->corner_room = triangles + 1;
  return (w->faces = s->memory(s->context, NULL, 0, (triangles + 1) * sizeof *w->faces)) &&
         (w->angles = s->memory(s->context, NULL, 0, (3 * triangles + 1) * sizeof *w->angles)) &&
         (w->starts = s->memory(s->context, NULL, 0, (vertices + 2) * sizeof *w->starts)) &&
         (w->around = s->memory(s->context, NULL, 0, (3 * triangles + 1) * sizeof *w->around)) &&
         (s->normals = s->memory(s->context, NULL, 0, s->normal_room * sizeof *s->normals)) &&
         (s->corners = s->memory(s->context, NULL, 0, s->corner_room * sizeof *s->corners));
}

static bool shade_together(const shade_work *w, uint32_t a, uint32_t b) {
  return w->groups == NULL || a == b || (w->groups[a] == w->groups[b] && w->groups[a] != VS_SHADE_FLAT);
}

/* The normals at vertex v, and which of them its corners have. */
static void shade_vertex(const shade_work *w, size_t v, double least, vs_shading *out) {
  size_t first_normal = out->normal_count;
  for (uint32_t i = w->starts[v]; i < w->starts[v + 1]; i++) {
    uint32_t corner = w->around[i];
    vs_vec3 own = w->faces[corner / 3], sum = vs_v3(0, 0, 0);
    for (uint32_t k = w->starts[v]; k < w->starts[v + 1]; k++) {
      vs_vec3 other = w->faces[w->around[k] / 3];
      if (shade_together(w, corner / 3, w->around[k] / 3) && vs_v3_dot(own, other) >= least)
        sum = vs_v3_add(sum, vs_v3_scale(other, w->angles[w->around[k]]));
    }
    vs_vec3 normal = shade_unit(sum);
    if (vs_v3_length(normal) < 0.5) normal = own;
    if (vs_v3_length(normal) < 0.5) normal = vs_v3(0, 0, 1); /* a needle without a face of its own */
    size_t at = first_normal;
    while (at < out->normal_count && vs_v3_dot(out->normals[at], normal) < 1 - 1e-9) at++;
    if (at == out->normal_count) out->normals[out->normal_count++] = normal;
    out->corners[corner / 3][corner % 3] = (uint32_t)at;
  }
}

/* Most corners share their normals: the room of the others is given back. */
static void shade_trim(vs_shading *s) {
  size_t room = s->normal_count + 1;
  vs_vec3 *less = s->memory(s->context, s->normals, s->normal_room * sizeof *less, room * sizeof *less);
  if (less) s->normals = less, s->normal_room = room;
}

static bool shade_make(vs_emitter *e, vs_shade_memory *memory, void *context, const vs_vec3 *vertices,
                       size_t vertex_count, const uint32_t (*triangles)[3], const uint32_t *groups,
                       size_t triangle_count, double crease, vs_shading *out) {
  shade_work w = { .groups = groups };
  size_t corner_count = 3 * triangle_count;
  *out = (vs_shading){ .memory = memory, .context = context };
  bool ok = shade_work_new(out, &w, vertex_count, triangle_count) || vs_emit_no_memory(e);
  if (!ok) goto done;
  memset(w.starts, 0, (vertex_count + 2) * sizeof *w.starts);
  for (size_t i = 0; ok && i < triangle_count; i++) {
    const uint32_t *t = triangles[i];
    w.faces[i] =
        shade_unit(vs_v3_cross(vs_v3_sub(vertices[t[1]], vertices[t[0]]), vs_v3_sub(vertices[t[2]], vertices[t[0]])));
    for (int k = 0; k < 3; k++) {
      w.angles[3 * i + (size_t)k] = shade_angle(vertices, t, k);
      w.starts[t[k] + 2]++;
    }
    ok = vs_emit_going(e, i);
  }
  if (!ok) goto done;
  /* starts[v + 1] is v's first, and moves to its end */
  for (size_t i = 2; i < vertex_count + 2; i++) w.starts[i] += w.starts[i - 1];
  for (size_t c = 0; c < corner_count; c++) w.around[w.starts[triangles[c / 3][c % 3] + 1]++] = (uint32_t)c;
  double least = cos(crease);
  for (size_t v = 0; ok && v < vertex_count; v++) {
    shade_vertex(&w, v, least, out);
    ok = vs_emit_going(e, v);
  }
  if (ok) shade_trim(out);
done:
  shade_work_free(out, &w, vertex_count, triangle_count);
  if (!ok) vs_shading_free(out);
  return ok;
}

bool vs_shading_make_in(vs_emitter *e, vs_shade_memory *memory, void *context, const vs_vec3 *vertices,
                        size_t vertex_count, const uint32_t (*triangles)[3], size_t triangle_count, double crease,
                        vs_shading *out) {
  return shade_make(e, memory, context, vertices, vertex_count, triangles, NULL, triangle_count, crease, out);
}

static void *shade_store(void *store, void *old, size_t old_bytes, size_t new_bytes) {
  return vs_store_realloc(store, old, old_bytes, new_bytes);
}

bool vs_shading_make_grouped(vs_emitter *e, const vs_vec3 *vertices, size_t vertex_count,
                             const uint32_t (*triangles)[3], const uint32_t *groups, size_t triangle_count,
                             double crease, vs_shading *out) {
  return shade_make(e, shade_store, e->scene->store, vertices, vertex_count, triangles, groups, triangle_count, crease,
                    out);
}

bool vs_shading_make(vs_emitter *e, const vs_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                     size_t triangle_count, double crease, vs_shading *out) {
  return vs_shading_make_grouped(e, vertices, vertex_count, triangles, NULL, triangle_count, crease, out);
}
