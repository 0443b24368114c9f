/* Implements revolutions.
 *
 * A profile's point (r, z) turned by the angle t has the position `at` + z axis + r (cos t out + sin t side). A point
 * on the axis (r = 0) remains one point, a pole. By Pappus's theorem, an area A whose centroid has the distance c from
 * the axis sweeps the volume angle A c. The surface that a curve sweeps follows likewise. */
#include "geometry/profiles/revolve.h"
#include "geometry/plane/outline.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "geometry/profiles/grid.h"
#include "model/store/array.h"

static const double turn = 6.28318530717958647693;

void vs_revolve_free(vs_revolve *r) {
  free(r->profile);
  free(r->sizes);
  free(r->hole);
  *r = (vs_revolve){ 0 };
}

/* Converts the outline o to points of a profile in a half-plane bounded by the axis: the half-plane that contains the
 * outline's point farthest from the axis. Returns false and sets e on failure. */
static bool revolve_place(vs_revolve *r, const vs_outline *o, vs_error *e) {
  vs_vec3 far = { 0, 0, 0 };
  double size = 0, most = 0;
  if (!o->count) return true; /* the outline of an empty region has no loops, and needs no half-plane */
  for (size_t l = 0; l < o->count; l++)
    for (size_t i = 0; i < o->loops[l].count; i++) {
      vs_vec3 d = vs_v3_sub(o->loops[l].at[i], r->at),
              across = vs_v3_sub(d, vs_v3_scale(r->axis, vs_v3_dot(d, r->axis)));
      size = fmax(size, vs_v3_length(d));
      if (vs_v3_dot(across, across) > most * (1 + 1e-12)) {
        most = vs_v3_dot(across, across);
        far = across;
      }
    }
  r->reach = sqrt(most);
  if (!(r->reach > 1e-9 * size)) return vs_error_set(e, VS_ERROR_MODEL, NULL, "the profile lies on the axis");
  r->out = vs_v3_unit(far);
  r->side = vs_v3_cross(r->axis, r->out);
  double low = INFINITY, high = -INFINITY, beside = 0; /* low, high: range of the outline along the axis; beside:
                                                        * largest distance of its points from the half-plane */
  for (size_t l = 0; l < o->count; l++)
    for (size_t i = 0; i < o->loops[l].count; i++) {
      vs_vec3 d = vs_v3_sub(o->loops[l].at[i], r->at);
      double y = vs_v3_dot(d, r->axis);
      low = fmin(low, y), high = fmax(high, y), beside = fmax(beside, fabs(vs_v3_dot(d, r->side)));
    }
  if (beside > 1e-6 * size && high - low < 1e-9 * size) {
    const char *cure = "turn it by pi/2 first: (do-rotate profile point gvector pi/2)";
    if (fabs(r->axis.x) > .999999)
      cure = "(do-rotate profile 'y pi/2) lays the profile down, or make the profile with #:plane 'xy";
    if (fabs(r->axis.y) > .999999)
      cure = "(do-rotate profile 'x pi/2) lays the profile down, or make the profile with #:plane 'xy";
    if (fabs(r->axis.z) > .999999)
      cure = "(do-rotate profile 'x pi/2) turns the profile upright, or make the profile with #:plane 'xz";
    return vs_error_set(e, VS_ERROR_MODEL, NULL,
                        "the profile's plane crosses the axis, and must contain the axis; %s", cure);
  }
  for (size_t l = 0; l < o->count; l++) {
    r->sizes[l] = o->loops[l].count;
    r->hole[l] = o->hole[l];
    for (size_t i = 0; i < o->loops[l].count; i++) {
      vs_vec3 d = vs_v3_sub(o->loops[l].at[i], r->at);
      double x = vs_v3_dot(d, r->out), y = vs_v3_dot(d, r->axis), off = vs_v3_dot(d, r->side);
      vs_vec3 at = o->loops[l].at[i];
      if (fabs(off) > 1e-6 * size)
        return vs_error_set(e, VS_ERROR_MODEL, NULL,
                            "the profile's plane must contain the axis; the point (xyz %.6g %.6g %.6g) lies %.6g "
                            "beside it: do-rotate or do-move the profile, or make the profile with another #:plane",
                            at.x, at.y, at.z, fabs(off));
      if (x < -1e-9 * size)
        return vs_error_set(
            e, VS_ERROR_MODEL, NULL,
            "the profile must lie on one side of the axis; the profile crosses the axis near (xyz %.6g %.6g %.6g): "
            "(do-move profile v) moves the profile to one side, (do-slice region plane) cuts the region at the axis",
            at.x, at.y, at.z);
      r->profile[r->count++] = (vs_vec2){ x < 1e-9 * size ? 0 : x, y };
    }
  }
  r->loop_count = o->count;
  return true;
}

bool vs_revolve_plan(const vs_node *n, const vs_fineness *f, vs_revolve *r, vs_error *e) {
  const struct vs_revolve *d = VS_AS(revolve, n);
  vs_outline o;
  size_t points = 0;
  *r = (vs_revolve){ .at = d->at, .axis = vs_v3_unit(d->direction), .start = d->start, .angle = d->end - d->start };
  if (fabs(r->angle) >= turn * (1 - 1e-15)) {
    r->angle = r->angle < 0 ? -turn : turn;
    r->full = true;
  }
  if (!vs_region_outline(n->children[0].node, f, &o, e)) return false;
  for (size_t l = 0; l < o.count; l++) points += o.loops[l].count;
  r->profile = vs_fresh(points + 1, sizeof *r->profile);
  r->sizes = vs_fresh(o.count + 1, sizeof *r->sizes);
  r->hole = vs_fresh(o.count + 1, sizeof *r->hole);
  r->filled = !o.count || o.loops[0].closed;
  bool ok = ((r->profile && r->sizes && r->hole) || vs_error_memory(e, NULL)) && revolve_place(r, &o, e);
  vs_outline_free(&o);
  if (!ok) vs_revolve_free(r);
  return ok;
}

size_t vs_revolve_steps(const vs_revolve *r, const vs_fineness *f, int segments) {
  double n = ceil(vs_fineness_turn(f, r->reach, segments) * fabs(r->angle) / turn - 1e-9);
  return n < 1 ? 1 : (size_t)n;
}

static vs_vec3 revolve_point(const vs_revolve *r, vs_vec2 p, double cosine, double sine) {
  vs_vec3 foot = vs_v3_add(r->at, vs_v3_scale(r->axis, p.y));
  return p.x == 0 ? foot
                  : vs_v3_add(foot, vs_v3_add(vs_v3_scale(r->out, p.x * cosine), vs_v3_scale(r->side, p.x * sine)));
}

bool vs_revolve_mesh(const vs_revolve *r, size_t steps, vs_mesh *out) {
  size_t rows = r->full ? steps : steps + 1, first = out->triangle_count;
  vs_vec3 *at = rows < SIZE_MAX / sizeof *at / (r->count + 1) ? vs_fresh(rows * (r->count + 1), sizeof *at) : NULL;
  VS_ASSERT(steps > 0);
  if (!at) return false;
  for (size_t i = 0; i < rows; i++) {
    double sine, cosine;
    if (r->full && r->start == 0)
      vs_turn_sincos(r->angle < 0 && i ? (int)(steps - i) : (int)i, (int)steps, &sine, &cosine);
    else vs_sincos(r->start + r->angle * ((double)i / (double)steps), &sine, &cosine);
    for (size_t k = 0; k < r->count; k++) at[i * r->count + k] = revolve_point(r, r->profile[k], cosine, sine);
  }
  vs_quad_grid g = { .at = at, .rows = rows, .columns = r->count, .sizes = r->sizes, .hole = r->hole,
                     .loop_count = r->loop_count, .round = r->filled, .joined = r->full, .capped = r->filled,
                     .flat = r->profile };
  bool ok = vs_grid_mesh(&g, out);
  free(at);
  if (ok && r->filled) vs_mesh_turn_outwards(out, first);
  return ok;
}

/* vs_revolve_bounds: each point of the profile moves on an arc about the axis, on which coordinate i is c + r (A cos t
 * + B sin t). */
void vs_revolve_bounds(const vs_revolve *r, const vs_affine *a, vs_bounds *b) {
  double low = fmin(r->start, r->start + r->angle), high = fmax(r->start, r->start + r->angle),
         angles[8] = { low, high };
  int n = 2;
  for (int i = 0; i < 3; i++) {
    vs_vec3 row = { a->m[i][0], a->m[i][1], a->m[i][2] };
    for (int k = 0; k < 2; k++) {
      double angle = atan2(vs_v3_dot(row, r->side), vs_v3_dot(row, r->out)) + k * turn / 2;
      angle += turn * ceil((low - angle) / turn);
      if (angle <= high) angles[n++] = angle;
    }
  }
  for (int i = 0; i < n; i++) {
    double sine, cosine;
    vs_sincos(angles[i], &sine, &cosine);
    for (size_t k = 0; k < r->count; k++)
      vs_bounds_add(b, vs_affine_point(a, revolve_point(r, r->profile[k], cosine, sine)));
  }
}

bool vs_loops_hold(const vs_vec2 *at, const size_t *sizes, size_t loop_count, double x, double y) {
  bool inside = false;
  for (size_t l = 0, first = 0; l < loop_count; first += sizes[l], l++)
    for (size_t i = 0; i < sizes[l]; i++) {
      vs_vec2 a = at[first + i], b = at[first + (i + 1 == sizes[l] ? 0 : i + 1)];
      if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  return inside;
}

bool vs_revolve_holds(const vs_revolve *r, vs_vec3 p) {
  vs_vec3 d = vs_v3_sub(p, r->at);
  double x = vs_v3_dot(d, r->out), y = vs_v3_dot(d, r->side), far = hypot(x, y);
  VS_ASSERT(r->filled);
  if (!r->full && far > 1e-12 * r->reach) {
    double t = (atan2(y, x) - r->start) * (r->angle < 0 ? -1 : 1);
    t -= turn * floor(t / turn);
    if (t > fabs(r->angle) && turn - t > 1e-12) return false;
  }
  return vs_loops_hold(r->profile, r->sizes, r->loop_count, far, vs_v3_dot(d, r->axis));
}

/* ---- measures of revolutions ---- */

typedef struct { double whole, r, rr, rz; } revolve_moments; /* integrals over the profile of 1, r, r^2 and r z, where r
                                                              * is the distance from the axis and z the height */

static void revolve_area_moments(const vs_revolve *p, revolve_moments *m) {
  for (size_t l = 0, first = 0; l < p->loop_count; first += p->sizes[l], l++)
    for (size_t i = 0; i < p->sizes[l]; i++) {
      vs_vec2 a = p->profile[first + i], b = p->profile[first + (i + 1 == p->sizes[l] ? 0 : i + 1)];
      double w = a.x * b.y - b.x * a.y;
      m->whole += w / 2;
      m->r += w * (a.x + b.x) / 6;
      m->rr += w * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
      m->rz += w * (a.x * (2 * a.y + b.y) + b.x * (a.y + 2 * b.y)) / 24;
    }
}

static void revolve_line_moments(const vs_revolve *p, revolve_moments *m) {
  for (size_t l = 0, first = 0; l < p->loop_count; first += p->sizes[l], l++)
    for (size_t i = 0; i + (p->filled ? 0 : 1) < p->sizes[l]; i++) {
      vs_vec2 a = p->profile[first + i], b = p->profile[first + (i + 1 == p->sizes[l] ? 0 : i + 1)];
      double w = hypot(b.x - a.x, b.y - a.y);
      m->whole += w;
      m->r += w * (a.x + b.x) / 2;
      m->rr += w * (a.x * a.x + a.x * b.x + b.x * b.x) / 3;
      m->rz += w * (a.x * (2 * a.y + b.y) + b.x * (a.y + 2 * b.y)) / 6;
    }
}

double vs_profile_circle(const vs_node *n) {
  vs_affine placed = vs_affine_identity();
  while (n->kind == VS_TRANSFORM || vs_node_is_wrapper(n) || (n->kind == VS_REGION && n->child_count == 1)) {
    if (n->kind == VS_TRANSFORM) placed = vs_affine_multiply(&placed, &VS_AS(transform, n)->matrix);
    n = n->children[0].node;
  }
  if (n->kind != VS_CIRCLE) return 0;
  vs_vec3 x = { placed.m[0][0], placed.m[1][0], placed.m[2][0] },
          y = { placed.m[0][1], placed.m[1][1], placed.m[2][1] };
  double k = vs_v3_length(x);
  bool even = fabs(vs_v3_length(y) - k) <= 1e-12 * k && fabs(vs_v3_dot(x, y)) <= 1e-12 * k * k;
  return even ? k * VS_AS(circle, n)->radius : 0;
}

bool vs_revolve_measure(const vs_node *n, const vs_fineness *f, vs_measure *m, vs_error *e) {
  vs_revolve r;
  if (!vs_revolve_plan(n, f, &r, e)) return false;
  revolve_moments area = { 0 }, line = { 0 };
  if (r.filled) revolve_area_moments(&r, &area);
  revolve_line_moments(&r, &line);
  if (area.whole < 0) area = (revolve_moments){ -area.whole, -area.r, -area.rr, -area.rz };
  double angle = fabs(r.angle), radius = vs_profile_circle(n->children[0].node), half = angle / 2,
         middle = r.start + r.angle / 2, sine, cosine;
  if (radius > 0) { /* the profile is a circle, which a regular polygon replaces; both have the same centroid */
    double k = turn / 2 * radius * radius / area.whole, l = turn * radius / line.whole;
    area = (revolve_moments){ area.whole * k, area.r * k, area.rr * k, area.rz * k };
    line = (revolve_moments){ line.whole * l, line.r * l, line.rr * l, line.rz * l };
  }
  const revolve_moments *mass = r.filled ? &area : &line;
  m->volume = r.filled ? angle * area.r : 0;
  m->area = angle * line.r + (r.filled && !r.full ? 2 * area.whole : 0);
  /* far: distance of the centroid from the axis, in the direction of the middle angle; in a partial turn, it is r
   * sin(half) / half for each point at the distance r. */
  double far = mass->r > 0 && !r.full ? mass->rr / mass->r * sin(half) / half : 0;
  vs_sincos(middle, &sine, &cosine);
  m->centroid = revolve_point(&r, (vs_vec2){ far, mass->r > 0 ? mass->rz / mass->r : 0 }, cosine, sine);
  vs_revolve_free(&r);
  return true;
}
