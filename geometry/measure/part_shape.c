/* Implements the comparison of parts (part_shape.h). Moments do not change if a part is moved or turned, so parts with
 * different moments differ. If the moments are equal, the code searches for a motion that moves the corners of one part
 * to those of the other; moments alone hardly distinguish a slender part from its mirror image. */
#include "geometry/measure/part_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/assert.h"
#include "model/store/array.h"

/* ---- moments ---- */

/* Weighted sums over the points of a part. */
typedef struct {
  vs_vec3 origin;
  double measure;
  vs_vec3 first;          /* weighted sum of the vectors p from `origin` to the points */
  double second[3][3];    /* weighted sum of the outer products p p^T */
  vs_vec3 third;          /* weighted sum of the vectors p, each times the square of its length */
} sums;

static void add(sums *s, vs_vec3 at, double weight) {
  const vs_vec3 p = vs_v3_sub(at, s->origin);
  const double c[3] = { p.x, p.y, p.z };
  s->measure += weight;
  s->first = vs_v3_add(s->first, vs_v3_scale(p, weight));
  s->third = vs_v3_add(s->third, vs_v3_scale(p, weight * vs_v3_dot(p, p)));
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) s->second[i][j] += weight * c[i] * c[j];
}

static vs_vec3 between(const vs_vec3 *p, const double *share, int n) {
  vs_vec3 sum = { 0, 0, 0 };
  for (int i = 0; i < n; i++) sum = vs_v3_add(sum, vs_v3_scale(p[i], share[i]));
  return sum;
}

/* Adds the integral over a simplex with n corners: a segment (n = 2), a triangle (3) or a tetrahedron (4). measure: its
 * length, area or volume. Each quadrature rule is exact for polynomials of degree 3. */
static void add_simplex(sums *s, const vs_vec3 *p, int n, double measure) {
  static const double middle[] = { 2 / 3., -27 / 48., -4 / 5. }, outer[] = { 1 / 6., 25 / 48., 9 / 20. },
                      near[] = { 1, 3 / 5., 1 / 2. };
  double share[4];
  for (int k = -1; k < n; k++) {
    for (int i = 0; i < n; i++)
      share[i] = k < 0 ? 1. / n : i == k ? near[n - 2] : (1 - near[n - 2]) / (n - 1);
    add(s, between(p, share, n), measure * (k < 0 ? middle : outer)[n - 2]);
  }
}

static void add_mesh(sums *s, const vs_mesh *m, bool solid) {
  for (size_t t = 0; t < m->triangle_count; t++) {
    vs_vec3 p[4] = { m->vertices[m->triangles[t][0]], m->vertices[m->triangles[t][1]], m->vertices[m->triangles[t][2]],
                     s->origin };
    const vs_vec3 normal = vs_v3_cross(vs_v3_sub(p[1], p[0]), vs_v3_sub(p[2], p[0]));
    if (solid) add_simplex(s, p, 4, vs_v3_dot(vs_v3_sub(p[0], s->origin), normal) / 6);
    else add_simplex(s, p, 3, vs_v3_length(normal) / 2);
  }
}

static void add_line(sums *s, const vs_vec3 *at, size_t n, bool closed) {
  for (size_t i = 0; i + (closed ? 0 : 1) < n; i++) {
    const vs_vec3 p[2] = { at[i], at[i + 1 < n ? i + 1 : 0] };
    add_simplex(s, p, 2, vs_v3_length(vs_v3_sub(p[1], p[0])));
  }
}

/* Returns the centroid of all points that were added to s. */
static vs_vec3 centroid(const sums *s) {
  return s->measure != 0 ? vs_v3_add(s->origin, vs_v3_scale(s->first, 1 / s->measure)) : s->origin;
}

static int by_distance(const void *p, const void *q) {
  const vs_vec3 *a = p, *b = q;
  const double da = vs_v3_dot(*a, *a), db = vs_v3_dot(*b, *b);
  return da < db ? -1 : da > db;
}

/* Returns the height of a corner along a fixed oblique direction, along which the corners of usual parts rarely have
 * equal heights. */
static double height(vs_vec3 p) { return 0.46 * p.x + 0.405 * p.y + 0.79 * p.z; }

static int by_height(const void *p, const void *q) {
  const double a = height(*(const vs_vec3 *)p), b = height(*(const vs_vec3 *)q);
  return a < b ? -1 : a > b;
}

/* Fills the shape from the sums s, which are relative to the centroid, and from the n corners `at`. Returns false when
 * memory is out. */
static bool fill(vs_part_shape *out, const sums *s, const vs_vec3 *at, size_t n) {
  out->measure = fabs(s->measure);
  if (!(out->measure > 0)) return true;
  double c[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) c[i][j] = s->second[i][j] / s->measure;
  out->spread[0] = c[0][0] + c[1][1] + c[2][2];
  out->spread[1] = c[0][0] * c[1][1] - c[0][1] * c[1][0] + c[1][1] * c[2][2] - c[1][2] * c[2][1] + c[0][0] * c[2][2] -
      c[0][2] * c[2][0];
  out->spread[2] = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) -
      c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) + c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
  const vs_vec3 third = vs_v3_scale(s->third, 1 / s->measure);
  out->lean = vs_v3_dot(third, third);
  if (!VS_FRESH(out->corners, n + 1) || !VS_FRESH(out->along, n + 1)) return false;
  for (size_t i = 0; i < n; i++) out->corners[i] = out->along[i] = vs_v3_sub(at[i], s->origin);
  out->count = n;
  qsort(out->corners, n, sizeof *out->corners, by_distance);
  qsort(out->along, n, sizeof *out->along, by_height);
  return true;
}

bool vs_part_shape_of_mesh(const vs_mesh *m, bool solid, vs_part_shape *out) {
  *out = (vs_part_shape){ .dimension = solid ? 3 : 2 };
  if (!m->triangle_count) return true;
  sums rough = { .origin = m->vertices[m->triangles[0][0]] };
  add_mesh(&rough, m, solid);
  sums s = { .origin = centroid(&rough) };
  add_mesh(&s, m, solid);
  return fill(out, &s, m->vertices, m->vertex_count);
}

bool vs_part_shape_of_line(const vs_vec3 *at, size_t n, bool closed, vs_part_shape *out) {
  *out = (vs_part_shape){ .dimension = 1 };
  if (!n) return true;
  sums rough = { .origin = at[0] };
  add_line(&rough, at, n, closed);
  sums s = { .origin = centroid(&rough) };
  add_line(&s, at, n, closed);
  return fill(out, &s, at, n);
}

void vs_part_shape_free(vs_part_shape *s) {
  free(s->corners), free(s->along);
  s->corners = s->along = NULL;
}

/* ---- comparison ---- */

static bool moments_equal(const vs_part_shape *a, const vs_part_shape *b, double tolerance) {
  const double unit = fmax(a->spread[0], b->spread[0]), wide = 8 * tolerance;
  return fabs(a->measure - b->measure) <= wide * fmax(a->measure, b->measure) &&
         fabs(a->spread[0] - b->spread[0]) <= wide * unit && fabs(a->spread[1] - b->spread[1]) <= wide * unit * unit &&
         fabs(a->spread[2] - b->spread[2]) <= wide * unit * unit * unit &&
         fabs(a->lean - b->lean) <= wide * unit * unit * unit;
}

/* A rotation: the three rows of its matrix. */
typedef struct { vs_vec3 row[3]; } turn;
static vs_vec3 turned(const turn *t, vs_vec3 p) {
  return (vs_vec3){ vs_v3_dot(t->row[0], p), vs_v3_dot(t->row[1], p), vs_v3_dot(t->row[2], p) };
}

/* Sets the rows of t to a right-handed frame whose first axis points to p and whose first two axes span a plane with q.
 * Returns false if p and q lie on one line through the origin. */
static bool frame(vs_vec3 p, vs_vec3 q, turn *t) {
  const vs_vec3 normal = vs_v3_cross(p, q);
  if (!(vs_v3_length(normal) > 1e-6 * vs_v3_length(p) * vs_v3_length(q))) return false;
  t->row[0] = vs_v3_unit(p), t->row[2] = vs_v3_unit(normal), t->row[1] = vs_v3_cross(t->row[2], t->row[0]);
  return true;
}

/* Returns the index of the first corner that is at least `distance` from the centroid. */
static size_t first_at(const vs_part_shape *s, double distance) {
  size_t low = 0, high = s->count;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (vs_v3_length(s->corners[middle]) < distance) low = middle + 1;
    else high = middle;
  }
  return low;
}

/* Returns true if a corner of s is within `slack` of p. Searches the corners in the order of their heights (at most 1.1
 * * slack apart). */
static bool has_corner(const vs_part_shape *s, vs_vec3 p, double slack) {
  const double wanted = height(p), least = wanted - 1.1 * slack;
  size_t low = 0, high = s->count;
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (height(s->along[middle]) < least) low = middle + 1;
    else high = middle;
  }
  for (; low < s->count && height(s->along[low]) <= wanted + 1.1 * slack; low++)
    if (vs_v3_length(vs_v3_sub(s->along[low], p)) <= slack) return true;
  return false;
}

/* Returns true if the motion that moves the frame `from` to the frame `to` moves each corner of part a to a corner of
 * part b, within the slack. If `sign` is -1, tests the mirror image of a. */
static bool corners_fit(const vs_part_shape *a, const vs_part_shape *b, const turn *from, const turn *to, double sign,
                        double slack) {
  for (size_t i = a->count; i-- > 0;) {
    const vs_vec3 p = turned(from, a->corners[i]);
    const vs_vec3 q = vs_v3_add(vs_v3_add(vs_v3_scale(to->row[0], p.x), vs_v3_scale(to->row[1], p.y)),
                                vs_v3_scale(to->row[2], sign * p.z));
    if (!has_corner(b, q, slack)) return false;
  }
  return true;
}

/* Returns the number of corners whose distance from the centroid equals the distance of corner i, within the slack. */
static size_t ties(const vs_part_shape *s, size_t i, double slack) {
  const double distance = vs_v3_length(s->corners[i]);
  return first_at(s, distance + slack) - first_at(s, distance - slack);
}

/* Finds two corners of a, p and q, that are not on one line with the centroid. Prefers distances from the centroid that
 * few corners have, because fewer motions must then be tried. Returns false if all corners are on one line. */
static bool choose_pair(const vs_part_shape *a, double slack, size_t *p, size_t *q) {
  const double size = vs_v3_length(a->corners[a->count - 1]);
  size_t fewest = SIZE_MAX;
  for (size_t i = 0; i < a->count; i++)
    if (vs_v3_length(a->corners[i]) > .1 * size && ties(a, i, slack) <= fewest) fewest = ties(a, i, slack), *p = i;
  fewest = SIZE_MAX;
  for (size_t i = 0; i < a->count; i++) {
    const vs_vec3 n = vs_v3_cross(a->corners[*p], a->corners[i]);
    if (vs_v3_length(n) > .01 * vs_v3_length(a->corners[*p]) * size && ties(a, i, slack) <= fewest)
      fewest = ties(a, i, slack), *q = i;
  }
  return fewest != SIZE_MAX;
}

enum { MOTIONS = 4096, FIT, NO_FIT, UNKNOWN }; /* MOTIONS: greatest number of motions (rotations of one part) that are
                                                * tried; FIT, NO_FIT, UNKNOWN: results of try_motions */

/* Tries motions that move the corners of part a to those of part b. sign: -1 tries the mirror image of a, 1 tries a.
 * Returns FIT, NO_FIT, or UNKNOWN if there are too many motions, as for a sphere. */
static int try_motions(const vs_part_shape *a, const vs_part_shape *b, double sign, double slack) {
  size_t p = 0, q = 0, tried = 0;
  turn from, to;
  if (!choose_pair(a, slack, &p, &q) || !frame(a->corners[p], a->corners[q], &from)) return FIT;
  const double far = vs_v3_length(a->corners[p]), beside = vs_v3_length(a->corners[q]),
               apart = vs_v3_length(vs_v3_sub(a->corners[p], a->corners[q]));
  for (size_t i = first_at(b, far - slack); i < b->count && vs_v3_length(b->corners[i]) <= far + slack; i++)
    for (size_t j = first_at(b, beside - slack); j < b->count && vs_v3_length(b->corners[j]) <= beside + slack; j++) {
      if (fabs(vs_v3_length(vs_v3_sub(b->corners[i], b->corners[j])) - apart) > 2 * slack ||
          !frame(b->corners[i], b->corners[j], &to)) continue;
      if (++tried > MOTIONS) return UNKNOWN;
      if (corners_fit(a, b, &from, &to, sign, 4 * slack)) return FIT;
    }
  return NO_FIT;
}

bool vs_part_shapes_equal(const vs_part_shape *a, const vs_part_shape *b, double tolerance) {
  VS_ASSERT(tolerance >= 0);
  if (a->dimension != b->dimension || !moments_equal(a, b, tolerance)) return false;
  if (a->count != b->count || !a->count) return true;
  const double slack = tolerance * vs_v3_length(a->corners[a->count - 1]);
  /* tried first: the parts may differ only by a move, without a rotation */
  static const turn none = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  if (corners_fit(a, b, &none, &none, 1, slack)) return true;
  return try_motions(a, b, 1, slack) != NO_FIT || try_motions(a, b, -1, slack) != FIT;
}

/* ---- the box around a part ---- */

enum { PLANES = 12, EDGES = 12 };

typedef struct { vs_vec3 normal; double area; } face_plane;

/* Adds the area of a triangle to the plane that has its normal. Opposite normals count as one plane. Returns the new
 * number of planes. */
static size_t add_plane(face_plane *planes, size_t count, vs_vec3 normal, double area) {
  for (size_t i = 0; i < count; i++)
    if (fabs(vs_v3_dot(planes[i].normal, normal)) > 1 - 1e-9) return planes[i].area += area, count;
  if (count < PLANES) return planes[count] = (face_plane){ normal, area }, count + 1;
  size_t least = 0;
  for (size_t i = 1; i < count; i++)
    if (planes[i].area < planes[least].area) least = i;
  if (planes[least].area < area) planes[least] = (face_plane){ normal, area };
  return count;
}

static double extent(const vs_mesh *m, vs_vec3 direction) {
  double low = INFINITY, high = -INFINITY;
  for (size_t i = 0; i < m->vertex_count; i++) {
    const double d = vs_v3_dot(m->vertices[i], direction);
    low = fmin(low, d), high = fmax(high, d);
  }
  return high > low ? high - low : 0;
}

static void sort_axes(vs_part_box *b) {
  for (int i = 0; i < 2; i++)
    for (int j = i + 1; j < 3; j++)
      if (b->size[j] > b->size[i]) {
        const vs_vec3 axis = b->axes[i];
        const double size = b->size[i];
        b->axes[i] = b->axes[j], b->size[i] = b->size[j];
        b->axes[j] = axis, b->size[j] = size;
      }
}

/* Computes the box around the mesh with edges along the unit vectors `axes`. Stores it in *b if its volume is less than
 * *least; for a flat part, its area. */
static void try_box(const vs_mesh *m, const vs_vec3 axes[3], double *least, vs_part_box *b) {
  const double wide = extent(m, axes[0]), deep = extent(m, axes[1]), high = extent(m, axes[2]);
  const double thin = 1e-9 * fmax(fmax(wide, deep), high);
  const double cost = fmax(wide, thin) * fmax(deep, thin) * fmax(high, thin);
  if (cost < *least * (1 - 1e-9))
    *least = cost, *b = (vs_part_box){ { axes[0], axes[1], axes[2] }, { wide, deep, high } };
}

/* Tries boxes with a side perpendicular to `normal`, one for each of up to EDGES edges of the mesh in that plane. */
static void try_plane(const vs_mesh *m, vs_vec3 normal, double *least, vs_part_box *b) {
  vs_vec3 tried[EDGES];
  size_t count = 0;
  for (size_t t = 0; t < m->triangle_count && count < EDGES; t++)
    for (int k = 0; k < 3 && count < EDGES; k++) {
      const vs_vec3 edge = vs_v3_sub(m->vertices[m->triangles[t][(k + 1) % 3]], m->vertices[m->triangles[t][k]]);
      const double length = vs_v3_length(edge);
      if (!(length > 0) || fabs(vs_v3_dot(edge, normal)) > 1e-9 * length) continue;
      const vs_vec3 along = vs_v3_scale(edge, 1 / length);
      bool known = false;
      for (size_t i = 0; i < count && !known; i++) {
        const double dot = fabs(vs_v3_dot(tried[i], along));
        known = dot > 1 - 1e-9 || dot < 1e-9;
      }
      if (known) continue;
      tried[count++] = along;
      try_box(m, (const vs_vec3[3]){ along, vs_v3_cross(normal, along), normal }, least, b);
    }
}

void vs_mesh_smallest_box(const vs_mesh *m, const vs_vec3 own[3], vs_part_box *out) {
  face_plane planes[PLANES];
  size_t count = 0;
  double least = INFINITY;
  *out = (vs_part_box){ .axes = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  for (size_t t = 0; t < m->triangle_count; t++) {
    const vs_vec3 a = m->vertices[m->triangles[t][0]];
    const vs_vec3 n = vs_v3_cross(vs_v3_sub(m->vertices[m->triangles[t][1]], a),
                                  vs_v3_sub(m->vertices[m->triangles[t][2]], a));
    const double twice = vs_v3_length(n);
    if (twice > 0) count = add_plane(planes, count, vs_v3_scale(n, 1 / twice), twice / 2);
  }
  try_box(m, own, &least, out);
  for (size_t i = 0; i < count; i++) try_plane(m, planes[i].normal, &least, out);
  sort_axes(out);
}
