/* Implements the superellipsoid: its triangles and its formulas.
 *
 * Its profile and its cross-sections are curves |u|^p + |v|^p = 1, with p = 2/n for the profile and p = 2/e for
 * cross-sections. Half a quadrant of such a curve is
 *   u = (1 + t^p)^(-1/p), v = t u, 0 <= t <= 1.
 * The other half of the quadrant is its mirror image at the diagonal. The points on the axes and on the diagonal are
 * exact. The normal at t has the direction (1, t^(p-1)). From point to point, the sum of the rotation of the normal and
 * the angle of t grows in equal steps. On a circle these are equal angles. On a square with rounded corners most of the
 * points are at the corners. Every chord stays near its arc, even if the corners are sharp. */
#include <stdlib.h>

#include "geometry/measure/reach.h"
#include "geometry/primitives/shape.h"
#include "model/store/array.h"

static const double quarter_pi = 0.78539816339744830962;

typedef struct { double u, v; } vs_oval_point;

static vs_oval_point oval_at(double p, double t) {
  double u = exp(-log1p(pow(t, p)) / p);
  return (vs_oval_point){ u, t * u };
}

/* Returns a number that grows from 0 to 1 as t does: the mean of the angle of t and the rotation of the normal, each as
 * a fraction of its range. */
static double oval_share(double p, double t) {
  double angle = atan(t) / quarter_pi, turned = p == 1 ? angle : atan(pow(t, fabs(p - 1))) / quarter_pi;
  return (angle + turned) / 2;
}

/* Computes the 2 * half + 1 points of a quadrant of the curve, from (1, 0) to (0, 1). The two halves of the quadrant
 * are exact mirror images. half is above 0. */
static void oval_quarter(double p, int half, vs_oval_point *at) {
  VS_ASSERT(half > 0);
  for (int i = 0; i <= half; i++) {
    double low = 0, high = 1, want = (double)i / half;
    for (int k = 0; k < 100 && i > 0 && i < half; k++) {
      double middle = (low + high) / 2;
      if (oval_share(p, middle) < want) low = middle;
      else high = middle;
    }
    at[i] = i == 0 ? (vs_oval_point){ 1, 0 } : oval_at(p, i == half ? 1 : low);
    at[2 * half - i] = (vs_oval_point){ at[i].v, at[i].u };
  }
}

/* Returns the number of facets of a full turn of the curve: a multiple of eight, so that there are corners on the axes
 * and diagonals. Unless the curve is a circle, a chord may be three times as far from its arc as for a circle with as
 * many facets. */
static int oval_turn(const struct vs_superellipsoid *s, double exponent, const vs_fineness *f) {
  int n = vs_fineness_turn(f, s->size, s->segments);
  if (exponent != 1 && s->segments == 0 && f->segments <= 0) n = 7 * n / 4;
  return (n + 7) / 8 * 8;
}

static bool solid_mesh(vs_mesh *out, const struct vs_superellipsoid *s, const vs_fineness *f) {
  int around = oval_turn(s, s->e, f), profile = oval_turn(s, s->n, f),
      half = profile / 4; /* number of rings from the equator to a pole */
  vs_oval_point *section = vs_fresh((size_t)(around / 4 + 1), sizeof *section),
                *up = vs_fresh((size_t)(half + 1), sizeof *up);
  uint32_t n = (uint32_t)around, base = (uint32_t)out->vertex_count, rings = (uint32_t)(2 * half - 1), south, north;
  bool ok =
      section && up &&
      vs_mesh_reserve(out, out->vertex_count + (size_t)n * rings + 2, out->triangle_count + 2 * (size_t)n * rings);
  if (ok) {
    oval_quarter(2 / s->e, around / 8, section);
    oval_quarter(2 / s->n, profile / 8, up);
  }
  for (int j = 1 - half; ok && j < half; j++) { /* makes the rings of corners, beginning near the south pole */
    double r = s->size * up[abs(j)].u, z = (j < 0 ? -s->size : s->size) * up[abs(j)].v;
    for (int i = 0; ok && i < around; i++) {
      vs_oval_point p = section[i % (around / 4)];
      int quarter = i / (around / 4);
      double x = quarter % 2 ? -p.v : p.u, y = quarter % 2 ? p.u : p.v;
      if (quarter > 1) x = -x, y = -y;
      ok = vs_mesh_add_vertex(out, vs_v3(r * x + 0.0, r * y + 0.0, z + 0.0), NULL);
    }
  }
  ok = ok && vs_mesh_add_vertex(out, vs_v3(0, 0, -s->size), &south) &&
       vs_mesh_add_vertex(out, vs_v3(0, 0, s->size), &north);
  for (uint32_t i = 0; ok && i < n; i++) {
    uint32_t k = i + 1 == n ? 0 : i + 1, top = base + (rings - 1) * n;
    ok = vs_mesh_add_triangle(out, base + k, base + i, south) && vs_mesh_add_triangle(out, top + i, top + k, north);
    bool rising = i / (n / 8) % 2; /* rising: which of its two diagonals divides a quadrilateral; mirrored
                                    * quadrilaterals have mirrored diagonals */
    for (uint32_t j = 0; ok && j + 1 < rings; j++) {
      uint32_t a = base + j * n + i, b = base + j * n + k, c = b + n, d = a + n;
      ok = rising ? vs_mesh_add_triangle(out, a, b, d) && vs_mesh_add_triangle(out, b, c, d)
                  : vs_mesh_add_triangle(out, a, b, c) && vs_mesh_add_triangle(out, a, c, d);
    }
  }
  free(section);
  free(up);
  return ok;
}

/* ---- formulas ---- */

/* Returns (a^p + b^p)^(1/p) without overflow, for a and b of at least 0. If p is infinite, the result is the greater of
 * a and b. */
static double oval_norm(double p, double a, double b) {
  double most = fmax(a, b), least = fmin(a, b);
  VS_ASSERT(a >= 0 && b >= 0);
  return most > 0 && isfinite(p) ? most * exp(log1p(pow(least / most, p)) / p) : most;
}

static bool solid_holds(const struct vs_superellipsoid *s, vs_vec3 p) {
  return oval_norm(2 / s->n, oval_norm(2 / s->e, fabs(p.x), fabs(p.y)), fabs(p.z)) <= s->size;
}

/* Returns the greatest scalar product of d with a point of the solid, from which its bounds follow. dual_p, dual_q:
 * exponents of the dual norms. A concave curve (p < 1) extends only as far as its points on the axes. */
static double solid_reach(const struct vs_superellipsoid *s, vs_vec3 d) {
  double p = 2 / s->e, q = 2 / s->n, dual_p = p > 1 ? p / (p - 1) : INFINITY, dual_q = q > 1 ? q / (q - 1) : INFINITY;
  return s->size * oval_norm(dual_q, oval_norm(dual_p, fabs(d.x), fabs(d.y)), fabs(d.z));
}

static double beta(double a, double b) { return tgamma(a) * tgamma(b) / tgamma(a + b); }

/* Returns the volume by the formula 2 s^3 e n B(e/2, e/2) B(n/2 + 1, n) (Jaklic, Leonardis, Solina 2000). */
static double solid_volume(const struct vs_superellipsoid *s) {
  return 2 * s->size * s->size * s->size * s->e * s->n * beta(s->e / 2, s->e / 2) * beta(s->n / 2 + 1, s->n);
}

/* A node of the quadrature of the area. The surface is (r u, r v, z) with (u, v) on the cross-section and (r, z) on the
 * profile. Its element of area is
 *   r sqrt(z'^2 (u'^2 + v'^2) + r'^2 (u v' - v u')^2).
 * With u' = -t^(p-1) w, v' = w, w = (1 + t^p)^(-1/p - 1), u v' - v u' = u^2. The element is integrated over half a
 * quadrant of the section, of which there are sixteen equal ones, and over both halves of the profile's quadrant. The
 * double exponential rule tolerates the singularities of powers at the ends. */
typedef struct { double u, v, du, dv, weight; } vs_oval_node;

static int oval_nodes(double p, vs_oval_node *nodes) {
  int n = 0;
  const double step = 1.0 / 16;
  for (int i = -64; i <= 64; i++) {
    double x = i * step, g = 2 * quarter_pi * sinh(x), t = 1 / (1 + exp(-2 * g)),
           weight = 2 * quarter_pi * cosh(x) * step / (2 * cosh(g) * cosh(g));
    if (!(t > 0) || !(weight > 1e-300)) continue;
    double power = pow(t, p), w = exp(log1p(power) * (-1 / p - 1));
    nodes[n++] = (vs_oval_node){ w * (1 + power), t * w * (1 + power), -power / t * w, w, weight };
  }
  return n;
}

/* Returns the area by numerical quadrature, with some ten correct digits. */
static double solid_area(const struct vs_superellipsoid *s) {
  vs_oval_node section[129], profile[129];
  int m = oval_nodes(2 / s->e, section), n = oval_nodes(2 / s->n, profile);
  double sum = 0;
  for (int i = 0; i < m; i++) {
    double run = hypot(section[i].du, section[i].dv), turn = section[i].u * section[i].u;
    for (int j = 0; j < n; j++) {
      const vs_oval_node *k = &profile[j];
      sum += section[i].weight * k->weight *
             (k->u * hypot(k->dv * run, k->du * turn) + k->v * hypot(k->du * run, k->dv * turn));
    }
  }
  return 16 * s->size * s->size * sum;
}

/* ---- the functions of the shape ---- */

static bool superellipsoid_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  double reach[3];
  (void)e;
  for (int i = 0; i < 3; i++) reach[i] = solid_reach(VS_AS(superellipsoid, n), vs_reach_row(a, i));
  vs_reach_sides(b, a, vs_v3(0, 0, 0), vs_v3(reach[0], reach[1], reach[2]));
  return true;
}

static bool superellipsoid_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  return solid_mesh(out, VS_AS(superellipsoid, n), f) || vs_error_memory(e, NULL);
}

static bool superellipsoid_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  (void)e;
  m->volume = solid_volume(VS_AS(superellipsoid, n));
  m->area = area ? solid_area(VS_AS(superellipsoid, n)) : 0;
  return true;
}

static bool superellipsoid_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  (void)q, (void)height;
  return solid_holds(VS_AS(superellipsoid, n), p);
}

static vs_node *superellipsoid_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map,
                                     bool *fits) {
  VS_MOVED(superellipsoid,
           map->upright && a->m[0][3] == 0 && a->m[1][3] == 0 && a->m[2][3] == 0); /* the centre of the node is always
                                                                                    * the origin, so only a map that
                                                                                    * keeps the origin fits */
  d.size *= map->scale;
  return vs_node_new(s, VS_SUPERELLIPSOID, &d, NULL, 0);
}

VS_SHAPE(superellipsoid, NULL, NULL, NULL);
