/* Computes convex hulls.
 *
 * In space, the method is quickhull (Barber, Dobkin, Huhdanpaa 1996), and every decision is exact. Points are rounded
 * to a grid of 2^40 steps over their extent. The side of a point relative to three others is then the sign of an
 * integer of 123 bits. A new point removes the faces that it lies above or in whose planes it lies. Therefore no face
 * has area 0. The points of a flat facet are joined by triangles, and points inside the facet are omitted.
 *
 *   above[f]   a list of points that lie outside the current hull and above face f, each in one list only
 *   horizon    the edges around the faces that a point removes: each becomes a face with the point
 *
 * In a plane, the method is Andrew's chain, on a grid of the same kind. Both methods take n log n steps for points as
 * they occur in models. */
#include "geometry/shapes/hull.h"

#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

__extension__ typedef __int128 vs_wide;

void vs_cloud_free(vs_cloud *c) {
  free(c->at);
  *c = (vs_cloud){ 0 };
}

bool vs_cloud_add(vs_cloud *c, vs_vec3 p) {
  if (c->count >= UINT32_MAX / 4 || !VS_GROW(c->at, c->room, c->count + 1)) return false;
  c->at[c->count++] = p;
  return true;
}

/* ---- dimension and extent of the points ---- */

/* Returns the dimension of the points (0 to 3), or -1 if there are none. Sets corner[0] to the point farthest from the
 * middle of the points. Sets corner[k], for each k up to the dimension, to the point farthest from the point, line or
 * plane that the corners before it span. */
static int cloud_span(const vs_cloud *c, uint32_t corner[4]) {
  if (!c->count) return -1;
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < c->count; i++) vs_bounds_add(&b, c->at[i]);
  double size = vs_bounds_diagonal(&b), nothing = 1e-9 * size;
  vs_vec3 middle = vs_v3_scale(vs_v3_add(b.min, b.max), 0.5), x = { 0, 0, 0 }, n = { 0, 0, 0 };
  for (int k = 0; k < 4; k++) {
    double most = -1;
    corner[k] = 0;
    for (size_t i = 0; i < c->count; i++) {
      vs_vec3 d = vs_v3_sub(c->at[i], k ? c->at[corner[0]] : middle);
      double off = k < 2 ? vs_v3_length(d) : k == 2 ? vs_v3_length(vs_v3_cross(x, d)) : fabs(vs_v3_dot(n, d));
      if (off > most) most = off, corner[k] = (uint32_t)i;
    }
    if (k && !(most > nothing)) return k - 1;
    vs_vec3 d = vs_v3_sub(c->at[corner[k]], c->at[corner[0]]);
    if (k == 1) x = vs_v3_unit(d);
    if (k == 2) n = vs_v3_unit(vs_v3_cross(x, d));
  }
  return 3;
}

int vs_cloud_dimension(const vs_cloud *c) {
  uint32_t corner[4];
  return cloud_span(c, corner);
}

/* ---- the grid ---- */

typedef struct { int64_t x, y, z; } vs_step;

static vs_step *cloud_steps(const vs_cloud *c) {
  vs_step *s = vs_fresh(c->count, sizeof *s);
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < c->count; i++) vs_bounds_add(&b, c->at[i]);
  vs_vec3 o = vs_v3_scale(vs_v3_add(b.min, b.max), 0.5), d = vs_v3_sub(b.max, b.min);
  int exponent;
  frexp(fmax(d.x, fmax(d.y, d.z)), &exponent); /* exponent: the extent d is below 2^exponent, and becomes steps from
                                                * -2^39 to 2^39 */
  for (size_t i = 0; s && i < c->count; i++) {
    vs_vec3 p = vs_v3_sub(c->at[i], o);
    s[i] = (vs_step){ (int64_t)nearbyint(ldexp(p.x, 40 - exponent)), (int64_t)nearbyint(ldexp(p.y, 40 - exponent)),
                      (int64_t)nearbyint(ldexp(p.z, 40 - exponent)) };
  }
  return s;
}

/* Returns six times the volume of the tetrahedron of the points v[0], v[1], v[2] and d. It is positive if d lies on the
 * side from which v[0], v[1], v[2] are counter-clockwise. */
static vs_wide steps_volume(const vs_step *s, const uint32_t v[3], uint32_t d) {
  vs_step a = s[v[0]], b = s[v[1]], c = s[v[2]];
  int64_t ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, wx = c.x - a.x, wy = c.y - a.y, wz = c.z - a.z;
  return ((vs_wide)uy * wz - (vs_wide)uz * wy) * (s[d].x - a.x) +
         ((vs_wide)uz * wx - (vs_wide)ux * wz) * (s[d].y - a.y) +
         ((vs_wide)ux * wy - (vs_wide)uy * wx) * (s[d].z - a.z);
}

/* ---- hulls in space ---- */

#define NOBODY UINT32_MAX

typedef struct {
  uint32_t v[3], next[3]; /* v: point numbers of the face's corners; next[k]: face on the other side of the edge that
                           * begins at v[k] */
  uint32_t above, mark;   /* above: first point in the list of points above the face; mark: number of the last addition
                           * of a point that has visited the face */
  bool dead;
} vs_hull_face;

typedef struct {
  const vs_step *steps;
  vs_hull_face *faces;
  size_t count, room;
  uint32_t *next_above;            /* next_above[p]: point after p in the list of points above a face that contains p */
  uint32_t *waiting, *horizon;     /* waiting: faces that must still be visited while a point is added; horizon: the
                                    * edges around the removed faces, each as a face and the index of its edge */
  size_t waiting_room, horizon_room;
  uint32_t *leaving;               /* leaving[p]: the new face whose edge on the horizon starts at point p */
} vs_quickhull;

/* Adds the face with the different corners a, b and c, and sets *out to its number. */
static bool hull_face_new(vs_quickhull *h, uint32_t a, uint32_t b, uint32_t c, uint32_t *out) {
  VS_ASSERT(a != b && b != c && c != a);
  if (!VS_GROW(h->faces, h->room, h->count + 1)) return false;
  h->faces[h->count] = (vs_hull_face){ .v = { a, b, c }, .next = { NOBODY, NOBODY, NOBODY }, .above = NOBODY };
  *out = (uint32_t)h->count++;
  return true;
}

/* Searches the faces `from` to `to` - 1 for the first one below point p, and adds p to the list of points above that
 * face. from <= to <= h->count. */
static void hull_assign(vs_quickhull *h, uint32_t p, uint32_t from, uint32_t to) {
  VS_ASSERT(from <= to && to <= h->count);
  for (uint32_t f = from; f < to; f++) {
    if (steps_volume(h->steps, h->faces[f].v, p) <= 0) continue;
    h->next_above[p] = h->faces[f].above;
    h->faces[f].above = p;
    return;
  }
}

static bool hull_start(vs_quickhull *h, const uint32_t corner[4], size_t points) {
  uint32_t v[4] = { corner[0], corner[1], corner[2], corner[3] }, f;
  /* Orders the tetrahedron's corners: the fourth lies below the face of the first three. */
  if (steps_volume(h->steps, v, v[3]) > 0) v[1] = corner[2], v[2] = corner[1];
  static const unsigned char faces[4][3] = { { 0, 1, 2 }, { 0, 3, 1 }, { 1, 3, 2 }, { 2, 3, 0 } };
  for (int i = 0; i < 4; i++)
    if (!hull_face_new(h, v[faces[i][0]], v[faces[i][1]], v[faces[i][2]], &f)) return false;
  for (uint32_t i = 0; i < 4; i++)
    for (uint32_t k = 0; k < 3; k++)
      for (uint32_t j = 0; j < 12; j++)
        if (h->faces[j / 3].v[j % 3] == h->faces[i].v[(k + 1) % 3] &&
            h->faces[j / 3].v[(j + 1) % 3] == h->faces[i].v[k])
          h->faces[i].next[k] = j / 3;
  for (size_t p = 0; p < points; p++) hull_assign(h, (uint32_t)p, 0, 4);
  return true;
}

/* Adds point p: collects the faces that p lies above, and so removes, in `waiting`, and the edges around these faces in
 * `horizon`. first: one of these faces. */
static bool hull_take(vs_quickhull *h, uint32_t first, uint32_t p, uint32_t step, size_t *taken, size_t *edges) {
  *taken = *edges = 0;
  if (!VS_GROW(h->waiting, h->waiting_room, 1)) return false;
  h->waiting[(*taken)++] = first;
  h->faces[first].mark = step;
  for (size_t at = 0; at < *taken; at++) {
    uint32_t f = h->waiting[at];
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t other = h->faces[f].next[k];
      if (h->faces[other].mark == step) continue;
      if (steps_volume(h->steps, h->faces[other].v, p) < 0) continue;
      if (!VS_GROW(h->waiting, h->waiting_room, *taken + 1)) return false;
      h->faces[other].mark = step;
      h->waiting[(*taken)++] = other;
    }
  }
  for (size_t at = 0; at < *taken; at++)
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t f = h->waiting[at];
      if (h->faces[h->faces[f].next[k]].mark == step) continue;
      if (!VS_GROW(h->horizon, h->horizon_room, 2 * (*edges + 1))) return false;
      h->horizon[2 * *edges] = f;
      h->horizon[2 * (*edges)++ + 1] = k;
    }
  return true;
}

static bool hull_add(vs_quickhull *h, uint32_t face, uint32_t step) {
  uint32_t p = h->faces[face].above;
  size_t taken, edges;
  vs_wide most = 0;
  for (uint32_t q = p; q != NOBODY; q = h->next_above[q]) {
    vs_wide off = steps_volume(h->steps, h->faces[face].v, q);
    if (off > most) most = off, p = q;
  }
  if (!hull_take(h, face, p, step, &taken, &edges)) return false;
  uint32_t first = (uint32_t)h->count, made;
  for (size_t i = 0; i < edges; i++) {
    uint32_t f = h->horizon[2 * i], k = h->horizon[2 * i + 1], a = h->faces[f].v[k], b = h->faces[f].v[(k + 1) % 3],
             other = h->faces[f].next[k];
    if (!hull_face_new(h, a, b, p, &made)) return false;
    h->faces[made].next[0] = other;
    for (uint32_t j = 0; j < 3; j++)
      if (h->faces[other].v[j] == b && h->faces[other].v[(j + 1) % 3] == a) h->faces[other].next[j] = made;
    h->leaving[a] = made;
  }
  for (uint32_t f = first; f < h->count; f++) {
    uint32_t after = h->leaving[h->faces[f].v[1]];
    h->faces[f].next[1] = after;
    h->faces[after].next[2] = f;
  }
  for (size_t i = 0; i < taken; i++) {
    vs_hull_face *dead = &h->faces[h->waiting[i]];
    for (uint32_t q = dead->above, following; q != NOBODY; q = following) {
      following = h->next_above[q];
      if (q != p) hull_assign(h, q, first, (uint32_t)h->count);
    }
    dead->above = NOBODY;
    dead->dead = true;
  }
  return true;
}

static bool hull_write(const vs_quickhull *h, const vs_cloud *c, vs_mesh *out) {
  bool ok = true;
  for (size_t i = 0; i < c->count; i++) h->leaving[i] = NOBODY; /* from here on, leaving[p] is the vertex of point p in
                                                                 * the mesh */
  for (size_t f = 0; ok && f < h->count; f++) {
    const vs_hull_face *face = &h->faces[f];
    if (face->dead) continue;
    for (int k = 0; ok && k < 3; k++)
      if (h->leaving[face->v[k]] == NOBODY) ok = vs_mesh_add_vertex(out, c->at[face->v[k]], &h->leaving[face->v[k]]);
    ok = ok && vs_mesh_add_triangle(out, h->leaving[face->v[0]], h->leaving[face->v[1]], h->leaving[face->v[2]]);
  }
  return ok;
}

bool vs_cloud_hull(const vs_cloud *c, vs_mesh *out) {
  uint32_t corner[4];
  if (cloud_span(c, corner) < 3) return true;
  vs_step *steps = cloud_steps(c);
  vs_quickhull h = { .steps = steps,
                     .next_above = vs_fresh(c->count, sizeof *h.next_above),
                     .leaving = vs_fresh(c->count, sizeof *h.leaving) };
  bool ok = steps && h.next_above && h.leaving && hull_start(&h, corner, c->count);
  for (uint32_t f = 0, step = 0; ok && f < h.count; f++)
    if (!h.faces[f].dead && h.faces[f].above != NOBODY) ok = hull_add(&h, f, ++step); /* adds the farthest of the points
                                                                                       * above face f to the hull, which
                                                                                       * removes f; the new faces follow
                                                                                       * at the end of the array */
  ok = ok && hull_write(&h, c, out);
  free(steps);
  free(h.next_above);
  free(h.leaving);
  free(h.waiting);
  free(h.horizon);
  free(h.faces);
  return ok;
}

/* ---- hulls in a plane ---- */

typedef struct { int64_t u, v; uint32_t point; } vs_flat_step;

static int flat_compare(const void *a, const void *b) {
  const vs_flat_step *p = a, *q = b;
  if (p->u != q->u) return p->u < q->u ? -1 : 1;
  if (p->v != q->v) return p->v < q->v ? -1 : 1;
  return p->point < q->point ? -1 : p->point > q->point;
}

/* Returns true if b is left of the line from a to c by more steps than rounding can move a point. */
static bool flat_left(const vs_flat_step *a, const vs_flat_step *b, const vs_flat_step *c) {
  int64_t du = c->u - a->u, dv = c->v - a->v;
  return (vs_wide)(b->u - a->u) * dv - (vs_wide)(b->v - a->v) * du >
         4 * ((vs_wide)(du < 0 ? -du : du) + (dv < 0 ? -dv : dv));
}

bool vs_cloud_polygon(const vs_cloud *c, vs_polyline *out) {
  uint32_t corner[4];
  int dimension = cloud_span(c, corner), drop = 2;
  *out = (vs_polyline){ .closed = true };
  if (dimension < 1) return true;
  vs_vec3 n = { 0, 0, 0 };
  if (dimension > 1)
    n = vs_v3_cross(vs_v3_sub(c->at[corner[1]], c->at[corner[0]]), vs_v3_sub(c->at[corner[2]], c->at[corner[0]]));
  else { /* the points lie on a line: any plane through the line is suitable, unless it is perpendicular to the plane of
          * projection */
    vs_vec3 d = vs_v3_sub(c->at[corner[1]], c->at[corner[0]]);
    n = fabs(d.x) <= fabs(d.y) && fabs(d.x) <= fabs(d.z) ? vs_v3(1, 0, 0)
        : fabs(d.y) <= fabs(d.z)                         ? vs_v3(0, 1, 0)
                                                         : vs_v3(0, 0, 1);
  }
  if (fabs(n.x) >= fabs(n.y) && fabs(n.x) >= fabs(n.z)) drop = 0;
  else if (fabs(n.y) >= fabs(n.z)) drop = 1;
  vs_step *steps = cloud_steps(c);
  vs_flat_step *at = vs_fresh(c->count, sizeof *at), *chain = vs_fresh(2 * c->count + 1, sizeof *chain);
  bool ok = steps && at && chain;
  for (size_t i = 0; ok && i < c->count; i++) {
    vs_step s = steps[i];
    at[i] = (vs_flat_step){ drop == 0   ? s.y
                            : drop == 1 ? s.z
                                        : s.x,
                            drop == 0   ? s.z
                            : drop == 1 ? s.x
                                        : s.y,
                            (uint32_t)i };
  }
  size_t count = 0;
  if (ok) qsort(at, c->count, sizeof *at, flat_compare);
  for (int way = 0; ok && way < 2; way++) { /* the first pass makes the lower chain from left to right, the second the
                                             * upper chain from right to left */
    size_t first = count;
    for (size_t i = 0; i < c->count; i++) {
      const vs_flat_step *p = &at[way ? c->count - 1 - i : i];
      while (count >= first + 2 && !flat_left(&chain[count - 2], &chain[count - 1], p)) count--;
      if (count > first && chain[count - 1].u == p->u && chain[count - 1].v == p->v) continue;
      chain[count++] = *p;
    }
    count--; /* removes the last point of the chain (half of the hull), because the other chain begins with it */
  }
  out->at = ok ? vs_fresh(count, sizeof *out->at) : NULL;
  ok = out->at != NULL;
  for (size_t i = 0; ok && i < count; i++) out->at[i] = c->at[chain[i].point];
  out->count = out->room = ok ? count : 0;
  free(steps);
  free(at);
  free(chain);
  return ok;
}

/* ---- the parts of a hull node ---- */

typedef struct { const vs_ref *ref; vs_affine placed; } vs_hull_part;

bool vs_cloud_add_all(vs_cloud *out, const vs_affine *placed, const vs_vec3 *at, size_t count, vs_error *e) {
  for (size_t i = 0; i < count; i++)
    if (!vs_cloud_add(out, vs_affine_point(placed, at[i]))) return vs_error_memory(e, NULL);
  return true;
}

bool vs_hull_cloud(const vs_node *hull, vs_hull_leaf *leaf, const vs_fineness *f, vs_cloud *out, vs_error *e) {
  vs_ref root = { (vs_node *)(uintptr_t)hull, NULL };
  vs_hull_part *stack = vs_fresh(1, sizeof *stack);
  size_t depth = 0, room = 1;
  bool ok = stack || vs_error_memory(e, NULL);
  if (ok) stack[depth++] = (vs_hull_part){ &root, vs_affine_identity() };
  while (ok && depth) {
    vs_hull_part part = stack[--depth];
    const vs_node *n = part.ref->node;
    if (n->kind == VS_TRANSFORM) part.placed = vs_affine_multiply(&part.placed, &VS_AS(transform, n)->matrix);
    if (n->kind == VS_HULL)
      ok = vs_cloud_add_all(out, &part.placed, VS_AS(hull, n)->points->at, VS_AS(hull, n)->points->count, e);
    if (n->kind == VS_TRANSFORM || vs_node_is_wrapper(n) || n->kind == VS_UNION || n->kind == VS_HULL) {
      if (ok && !VS_GROW(stack, room, depth + n->child_count)) ok = vs_error_memory(e, NULL);
      for (uint32_t i = n->child_count; ok && i-- > 0;) stack[depth++] = (vs_hull_part){ &n->children[i], part.placed };
    } else if (ok) {
      vs_fineness inner = vs_fineness_placed(f, &part.placed);
      ok = leaf(n, &part.placed, &inner, out, e);
      if (!ok && e && !e->origin) e->origin = part.ref->origin;
    }
  }
  free(stack);
  return ok;
}
