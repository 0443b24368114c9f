/* Finds the surface of a face (face_surface.h). Corners of facets lie on the surface, so spheres, cones and tori are
 * fitted to them, and a fit counts only if it contains every corner. Areas are sums over the facets, each mapped to the
 * surface: facets between parallels and meridians are then exact. At a border that is an arc, the area between the arc
 * and its chords is added. */
#include "geometry/measure/face_surface.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

static const double PI = 3.14159265358979323846;
static const double EXACT = 1e-6; /* allowed distance of a corner from the surface, as a fraction of the mesh's size */
enum { FEW = 8 };                 /* fewest facets of a sphere, cone or torus */

typedef struct {
  const vs_mesh_edges *s;
  const uint32_t *list; /* triangles of the face */
  size_t count;
  double size;
} facets;

static vs_vec3 corner(const facets *f, size_t i, int k) { return vs_mesh_edges_place(f->s, f->list[i], k); }

static vs_vec3 area_vector(const facets *f, size_t i) {
  vs_vec3 a = corner(f, i, 0);
  return vs_v3_scale(vs_v3_cross(vs_v3_sub(corner(f, i, 1), a), vs_v3_sub(corner(f, i, 2), a)), .5);
}

/* Returns the angle between two vectors, from 0 to pi. */
static double between(vs_vec3 a, vs_vec3 b) { return atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b)); }

/* Returns the angle from a to b around an axis, from -pi to pi. */
static double around(vs_vec3 axis, vs_vec3 a, vs_vec3 b) {
  vs_vec3 p = vs_v3_sub(a, vs_v3_scale(axis, vs_v3_dot(a, axis)));
  vs_vec3 q = vs_v3_sub(b, vs_v3_scale(axis, vs_v3_dot(b, axis)));
  return atan2(vs_v3_dot(vs_v3_cross(p, q), axis), vs_v3_dot(p, q));
}

/* Solves three equations: m x = v. Returns false if they have no single solution. */
static bool solve(double m[3][3], const double v[3], double x[3]) {
  vs_vec3 c[3];
  for (int k = 0; k < 3; k++) c[k] = vs_v3(m[0][k], m[1][k], m[2][k]);
  vs_vec3 right = vs_v3(v[0], v[1], v[2]);
  double det = vs_v3_dot(c[0], vs_v3_cross(c[1], c[2])), size = 0;
  for (int k = 0; k < 3; k++) size = fmax(size, vs_v3_length(c[k]));
  if (!(fabs(det) > 1e-12 * size * size * size)) return false;
  x[0] = vs_v3_dot(right, vs_v3_cross(c[1], c[2])) / det;
  x[1] = vs_v3_dot(c[0], vs_v3_cross(right, c[2])) / det;
  x[2] = vs_v3_dot(c[0], vs_v3_cross(c[1], right)) / det;
  return true;
}

/* Returns the mean of the facets' corners. */
static vs_vec3 mean_of(const facets *f) {
  vs_vec3 sum = { 0, 0, 0 };
  for (size_t i = 0; i < 3 * f->count; i++) sum = vs_v3_add(sum, corner(f, i / 3, (int)(i % 3)));
  return vs_v3_scale(sum, 1 / (3. * (double)f->count));
}

/* ---- areas on surfaces ---- */

/* Returns the solid angle of the triangle a, b, c, seen from the origin (van Oosterom and Strackee, 1983). */
static double solid_angle(vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  double x = vs_v3_length(a), y = vs_v3_length(b), z = vs_v3_length(c);
  return 2 * atan2(vs_v3_dot(a, vs_v3_cross(b, c)),
                   x * y * z + vs_v3_dot(a, b) * z + vs_v3_dot(b, c) * x + vs_v3_dot(c, a) * y);
}

static double sphere_area(const vs_face_surface *o, const vs_vec3 p[3]) {
  vs_vec3 a = vs_v3_sub(p[0], o->at), b = vs_v3_sub(p[1], o->at), c = vs_v3_sub(p[2], o->at);
  return o->radius * o->radius * fabs(solid_angle(a, b, c));
}

/* Returns the area of a triangle whose corners have the coordinates u and v. */
static double flat_area(const double u[3], const double v[3]) {
  return fabs((u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0])) / 2;
}

static double cylinder_area(const vs_face_surface *o, const vs_vec3 p[3]) {
  double u[3], v[3];
  for (int k = 0; k < 3; k++) {
    u[k] = fabs(o->radius) * around(o->axis, vs_v3_sub(p[0], o->at), vs_v3_sub(p[k], o->at));
    v[k] = vs_v3_dot(o->axis, vs_v3_sub(p[k], o->at));
  }
  return flat_area(u, v);
}

static double cone_area(const vs_face_surface *o, const vs_vec3 p[3]) {
  double u[3], v[3], far = 0;
  int apex = -1;
  for (int k = 0; k < 3; k++) v[k] = vs_v3_length(vs_v3_sub(p[k], o->at)), far = fmax(far, v[k]);
  for (int k = 0; k < 3; k++) if (v[k] < 1e-9 * far) apex = k;
  if (apex >= 0) { /* a sector */
    int k = (apex + 1) % 3, l = (apex + 2) % 3;
    return fabs(around(o->axis, vs_v3_sub(p[k], o->at), vs_v3_sub(p[l], o->at))) * sin(o->angle) * v[k] * v[l] / 2;
  }
  for (int k = 0; k < 3; k++) u[k] = around(o->axis, vs_v3_sub(p[0], o->at), vs_v3_sub(p[k], o->at));
  return flat_area(u, v) * sin(o->angle) * (v[0] + v[1] + v[2]) / 3;
}

static double torus_area(const vs_face_surface *o, const vs_vec3 p[3]) {
  double u[3], v[3];
  for (int k = 0; k < 3; k++) {
    vs_vec3 d = vs_v3_sub(p[k], o->at);
    double z = vs_v3_dot(d, o->axis), out = vs_v3_length(vs_v3_cross(d, o->axis)) - o->radius;
    u[k] = around(o->axis, vs_v3_sub(p[0], o->at), d);
    v[k] = atan2(z, out);
    if (k && v[k] - v[0] > PI) v[k] -= 2 * PI;
    if (k && v[k] - v[0] < -PI) v[k] += 2 * PI;
  }
  /* the mean of the cosine over the triangle, from three points: its error is of the fourth power of the width */
  double mean = 0;
  for (int k = 0; k < 3; k++) mean += cos((4 * v[k] + v[(k + 1) % 3] + v[(k + 2) % 3]) / 6) / 3;
  return flat_area(u, v) * o->tube * (o->radius + o->tube * mean);
}

static double mapped_area(const vs_face_surface *o, const facets *f) {
  double sum = 0;
  for (size_t i = 0; i < f->count; i++) {
    const vs_vec3 p[3] = { corner(f, i, 0), corner(f, i, 1), corner(f, i, 2) };
    switch (o->form) {
    case VS_SURFACE_CYLINDER: sum += cylinder_area(o, p); break;
    case VS_SURFACE_SPHERE: sum += sphere_area(o, p); break;
    case VS_SURFACE_CONE: sum += cone_area(o, p); break;
    case VS_SURFACE_TORUS: sum += torus_area(o, p); break;
    default: sum += vs_v3_length(area_vector(f, i));
    }
  }
  return sum;
}

/* ---- fits ---- */

static bool fits_sphere(const facets *f, vs_face_surface *o) {
  vs_vec3 middle = mean_of(f);
  double m[3][3] = { { 0 } }, v[3] = { 0 }, x[3], mean = 0, n = 3. * (double)f->count;
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0; i < 3 * f->count; i++) {
      vs_vec3 d = vs_v3_sub(corner(f, i / 3, (int)(i % 3)), middle);
      const double at[3] = { d.x, d.y, d.z };
      double square = vs_v3_dot(d, d);
      if (pass == 0) mean += square / n;
      for (int k = 0; pass == 1 && k < 3; k++) {
        v[k] += at[k] * (square - mean) / 2;
        for (int l = 0; l < 3; l++) m[k][l] += at[k] * at[l];
      }
    }
  if (!solve(m, v, x)) return false;
  *o = (vs_face_surface){ .form = VS_SURFACE_SPHERE, .at = vs_v3_add(middle, vs_v3(x[0], x[1], x[2])) };
  for (size_t i = 0; i < 3 * f->count; i++)
    o->radius += vs_v3_length(vs_v3_sub(corner(f, i / 3, (int)(i % 3)), o->at)) / n;
  for (size_t i = 0; i < 3 * f->count; i++) {
    double r = vs_v3_length(vs_v3_sub(corner(f, i / 3, (int)(i % 3)), o->at));
    if (fabs(r - o->radius) > EXACT * f->size) return false;
  }
  return true;
}

/* Finds the point through which the planes of all facets go, with the facets' areas as weights. */
static bool common_point(const facets *f, vs_vec3 *out) {
  vs_vec3 middle = mean_of(f);
  double m[3][3] = { { 0 } }, v[3] = { 0 }, x[3];
  for (size_t i = 0; i < f->count; i++) {
    vs_vec3 a = area_vector(f, i);
    double size = vs_v3_length(a);
    if (!(size > 0)) continue;
    const double n[3] = { a.x / size, a.y / size, a.z / size };
    double off = vs_v3_dot(a, vs_v3_sub(corner(f, i, 0), middle)) / size;
    for (int k = 0; k < 3; k++) {
      v[k] += size * n[k] * off;
      for (int l = 0; l < 3; l++) m[k][l] += size * n[k] * n[l];
    }
  }
  if (!solve(m, v, x)) return false;
  *out = vs_v3_add(middle, vs_v3(x[0], x[1], x[2]));
  return true;
}

/* Fits a cone. The unit vectors from the apex to the corners end on a circle, in a plane perpendicular to the axis. */
static bool fits_cone(const facets *f, vs_face_surface *o) {
  double size = f->size, along_all = 0;
  *o = (vs_face_surface){ .form = VS_SURFACE_CONE };
  if (!common_point(f, &o->at)) return false;
  vs_vec3 a = { 0, 0, 0 }, b = a, most = a;
  bool begun = false;
  for (int pass = 0; pass < 3; pass++)
    for (size_t i = 0; i < 3 * f->count; i++) {
      vs_vec3 d = vs_v3_sub(corner(f, i / 3, (int)(i % 3)), o->at);
      if (vs_v3_length(d) < 1e-3 * size) continue;
      d = vs_v3_unit(d);
      if (pass == 0 && !begun) a = b = d, begun = true;
      else if (pass == 1 && vs_v3_length(vs_v3_sub(d, a)) > vs_v3_length(vs_v3_sub(b, a))) b = d;
      else if (pass == 2) {
        vs_vec3 c = vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(d, a));
        if (vs_v3_length(c) > vs_v3_length(most)) most = c;
      }
    }
  if (!(vs_v3_length(most) > 1e-6)) return false;
  o->axis = vs_v3_unit(most);
  if (vs_v3_dot(o->axis, a) < 0) o->axis = vs_v3_scale(o->axis, -1);
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0; i < 3 * f->count; i++) {
      vs_vec3 d = vs_v3_sub(corner(f, i / 3, (int)(i % 3)), o->at);
      double along = vs_v3_dot(d, o->axis), out = vs_v3_length(vs_v3_cross(d, o->axis));
      if (pass == 0) along_all += along, o->angle += out;
      else if (fabs(out * cos(o->angle) - along * sin(o->angle)) > EXACT * size) return false;
      if (pass == 0 && i + 1 == 3 * f->count) o->angle = atan2(o->angle, along_all);
    }
  return o->angle > 1e-3 && o->angle < PI / 2 - 1e-3;
}

/* Returns the direction in which the corners extend least, if they extend equally in all perpendicular directions, by
 * iteration. */
static vs_vec3 least_direction(const facets *f, vs_vec3 middle) {
  double m[3][3] = { { 0 } }, trace = 0;
  for (size_t i = 0; i < 3 * f->count; i++) {
    vs_vec3 d = vs_v3_sub(corner(f, i / 3, (int)(i % 3)), middle);
    const double at[3] = { d.x, d.y, d.z };
    for (int k = 0; k < 3; k++)
      for (int l = 0; l < 3; l++) m[k][l] += at[k] * at[l];
  }
  for (int k = 0; k < 3; k++) trace += m[k][k];
  vs_vec3 v = vs_v3_unit(vs_v3(.31, .57, .76));
  for (int turn = 0; turn < 500; turn++) {
    const double at[3] = { v.x, v.y, v.z };
    double next[3];
    for (int k = 0; k < 3; k++) next[k] = trace * at[k] - m[k][0] * at[0] - m[k][1] * at[1] - m[k][2] * at[2];
    v = vs_v3_unit(vs_v3(next[0], next[1], next[2]));
  }
  return v;
}

/* Fits a whole torus. A part of a torus has another direction in which it extends least, and so no fit. */
static bool fits_torus(const facets *f, vs_face_surface *o) {
  vs_vec3 middle = mean_of(f);
  double m[3][3] = { { 0 } }, v[3] = { 0 }, x[3];
  *o = (vs_face_surface){ .form = VS_SURFACE_TORUS, .axis = least_direction(f, middle) };
  for (size_t i = 0; i < 3 * f->count; i++) {
    vs_vec3 d = vs_v3_sub(corner(f, i / 3, (int)(i % 3)), middle);
    const double z = vs_v3_dot(d, o->axis), out = vs_v3_length(vs_v3_cross(d, o->axis)), row[3] = { 2 * out, 2 * z, 1 };
    for (int k = 0; k < 3; k++) {
      v[k] += row[k] * (out * out + z * z);
      for (int l = 0; l < 3; l++) m[k][l] += row[k] * row[l];
    }
  }
  if (!solve(m, v, x)) return false;
  o->at = vs_v3_add(middle, vs_v3_scale(o->axis, x[1]));
  o->radius = x[0], o->tube = sqrt(fmax(x[2] + x[0] * x[0] + x[1] * x[1], 0));
  for (size_t i = 0; i < 3 * f->count; i++) {
    vs_vec3 d = vs_v3_sub(corner(f, i / 3, (int)(i % 3)), o->at);
    double z = vs_v3_dot(d, o->axis), out = vs_v3_length(vs_v3_cross(d, o->axis));
    if (fabs(hypot(out - o->radius, z) - o->tube) > EXACT * f->size) return false;
  }
  return o->radius > 0 && o->tube > 0;
}

/* ---- borders that are arcs ---- */

/* Finds the circle through the points of an edge between faces. Returns false if there is none. */
static bool circle_of(const vs_vec3 *at, size_t n, double size, vs_vec3 *center, vs_vec3 *axis, double *radius) {
  if (n < 3) return false;
  vs_vec3 a = at[0], b = at[n / 3], c = at[2 * n / 3], p = vs_v3_sub(b, a), q = vs_v3_sub(c, a), w = vs_v3_cross(p, q);
  double ww = vs_v3_dot(w, w);
  if (!(ww > 1e-12 * vs_v3_dot(p, p) * vs_v3_dot(q, q))) return false;
  vs_vec3 first = vs_v3_scale(vs_v3_cross(q, w), vs_v3_dot(p, p));
  vs_vec3 second = vs_v3_scale(vs_v3_cross(w, p), vs_v3_dot(q, q));
  vs_vec3 to = vs_v3_scale(vs_v3_add(first, second), .5 / ww);
  *center = vs_v3_add(a, to), *axis = vs_v3_unit(w), *radius = vs_v3_length(to);
  for (size_t i = 0; i < n; i++) {
    vs_vec3 d = vs_v3_sub(at[i], *center);
    if (fabs(vs_v3_dot(d, *axis)) > EXACT * size || fabs(vs_v3_length(d) - *radius) > EXACT * size) return false;
  }
  return true;
}

/* Returns the area between an arc from p to q and the facets' border there: the chord on a plane, the great circle on a
 * sphere. center, radius: those of the arc. */
static double beyond_chord(const vs_face_surface *o, vs_vec3 p, vs_vec3 q, vs_vec3 center, double radius) {
  double turn = between(vs_v3_sub(p, center), vs_v3_sub(q, center));
  if (o->form == VS_SURFACE_PLANE) return radius * radius * (turn - sin(turn)) / 2;
  vs_vec3 up = vs_v3_sub(center, o->at);
  double height = vs_v3_length(up);
  if (!(height > EXACT * o->radius)) return 0; /* the arc is a great circle */
  vs_vec3 pole = vs_v3_scale(up, o->radius / height);
  double cap = turn * o->radius * (o->radius - height);
  return cap - o->radius * o->radius * fabs(solid_angle(pole, vs_v3_sub(p, o->at), vs_v3_sub(q, o->at)));
}

/* Finds the triangle of the face that has the mesh edge between p and q. Sets *third to its other corner. */
static bool beside(const facets *f, vs_vec3 p, vs_vec3 q, vs_vec3 *third) {
  for (size_t i = 0; i < f->count; i++)
    for (int k = 0; k < 3; k++) {
      vs_vec3 a = corner(f, i, k), b = corner(f, i, (k + 1) % 3);
      if ((vs_v3_equal(a, p) && vs_v3_equal(b, q)) || (vs_v3_equal(a, q) && vs_v3_equal(b, p)))
        return *third = corner(f, i, (k + 2) % 3), true;
    }
  return false;
}

/* Returns the area that the face's arcs add to its facets. */
static double area_at_arcs(const vs_face_surface *o, const facets *f, const vs_mesh_faces *faces, uint32_t face) {
  double sum = 0, radius;
  vs_vec3 center, axis, third;
  for (size_t i = 0; i < faces->edge_count; i++) {
    const vs_face_edge *e = &faces->edges[i];
    if (e->face[0] != face && e->face[1] != face) continue;
    const vs_mesh_face *other = &faces->faces[e->face[e->face[0] == face]];
    if (o->form == VS_SURFACE_PLANE && other->form == VS_FACE_PLANE) continue;
    const vs_vec3 *at = faces->at + e->first;
    if (!circle_of(at, e->count, f->size, &center, &axis, &radius)) continue;
    double side = 0, lens = 0;
    for (size_t k = 0; k + !e->closed < e->count; k++)
      lens += beyond_chord(o, at[k], at[(k + 1) % e->count], center, radius);
    /* A facet beside the arc lies on the side of the arc's centre, or beyond the arc. */
    if (!beside(f, at[0], at[1], &third)) continue;
    vs_vec3 middle = vs_v3_scale(vs_v3_add(at[0], at[1]), .5);
    vs_vec3 to = vs_v3_sub(center, middle);
    if (o->form == VS_SURFACE_SPHERE) to = vs_v3_sub(center, o->at);
    side = vs_v3_dot(vs_v3_sub(third, middle), to);
    sum += side > 0 ? lens : -lens;
  }
  return sum;
}

bool vs_face_surface_find(const vs_mesh_edges *s, const vs_mesh_faces *faces, uint32_t face, bool round,
                          vs_face_surface *out) {
  VS_ASSERT(face < faces->face_count);
  const vs_mesh_face *g = &faces->faces[face];
  size_t n = 0;
  uint32_t *list = NULL;
  vs_bounds b = vs_mesh_bounds(s->m);
  if (!VS_FRESH(list, s->m->triangle_count + 1)) return false;
  for (uint32_t t = 0; t < s->m->triangle_count; t++) if (faces->of[t] == face) list[n++] = t;
  const facets f = { s, list, n, vs_bounds_diagonal(&b) };
  bool many = round && n >= FEW;
  if (g->form == VS_FACE_PLANE) *out = (vs_face_surface){ .form = VS_SURFACE_PLANE };
  else if (g->form == VS_FACE_CYLINDER)
    *out = (vs_face_surface){ .form = VS_SURFACE_CYLINDER, .radius = fabs(g->radius) };
  else if (!many || (!fits_cone(&f, out) && !fits_sphere(&f, out) && !fits_torus(&f, out))) /* the corners of a cone
                                                                                            * lie on a sphere, too */
    *out = (vs_face_surface){ .form = VS_SURFACE_OTHER };
  if (out->form == VS_SURFACE_PLANE || out->form == VS_SURFACE_CYLINDER || out->form == VS_SURFACE_OTHER)
    out->at = g->at, out->axis = g->normal;
  out->area = mapped_area(out, &f);
  if (out->form == VS_SURFACE_PLANE || out->form == VS_SURFACE_SPHERE) out->area += area_at_arcs(out, &f, faces, face);
  free(list);
  return true;
}
