/* Chooses the lines of a mesh that a view shows. See hidden_lines.h.
 *
 * Each side of a triangle is an element of a list, sorted by its two points. The elements with equal points are the
 * faces around an edge. A face is seen from the front, from the back, or edge-on (within 1e-7), which counts as
 * neither. At the contour of a smooth surface, the line lies between the last visible face and the next face. */
#include "solids/sight_edges.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/files/polyface.h"
#include "model/store/patient_sort.h"

static const double sharp = 0.9396926207859084; /* cosine of 20 degrees; if the directions of two faces differ by more,
                                                 * their edge is drawn as a crease */

typedef struct { uint64_t key; uint32_t face; bool forward; } side;

static int side_compare(const void *p, const void *q) {
  const side *a = p, *b = q;
  return a->key != b->key ? (a->key < b->key ? -1 : 1) : a->face < b->face ? -1 : a->face > b->face;
}

typedef struct { vs_vec3 normal; int8_t front; } face;
    /* Computes the data of face i. front: 1 if the viewer sees its front, -1 if the back, 0 if it is seen edge-on or
     * has no area. */

static face face_of(const vs_sight *s, const uint32_t *place, size_t i) {
  const uint32_t *t = s->triangles[i];
  vs_vec3 a = s->points[place[t[0]]], b = s->points[place[t[1]]], c = s->points[place[t[2]]];
  face f = { vs_v3_unit(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a))), 0 };
  vs_vec3 ray = s->perspective ? vs_v3_unit(vs_v3_scale(vs_v3_add(vs_v3_add(a, b), c), 1. / 3)) : vs_v3(0, 0, 1);
  double towards = -vs_v3_dot(f.normal, ray);
  f.front = towards > 1e-7 ? 1 : towards < -1e-7 ? -1 : 0;
  return f;
}

/* Returns true if two faces have different paints, owners or objects, so that a line is between them. */
static bool are_apart(const vs_sight *s, uint32_t a, uint32_t b) {
  return (s->paints && s->paints[a] != s->paints[b]) || (s->owners && s->owners[a] != s->owners[b]) ||
         (s->objects && s->objects[a] != s->objects[b]);
}

/* Returns the kind of line at the edge between the faces of the sides a and b. Returns VS_SIGHT_KINDS if there is no
 * line. */
static vs_sight_kind kind_between(const vs_sight *s, const face *faces, const side *a, const side *b) {
  const face *f = &faces[a->face], *g = &faces[b->face];
  bool cap_f = s->caps && s->caps[a->face], cap_g = s->caps && s->caps[b->face];
  if (cap_f && cap_g) return are_apart(s, a->face, b->face) ? VS_SIGHT_PARTING : VS_SIGHT_KINDS;
  if (cap_f || cap_g) return VS_SIGHT_CUT;
  /* if both faces have their common edge in the same direction, the second is reversed */
  int turned = a->forward == b->forward ? -1 : 1;
  int p = f->front, q = g->front * turned;
  bool thin = a->face >= s->closed || b->face >= s->closed; /* true if the faces belong to a surface without thickness,
                                                             * so that they are visible from both sides */
  if (thin && p + q < 0) p = -p, q = -q;
  if (p <= 0 && q <= 0) return VS_SIGHT_KINDS;
  if (p <= 0 || q <= 0) return VS_SIGHT_OUTLINE;
  double cosine = vs_v3_dot(f->normal, g->normal) * turned;
  return cosine < sharp || are_apart(s, a->face, b->face) ? VS_SIGHT_CREASE : VS_SIGHT_KINDS;
}

static bool add_edge(const vs_sight_host *host, vs_sight_edges *out, vs_sight_edge edge) {
  if (out->count == out->room && !vs_store_grow(host->store, &out->at, &out->room, out->count + 1,
      sizeof *out->at)) return false;
  out->at[out->count++] = edge;
  return true;
}

/* Returns the owner of an edge, whose sides in the faces are those from `first` to `end`: the owner of a face with its
 * front to the viewer, if there is one. */
static uint32_t owner_of(const vs_sight *s, const face *faces, const side *first, const side *end) {
  uint32_t owner = 0;
  for (const side *a = first; s->owners && a < end; a++)
    if (!owner || (s->owners[a->face] && faces[a->face].front > 0)) owner = s->owners[a->face];
  return owner;
}

bool vs_sight_find_edges(const vs_sight_host *host, const vs_sight *s, vs_sight_edges *out, vs_error *e) {
  size_t n = s->triangle_count, points = s->point_count, sides = 0;
  if (n == 0) return true;
  vs_store *store = host->store;
  uint32_t *place = vs_store_realloc(store, NULL, 0, (points + 1) * sizeof *place);
  side *all = vs_store_realloc(store, NULL, 0, 3 * n * sizeof *all);
  face *faces = vs_store_realloc(store, NULL, 0, n * sizeof *faces);
  bool ok = place && all && faces && vs_polyface_merge(s->points, points, place);
  for (size_t i = 0; ok && i < n; i++) {
    const uint32_t *t = s->triangles[i];
    faces[i] = face_of(s, place, i);
    for (int k = 0; k < 3; k++) {
      uint32_t a = place[t[k]], b = place[t[(k + 1) % 3]];
      if (a != b) all[sides++] = (side){ a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a, (uint32_t)i, a < b };
    }
  }
  bool going = ok && vs_store_sort(store, all, sides, sizeof *all, side_compare, e);
  for (size_t i = 0, end; ok && going && i < sides; i = end) {
    for (end = i; end < sides && all[end].key == all[i].key; end++) {}
    if ((i & 0xffff) == 0) going = vs_job_going(host->job, "drawing", -1);
    vs_sight_kind kind = VS_SIGHT_OUTLINE;
    if (end - i == 2) kind = kind_between(s, faces, &all[i], &all[i + 1]);
    else if (all[i].face < s->closed) { /* an edge with more than two faces of solids is drawn if the viewer sees one of
                                         * these faces */
      kind = VS_SIGHT_KINDS;
      for (size_t k = i; k < end; k++)
        if (faces[all[k].face].front > 0) kind = s->caps && s->caps[all[k].face] ? VS_SIGHT_CUT : VS_SIGHT_OUTLINE;
    }
    vs_sight_edge edge = { s->points[(uint32_t)(all[i].key >> 32)], s->points[(uint32_t)all[i].key], kind, s->slack,
                           owner_of(s, faces, &all[i], &all[end]) };
    if (kind != VS_SIGHT_KINDS) ok = add_edge(host, out, edge);
  }
  vs_store_realloc(store, place, (points + 1) * sizeof *place, 0);
  vs_store_realloc(store, all, 3 * n * sizeof *all, 0);
  vs_store_realloc(store, faces, n * sizeof *faces, 0);
  if (!ok) return vs_error_memory(e, NULL);
  if (!going && e->kind != VS_ERROR_NONE) return false; /* the sort was interrupted or memory is out; vs_store_sort has
                                                         * set the error */
  return going || vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
}

void vs_sight_edges_free(const vs_sight_host *host, vs_sight_edges *edges) {
  vs_store_realloc(host->store, edges->at, edges->room * sizeof *edges->at, 0);
  *edges = (vs_sight_edges){ 0 };
}
