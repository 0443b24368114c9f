/* Computes the normals of triangle corners. A corner's normal is a mean over the faces around its vertex, each weighted
 * by its angle at the vertex. The mean includes only the faces whose angle to the corner's own face is less than the
 * crease angle. Equal normals at a vertex are one entry of the list of normals. */
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

/* The triangles, and temporary arrays for computing their normals. The memory function of `out` allocates these
 * arrays. */
typedef struct {
  const vs_shade_faces *of;
  vs_shading *out;
  double least;               /* cosine of the crease angle: the edge between two faces is smooth if the cosine between
                               * their normals is at least this value */
  vs_vec3 *faces;             /* faces[t]: unit normal of triangle t's plane */
  double *angles;             /* angle of each triangle at each of its corners, in radians */
  uint32_t *starts, *around;  /* the corners around vertex v are around[starts[v]] to around[starts[v + 1] - 1] */
} shade_work;

static void *shade_take(const vs_shading *s, size_t bytes) { return s->memory(s->context, NULL, 0, bytes); }

static void shade_work_free(const shade_work *w) {
  const vs_shading *s = w->out;
  size_t triangles = w->of->triangle_count;
  if (w->faces) s->memory(s->context, w->faces, (triangles + 1) * sizeof *w->faces, 0);
  if (w->angles) s->memory(s->context, w->angles, (3 * triangles + 1) * sizeof *w->angles, 0);
  if (w->starts) s->memory(s->context, w->starts, (w->of->vertex_count + 2) * sizeof *w->starts, 0);
  if (w->around) s->memory(s->context, w->around, (3 * triangles + 1) * sizeof *w->around, 0);
}

static bool shade_work_new(shade_work *w) {
  vs_shading *s = w->out;
  size_t triangles = w->of->triangle_count, starts = (w->of->vertex_count + 2) * sizeof *w->starts;
  s->normal_room = 3 * triangles + 1, s->corner_room = triangles + 1;
  bool ok = (w->faces = shade_take(s, (triangles + 1) * sizeof *w->faces)) &&
            (w->angles = shade_take(s, (3 * triangles + 1) * sizeof *w->angles)) &&
            (w->starts = shade_take(s, starts)) &&
            (w->around = shade_take(s, (3 * triangles + 1) * sizeof *w->around)) &&
            (s->normals = shade_take(s, s->normal_room * sizeof *s->normals)) &&
            (s->corners = shade_take(s, s->corner_room * sizeof *s->corners));
  if (ok) memset(w->starts, 0, starts);
  return ok;
}

static bool shade_together(const shade_work *w, uint32_t a, uint32_t b) {
  const uint32_t *groups = w->of->groups;
  return groups == NULL || a == b || (groups[a] == groups[b] && groups[a] != VS_SHADE_FLAT);
}

/* Computes the normals at vertex v, and assigns them to its corners. */
static void shade_vertex(const shade_work *w, size_t v) {
  vs_shading *out = w->out;
  size_t first_normal = out->normal_count;
  for (uint32_t i = w->starts[v]; i < w->starts[v + 1]; i++) {
    uint32_t corner = w->around[i];
    vs_vec3 own = w->faces[corner / 3], sum = vs_v3(0, 0, 0);
    for (uint32_t k = w->starts[v]; k < w->starts[v + 1]; k++) {
      vs_vec3 other = w->faces[w->around[k] / 3];
      if (shade_together(w, corner / 3, w->around[k] / 3) && vs_v3_dot(own, other) >= w->least)
        sum = vs_v3_add(sum, vs_v3_scale(other, w->angles[w->around[k]]));
    }
    vs_vec3 normal = shade_unit(sum);
    if (vs_v3_length(normal) < 0.5) normal = own;
    if (vs_v3_length(normal) < 0.5) normal = vs_v3(0, 0, 1); /* the triangle is a needle: it has no normal, so any
                                                              * direction will do */
    size_t at = first_normal;
    while (at < out->normal_count && vs_v3_dot(out->normals[at], normal) < 1 - 1e-9) at++;
    if (at == out->normal_count) out->normals[out->normal_count++] = normal;
    out->corners[corner / 3][corner % 3] = (uint32_t)at;
  }
}

/* Frees the unused part of the arrays, which is large because usually several corners have the same normal. */
static void shade_trim(vs_shading *s) {
  size_t room = s->normal_count + 1;
  vs_vec3 *less = s->memory(s->context, s->normals, s->normal_room * sizeof *less, room * sizeof *less);
  if (less) s->normals = less, s->normal_room = room;
}

/* Computes the normal of each face, the angle at each of its corners, and the number of corners at each vertex. */
static bool shade_measure(vs_emitter *e, shade_work *w) {
  const vs_vec3 *v = w->of->vertices;
  for (size_t i = 0; i < w->of->triangle_count; i++) {
    const uint32_t *t = w->of->triangles[i];
    w->faces[i] = shade_unit(vs_v3_cross(vs_v3_sub(v[t[1]], v[t[0]]), vs_v3_sub(v[t[2]], v[t[0]])));
    for (int k = 0; k < 3; k++) {
      w->angles[3 * i + (size_t)k] = shade_angle(v, t, k);
      w->starts[t[k] + 2]++;
    }
    if (!vs_emit_going(e, i)) return false;
  }
  return true;
}

/* Sorts the corners by their vertices. starts[v + 1] begins as the position of v's first corner, and moves to the
 * position after its last corner. */
static void shade_gather(shade_work *w) {
  for (size_t i = 2; i < w->of->vertex_count + 2; i++) w->starts[i] += w->starts[i - 1];
  for (size_t c = 0; c < 3 * w->of->triangle_count; c++)
    w->around[w->starts[w->of->triangles[c / 3][c % 3] + 1]++] = (uint32_t)c;
}

static bool shade_vertices(vs_emitter *e, const shade_work *w) {
  for (size_t v = 0; v < w->of->vertex_count; v++) {
    shade_vertex(w, v);
    if (!vs_emit_going(e, v)) return false;
  }
  return true;
}

bool vs_shading_make_in(vs_emitter *e, vs_shade_memory *memory, void *context, const vs_shade_faces *faces,
                        vs_shading *out) {
  *out = (vs_shading){ .memory = memory, .context = context };
  shade_work w = { .of = faces, .out = out, .least = cos(faces->crease) };
  bool ok = (shade_work_new(&w) || vs_emit_no_memory(e)) && shade_measure(e, &w);
  if (ok) shade_gather(&w);
  ok = ok && shade_vertices(e, &w);
  if (ok) shade_trim(out);
  shade_work_free(&w);
  if (!ok) vs_shading_free(out);
  return ok;
}

static void *shade_store(void *store, void *old, size_t old_bytes, size_t new_bytes) {
  return vs_store_realloc(store, old, old_bytes, new_bytes);
}

bool vs_shading_make(vs_emitter *e, const vs_shade_faces *faces, vs_shading *out) {
  return vs_shading_make_in(e, shade_store, e->scene->store, faces, out);
}

bool vs_shaded_make(vs_emitter *e, const vs_solid *solid, const vs_affine *place, double crease, vs_shaded_solid *out) {
  *out = (vs_shaded_solid){ .solid = solid, .place = place, .mirrored = vs_affine_determinant(place) < 0 };
  vs_shade_faces faces = vs_shade_mesh(&solid->mesh, crease);
  if (!vs_shading_make(e, &faces, &out->shading)) return false;
  size_t room = out->shading.normal_count + 1;
  out->vertex = vs_store_realloc(e->scene->store, NULL, 0, room * sizeof *out->vertex);
  return out->vertex != NULL || vs_emit_no_memory(e);
}

void vs_shaded_free(vs_emitter *e, vs_shaded_solid *s) {
  vs_emit_release(e, s->vertex, s->shading.normal_count + 1, sizeof *s->vertex);
  s->vertex = NULL;
  vs_shading_free(&s->shading);
}

void vs_shaded_begin_part(vs_shaded_solid *s) {
  memset(s->vertex, 0xff, s->shading.normal_count * sizeof *s->vertex);
}
