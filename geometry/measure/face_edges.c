/* Implements the faces of a mesh (face_edges.h). Triangles on both sides of an edge that is not sharp are in one face.
 * A face that is neither plane nor round is then divided between facets of unequal widths, so that a straight wall and
 * the arc that it runs into become a plane and a cylinder. The sharp edges between two faces are joined end to end. */
#include "geometry/measure/face_edges.h"

#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"
#include "model/store/disjoint.h"

/* Least angle of a fold, in radians, that makes an edge sharp. WITHIN: within one round primitive; BETWEEN: between two
 * primitives of which one is round; ELSEWHERE: at all other edges. EXACT: allowed deviation from a plane or cylinder,
 * as a fraction of the mesh's size. */
static const double WITHIN = .5236, BETWEEN = .21, ELSEWHERE = 1e-4, EXACT = 1e-6;
/* FLAT: greatest angle in radians between triangles that count as coplanar. UNEQUAL: a face is divided between two
 * facets if one is this many times as wide as the other. */
static const double FLAT = 1e-3, UNEQUAL = 2;
static const double PI = 3.14159265358979323846;

void vs_mesh_faces_free(vs_mesh_faces *f) {
  free(f->of), free(f->faces), free(f->edges), free(f->at);
  *f = (vs_mesh_faces){ 0 };
}

/* Returns twice the area of triangle t times its unit normal. */
static vs_vec3 area_vector(const vs_mesh_edges *s, uint32_t t) {
  vs_vec3 a = vs_mesh_edges_place(s, t, 0), b = vs_mesh_edges_place(s, t, 1), c = vs_mesh_edges_place(s, t, 2);
  return vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
}

static int across(const vs_mesh_edges *s, uint32_t t, uint32_t e) {
  return s->of[t][0] == e ? 0 : s->of[t][1] == e ? 1 : 2;
}

/* Returns the angle in radians, measured within the material, between the two triangles at edge e; it is pi if they are
 * coplanar. */
static double angle_at(const vs_mesh_edges *s, uint32_t e) {
  uint32_t t = s->edges[e].side[0], u = s->edges[e].side[1];
  vs_vec3 n = vs_v3_unit(area_vector(s, t)), m = vs_v3_unit(area_vector(s, u));
  vs_vec3 far = vs_v3_sub(vs_mesh_edges_place(s, u, across(s, u, e)), s->m->vertices[s->edges[e].a]);
  double fold = atan2(vs_v3_length(vs_v3_cross(n, m)), vs_v3_dot(n, m));
  return vs_v3_dot(n, far) < 0 ? PI - fold : PI + fold;
}

static bool is_sharp(const vs_mesh_edges *s, const uint32_t *leaf, const bool *round, uint32_t e) {
  const vs_mesh_edge *g = &s->edges[e];
  if (g->side[0] == VS_MESH_NONE || g->side[1] == VS_MESH_NONE) return true;
  uint32_t t = g->side[0], u = g->side[1];
  double fold = fabs(angle_at(s, e) - PI);
  if (!round[t] && !round[u]) return fold > ELSEWHERE;
  return fold > (leaf[t] == leaf[u] ? WITHIN : BETWEEN);
}

/* ---- form of a face: plane, cylinder or other ---- */

typedef struct {
  const vs_mesh_edges *s;
  const uint32_t *list; /* the triangles of the face */
  size_t count;
  double size;
} face_triangles;

static bool is_plane(const face_triangles *f, const vs_mesh_face *face) {
  for (size_t i = 0; i < f->count; i++)
    for (int k = 0; k < 3; k++) {
      vs_vec3 p = vs_mesh_edges_place(f->s, f->list[i], k);
      if (!(fabs(vs_v3_dot(face->normal, vs_v3_sub(p, face->at))) <= EXACT * f->size)) return false;
    }
  return true;
}

/* Sets *axis to the axis direction of a possible cylinder: perpendicular to the first triangle's normal and to the
 * normal that differs most from it. Returns false if another normal is not perpendicular to this direction. */
static bool axis_of(const face_triangles *f, vs_vec3 *axis) {
  vs_vec3 n = vs_v3_unit(area_vector(f->s, f->list[0]));
  double most = 0;
  for (size_t i = 1; i < f->count; i++) {
    vs_vec3 c = vs_v3_cross(n, vs_v3_unit(area_vector(f->s, f->list[i])));
    if (vs_v3_length(c) > most) most = vs_v3_length(c), *axis = vs_v3_unit(c);
  }
  if (!(most > 1e-3)) return false;
  for (size_t i = 0; i < f->count; i++) {
    vs_vec3 v = area_vector(f->s, f->list[i]); /* area times normal: a thin triangle has an inexact normal, but counts
                                                * little because of its small area */
    if (fabs(vs_v3_dot(v, *axis)) > EXACT * f->size * sqrt(vs_v3_length(v))) return false;
  }
  return true;
}

/* Finds the circle through all corners of the triangles, as seen along the axis. Returns false if the corners lie on no
 * circle. */
static bool circle_of(const face_triangles *f, vs_vec3 axis, vs_vec3 *center, double *radius) {
  vs_vec3 a = vs_mesh_edges_place(f->s, f->list[0], 0), x, y;
  x = vs_v3_unit(vs_v3_cross(axis, fabs(axis.x) < .9 ? vs_v3(1, 0, 0) : vs_v3(0, 1, 0)));
  y = vs_v3_cross(axis, x);
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, sx = 0, sy = 0, sz = 0, n = 0;
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0; i < 3 * f->count; i++) {
      vs_vec3 d = vs_v3_sub(vs_mesh_edges_place(f->s, f->list[i / 3], (int)(i % 3)), a);
      double u = vs_v3_dot(d, x), v = vs_v3_dot(d, y), w = u * u + v * v;
      if (pass == 0) sx += u, sy += v, sz += w, n++;
      else u -= sx / n, v -= sy / n, w -= sz / n, xx += u * u, xy += u * v, yy += v * v, xz += u * w, yz += v * w;
    }
  double det = xx * yy - xy * xy;
  if (!(det > 1e-9 * (xx + yy) * (xx + yy))) return false;
  double cu = (xz * yy - yz * xy) / det / 2, cv = (yz * xx - xz * xy) / det / 2;
  *center = vs_v3_add(a, vs_v3_add(vs_v3_scale(x, cu), vs_v3_scale(y, cv)));
  *radius = 0;
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0; i < 3 * f->count; i++) {
      vs_vec3 d = vs_v3_sub(vs_mesh_edges_place(f->s, f->list[i / 3], (int)(i % 3)), *center);
      double r = vs_v3_length(vs_v3_cross(d, axis));
      if (pass == 0) *radius += r / (3. * (double)f->count);
      else if (fabs(r - *radius) > EXACT * f->size) return false;
    }
  return true;
}

static void describe(const face_triangles *f, vs_mesh_face *face) {
  vs_vec3 sum = { 0, 0, 0 }, middle = { 0, 0, 0 }, axis, center;
  double radius;
  for (size_t i = 0; i < f->count; i++) {
    vs_vec3 v = area_vector(f->s, f->list[i]), c = { 0, 0, 0 };
    double a = vs_v3_length(v);
    for (int k = 0; k < 3; k++) c = vs_v3_add(c, vs_mesh_edges_place(f->s, f->list[i], k));
    sum = vs_v3_add(sum, v), middle = vs_v3_add(middle, vs_v3_scale(c, a / 3)), face->area += a / 2;
  }
  face->first = f->list[0];
  face->at = vs_v3_scale(middle, face->area > 0 ? .5 / face->area : 0);
  face->normal = vs_v3_unit(sum);
  face->form = VS_FACE_OTHER;
  if (vs_v3_length(sum) > face->area && is_plane(f, face)) face->form = VS_FACE_PLANE;
  else if (axis_of(f, &axis) && circle_of(f, axis, &center, &radius)) {
    vs_vec3 d = vs_v3_sub(vs_mesh_edges_place(f->s, f->list[0], 0), center);
    vs_vec3 out = vs_v3_sub(d, vs_v3_scale(axis, vs_v3_dot(d, axis)));
    face->form = VS_FACE_CYLINDER;
    face->radius = vs_v3_dot(out, area_vector(f->s, f->list[0])) > 0 ? radius : -radius;
    face->at = vs_v3_add(center, vs_v3_scale(axis, vs_v3_dot(vs_v3_sub(face->at, center), axis)));
    face->normal = axis;
  }
}

typedef struct {
  uint32_t face, triangle;
} placed;

static int by_face(const void *p, const void *q) {
  const placed *a = p, *b = q;
  if (a->face != b->face) return a->face < b->face ? -1 : 1;
  return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static bool describe_all(const vs_mesh_edges *s, vs_mesh_faces *out) {
  size_t n = s->m->triangle_count;
  placed *p = NULL;
  uint32_t *list = NULL;
  vs_bounds b = vs_mesh_bounds(s->m);
  bool ok = VS_FRESH(p, n + 1) && VS_FRESH(list, n + 1) && VS_GROW(out->faces, out->face_room, out->face_count + 1);
  for (uint32_t t = 0; ok && t < n; t++) p[t] = (placed){ out->of[t], t };
  if (ok) qsort(p, n, sizeof *p, by_face);
  for (size_t i = 0; ok && i < n; i++) list[i] = p[i].triangle;
  for (size_t i = 0, f = 0; ok && f < out->face_count; f++) {
    size_t first = i;
    while (i < n && p[i].face == f) i++;
    out->faces[f] = (vs_mesh_face){ .area = 0 };
    describe(&(face_triangles){ s, list + first, i - first, vs_bounds_diagonal(&b) }, &out->faces[f]);
  }
  free(p), free(list);
  return ok;
}

/* ---- edges ---- */

/* An edge of the mesh between two faces; low, high: numbers of these faces. */
typedef struct {
  uint32_t low, high, edge;
  bool done;
} between;

static int by_faces(const void *p, const void *q) {
  const between *a = p, *b = q;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  if (a->high != b->high) return a->high < b->high ? -1 : 1;
  return a->edge < b->edge ? -1 : a->edge > b->edge;
}

/* Returns an edge of the list at vertex v that is not in a chain (row of edges) yet, or NULL. *uses: number of the
 * list's edges at v. */
static between *next_at(const vs_mesh_edges *s, between *list, size_t n, uint32_t v, size_t *uses) {
  between *found = NULL;
  *uses = 0;
  for (size_t i = 0; i < n; i++) {
    const vs_mesh_edge *g = &s->edges[list[i].edge];
    if (g->a != v && g->b != v) continue;
    ++*uses;
    if (!list[i].done) found = &list[i];
  }
  return found;
}

static bool add_point(vs_mesh_faces *out, vs_vec3 p) {
  if (!VS_GROW(out->at, out->room, out->count + 1)) return false;
  out->at[out->count++] = p;
  return true;
}

/* Adds a chain, a row of mesh edges that follow each other; it begins with the mesh edge `start` at vertex v. */
static bool add_chain(const vs_mesh_edges *s, between *list, size_t n, between *start, uint32_t v, vs_mesh_faces *out) {
  vs_face_edge e = { .face = { start->low, start->high }, .first = out->count };
  uint32_t from = v;
  e.angle = angle_at(s, start->edge);
  bool ok = add_point(out, s->m->vertices[v]);
  for (between *b = start; ok && b;) {
    const vs_mesh_edge *g = &s->edges[b->edge];
    size_t uses;
    b->done = true;
    v = g->a == v ? g->b : g->a;
    e.closed = v == from;
    if (!e.closed) ok = add_point(out, s->m->vertices[v]);
    b = next_at(s, list, n, v, &uses);
    if (uses != 2 || e.closed) b = NULL;
  }
  e.count = out->count - e.first;
  if (!ok || !VS_GROW(out->edges, out->edge_room, out->edge_count + 1)) return false;
  out->edges[out->edge_count++] = e;
  return true;
}

/* Adds the chains (rows of mesh edges) between two faces: first the chains that have ends, then the closed chains. */
static bool add_chains(const vs_mesh_edges *s, between *list, size_t n, vs_mesh_faces *out) {
  bool ok = true;
  size_t uses;
  for (size_t i = 0; ok && i < n; i++)
    for (int k = 0; ok && !list[i].done && k < 2; k++) {
      uint32_t v = k ? s->edges[list[i].edge].b : s->edges[list[i].edge].a;
      next_at(s, list, n, v, &uses);
      if (uses != 2) ok = add_chain(s, list, n, &list[i], v, out);
    }
  for (size_t i = 0; ok && i < n; i++)
    if (!list[i].done) ok = add_chain(s, list, n, &list[i], s->edges[list[i].edge].a, out);
  return ok;
}

static bool find_edges(const vs_mesh_edges *s, const bool *sharp, vs_mesh_faces *out) {
  between *list = NULL;
  size_t n = 0;
  bool ok = VS_FRESH(list, s->edge_count + 1);
  for (uint32_t e = 0; ok && e < s->edge_count; e++) {
    if (!sharp[e] || s->edges[e].side[0] == VS_MESH_NONE || s->edges[e].side[1] == VS_MESH_NONE) continue;
    uint32_t a = out->of[s->edges[e].side[0]], b = out->of[s->edges[e].side[1]];
    list[n++] = (between){ a < b ? a : b, a < b ? b : a, e, false };
  }
  if (ok) qsort(list, n, sizeof *list, by_faces);
  for (size_t i = 0; ok && i < n;) {
    size_t first = i;
    while (i < n && list[i].low == list[first].low && list[i].high == list[first].high) i++;
    ok = add_chains(s, list + first, i - first, out);
  }
  free(list);
  return ok;
}

/* ---- the division of triangles ---- */

typedef struct {
  const vs_mesh_edges *s;
  const uint32_t *leaf;
  const bool *round;
  bool *sharp;     /* sharp[e]: true if edge e of the mesh is sharp */
  double *width;   /* width[t]: width of the facet that contains triangle t, across the longest fold at its border */
  uint32_t *up;    /* parents of the triangles in a union-find structure, whose sets become the faces */
} division;

static bool is_flat(const vs_mesh_edges *s, uint32_t e) { return fabs(angle_at(s, e) - PI) <= FLAT; }

/* Computes the widths of facets (coplanar triangles): a facet's area divided by its longest edge to another facet. */
static bool widths(division *d) {
  const vs_mesh_edges *s = d->s;
  size_t n = s->m->triangle_count;
  double *area = NULL, *longest = NULL;
  bool ok = VS_FRESH(area, n + 1) && VS_FRESH(longest, n + 1);
  for (uint32_t t = 0; ok && t < n; t++) d->up[t] = t, area[t] = longest[t] = 0;
  for (uint32_t e = 0; ok && e < s->edge_count; e++)
    if (!d->sharp[e] && is_flat(s, e)) vs_unite(d->up, s->edges[e].side[0], s->edges[e].side[1]);
  for (uint32_t t = 0; ok && t < n; t++) area[vs_find(d->up, t)] += vs_v3_length(area_vector(s, t)) / 2;
  for (uint32_t e = 0; ok && e < s->edge_count; e++) {
    const vs_mesh_edge *g = &s->edges[e];
    double l = vs_v3_length(vs_v3_sub(s->m->vertices[g->a], s->m->vertices[g->b]));
    for (int k = 0; k < 2; k++) {
      if (g->side[k] == VS_MESH_NONE || (!d->sharp[e] && is_flat(s, e))) continue;
      uint32_t r = vs_find(d->up, g->side[k]);
      longest[r] = fmax(longest[r], l);
    }
  }
  for (uint32_t t = 0; ok && t < n; t++) {
    uint32_t r = vs_find(d->up, t);
    d->width[t] = longest[r] > 0 ? area[r] / longest[r] : 0;
  }
  free(area), free(longest);
  return ok;
}

/* Returns true if the two triangles beside edge e belong to one face. fine: true if facets of unequal widths belong to
 * different faces. */
static bool joined(const division *d, uint32_t e, bool fine) {
  uint32_t t = d->s->edges[e].side[0], u = d->s->edges[e].side[1];
  if (is_flat(d->s, e)) return true;
  if (d->leaf[t] != d->leaf[u]) return false;
  return !fine || (d->width[t] < UNEQUAL * d->width[u] && d->width[u] < UNEQUAL * d->width[t]);
}

/* Divides the triangles into faces; writes the face of each triangle to out->of, and the faces to out->faces. */
static bool divide(division *d, bool fine, vs_mesh_faces *out) {
  const vs_mesh_edges *s = d->s;
  size_t n = s->m->triangle_count;
  uint32_t *name = NULL;
  bool ok = VS_FRESH(name, n + 1) && VS_FRESH(out->of, n + 1);
  for (uint32_t t = 0; ok && t < n; t++) d->up[t] = t, name[t] = UINT32_MAX;
  for (uint32_t e = 0; ok && e < s->edge_count; e++)
    if (!d->sharp[e] && joined(d, e, fine)) vs_unite(d->up, s->edges[e].side[0], s->edges[e].side[1]);
  for (uint32_t t = 0; ok && t < n; t++) {
    uint32_t r = vs_find(d->up, t);
    if (name[r] == UINT32_MAX) name[r] = (uint32_t)out->face_count++;
    out->of[t] = name[r];
  }
  free(name);
  return ok && describe_all(s, out);
}

/* Divides each face of out that is neither plane nor round into the smaller faces of `fine`, if each of the smaller
 * ones is plane or round. */
static bool refine(const vs_mesh_edges *s, const vs_mesh_faces *fine, vs_mesh_faces *out) {
  size_t n = s->m->triangle_count;
  bool *better = NULL, ok = VS_FRESH(better, out->face_count + 1);
  uint32_t *name = NULL, count = 0;
  ok = ok && VS_FRESH(name, out->face_count + fine->face_count + 1);
  for (size_t i = 0; ok && i < out->face_count; i++) better[i] = out->faces[i].form == VS_FACE_OTHER;
  for (size_t t = 0; ok && t < n; t++)
    if (fine->faces[fine->of[t]].form == VS_FACE_OTHER) better[out->of[t]] = false;
  for (size_t i = 0; ok && i < out->face_count + fine->face_count; i++) name[i] = UINT32_MAX;
  for (size_t t = 0; ok && t < n; t++) {
    size_t k = better[out->of[t]] ? out->face_count + fine->of[t] : out->of[t];
    if (name[k] == UINT32_MAX) name[k] = count++;
    out->of[t] = name[k];
  }
  free(better), free(name);
  if (!ok) return false;
  out->face_count = count;
  return describe_all(s, out);
}

bool vs_mesh_faces_find(const vs_mesh_edges *s, const uint32_t *leaf, const bool *round, vs_mesh_faces *out) {
  size_t n = s->m->triangle_count;
  division d = { .s = s, .leaf = leaf, .round = round };
  vs_mesh_faces fine = { 0 };
  *out = (vs_mesh_faces){ 0 };
  bool ok = VS_FRESH(d.up, n + 1) && VS_FRESH(d.width, n + 1) && VS_FRESH(d.sharp, s->edge_count + 1);
  for (uint32_t e = 0; ok && e < s->edge_count; e++) d.sharp[e] = is_sharp(s, leaf, round, e);
  ok = ok && widths(&d) && divide(&d, false, out) && divide(&d, true, &fine) && refine(s, &fine, out) &&
       find_edges(s, d.sharp, out);
  vs_mesh_faces_free(&fine);
  free(d.up), free(d.width), free(d.sharp);
  return ok;
}
