/* Implements the capsule: all points within a radius of the segment between two centres. */
#include <math.h>

#include "geometry/frame.h"
#include "geometry/measure/reach.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool capsule_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_capsule *x = VS_AS(capsule, n);
  (void)e;
  vs_reach_ball(b, a, x->base, 0, x->radius);
  vs_reach_ball(b, a, x->top, 0, x->radius);
  return true;
}

/* Appends the rings of corners of the two hemispherical caps, in order from the pole at the base to the pole at the
 * top. rows: number of rings in each cap, above 0. */
static bool capsule_rings(const struct vs_capsule *x, const vs_affine *frame, int turn, int rows, vs_mesh *out) {
  vs_vec3 up = vs_affine_vector(frame, vs_v3(0, 0, x->radius));
  bool ok = true;
  VS_ASSERT(rows > 0);
  for (int row = 1; ok && row <= 2 * rows; row++) {
    bool below = row <= rows;
    double s, c; /* sine and cosine of the angle at the cap's centre between the pole and the ring */
    vs_turn_sincos(below ? row : 2 * rows + 1 - row, 4 * rows, &s, &c);
    vs_vec3 center = vs_v3_add(below ? x->base : x->top, vs_v3_scale(up, below ? -c : c));
    ok = vs_solid_ring(out, frame, center, x->radius * s, turn);
  }
  return ok;
}

static bool capsule_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  const struct vs_capsule *x = VS_AS(capsule, n);
  int turn = vs_fineness_turn(f, x->radius, x->segments), rows = turn / 4 < 1 ? 1 : turn / 4;
  vs_affine frame = vs_frame_on_axis(x->base, vs_v3_sub(x->top, x->base));
  vs_vec3 up = vs_affine_vector(&frame, vs_v3(0, 0, x->radius));
  uint32_t first = (uint32_t)out->vertex_count, around = (uint32_t)turn, last = 2 * (uint32_t)rows - 1, south, north;
  if (!vs_solid_fits(turn, turn / 2, "capsule", e)) return false;
  bool ok = capsule_rings(x, &frame, turn, rows, out);
  for (uint32_t low = first, row = 0; ok && row < last; row++, low += around)
    ok = vs_solid_band(out, low, low + around, around);
  ok = ok && vs_mesh_add_vertex(out, vs_v3_sub(x->base, up), &south) && vs_solid_fan(out, first, around, south, true);
  ok = ok && vs_mesh_add_vertex(out, vs_v3_add(x->top, up), &north) &&
       vs_solid_fan(out, first + last * around, around, north, false);
  return ok || vs_error_memory(e, NULL);
}

static bool capsule_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const double pi = 3.14159265358979323846;
  const struct vs_capsule *x = VS_AS(capsule, n);
  double r = x->radius, h = vs_v3_length(vs_v3_sub(x->top, x->base));
  (void)area, (void)e;
  m->volume = pi * r * r * (h + 4 * r / 3);
  m->area = 2 * pi * r * (h + 2 * r);
  m->centroid = vs_v3_scale(vs_v3_add(x->base, x->top), 0.5);
  return true;
}

static bool capsule_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  double r = VS_AS(capsule, n)->radius, beyond = q.z < 0 ? q.z : fmax(q.z - height, 0);
  (void)p;
  return q.x * q.x + q.y * q.y + beyond * beyond <= r * r;
}

static vs_node *capsule_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  VS_MOVED(capsule, d.segments ? map->upright : map->even);
  d.base = vs_affine_point(a, d.base);
  d.top = vs_affine_point(a, d.top);
  d.radius *= map->scale;
  return vs_node_new(s, VS_CAPSULE, &d, NULL, 0);
}

static void capsule_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top) {
  *base = VS_AS(capsule, n)->base, *top = VS_AS(capsule, n)->top;
}

static vs_node *capsule_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_capsule d = *VS_AS(capsule, n);
  d.radius += by;
  return vs_node_new(s, VS_CAPSULE, &d, NULL, 0);
}

static vs_node *capsule_parts(vs_store *s, const vs_node *n, const vs_origin *origin, bool *fits) {
  const struct vs_capsule *x = VS_AS(capsule, n);
  *fits = !x->segments; /* a capsule with a given number of facets stays one mesh; otherwise it is divided into a
                         * cylinder and spheres */
  if (!*fits) return NULL;
  struct vs_cylinder wall = { .base = x->base, .top = x->top, .radius = x->radius };
  struct vs_sphere low = { .center = x->base, .radius = x->radius }, high = { .center = x->top, .radius = x->radius };
  vs_ref part[3] = { { vs_node_new(s, VS_CYLINDER, &wall, NULL, 0), origin },
                     { vs_node_new(s, VS_SPHERE, &low, NULL, 0), origin },
                     { vs_node_new(s, VS_SPHERE, &high, NULL, 0), origin } };
  bool made = part[0].node && part[1].node && part[2].node;
  vs_node *all = made ? vs_node_new(s, VS_UNION, NULL, part, 3) : NULL;
  for (int i = 0; i < 3; i++) vs_node_release(part[i].node);
  return all;
}

VS_SHAPE(capsule, capsule_axis, capsule_grown, capsule_parts);
