/* Follows paths of light backwards from a place. Directions are distributed by the cosine to the normal, so each path
 * counts equally; a surface keeps its reflectance of the path's light, until less than a thousandth is left. The first
 * directions form a spiral of equal parts of the disc below the hemisphere; the later ones are scattered. */
#include "geometry/light/daylight.h"

#include <math.h>

#include "geometry/frame.h"
#include "geometry/measure/scatter.h"

static const double golden = 2.39996322972865332, pi = 3.14159265358979323846, faint = 1e-3;

/* Returns the direction over a surface whose foot on the unit disc has this square of its radius, and this angle. */
static vs_vec3 lifted(vs_vec3 normal, double square, double angle) {
  vs_affine turn = vs_frame_turn(vs_v3(0, 0, 1), normal);
  double radius = sqrt(square);
  return vs_affine_vector(&turn, vs_v3(radius * cos(angle), radius * sin(angle), sqrt(fmax(1 - square, 0))));
}

/* Returns pi times the luminance of the sky or ground in a direction, over the illuminance of a level place in the
 * open. */
static double beyond(const vs_daylit *d, vs_vec3 direction) {
  return direction.z > 0 ? 3. / 7 * (1 + 2 * direction.z) : d->ground;
}

/* Returns the unit normal of a triangle, on the side from which a ray in this direction comes. */
static vs_vec3 facing(const vs_mesh *m, size_t triangle, vs_vec3 direction) {
  VS_ASSERT(triangle < m->triangle_count);
  const uint32_t *t = m->triangles[triangle];
  vs_vec3 p = m->vertices[t[0]];
  vs_vec3 n = vs_v3_unit(vs_v3_cross(vs_v3_sub(m->vertices[t[1]], p), vs_v3_sub(m->vertices[t[2]], p)));
  return vs_v3_dot(n, direction) > 0 ? vs_v3_scale(n, -1) : n;
}

/* Returns the light of one path that leaves a place in a direction; 0 if it meets the sky first. */
static double follow(const vs_daylit *d, vs_vec3 from, vs_vec3 direction, uint32_t seed) {
  double left = 1;
  for (uint32_t turn = 0; left > faint; turn++) {
    double at;
    size_t met = d->tree ? vs_ray_tree_meet(d->tree, from, direction, INFINITY, false, &at) : 0;
    if (!d->tree || met == d->tree->mesh->triangle_count)
      return turn || direction.z <= 0 ? left * beyond(d, direction) : 0;
    vs_vec3 normal = facing(d->tree->mesh, met, direction);
    from = vs_v3_add(vs_v3_add(from, vs_v3_scale(direction, at)), vs_v3_scale(normal, d->step));
    left *= d->reflectances[met];
    direction = lifted(normal, vs_scattered(seed + 2 * turn), 2 * pi * vs_scattered(seed + 2 * turn + 1));
  }
  return 0;
}

double vs_daylight_reflected(const vs_daylit *d, vs_vec3 at, vs_vec3 normal, vs_light_paths paths) {
  double sum = 0;
  vs_vec3 from = vs_v3_add(at, vs_v3_scale(normal, d->step));
  VS_ASSERT(paths.end <= paths.all && fabs(vs_v3_dot(normal, normal) - 1) < 1e-6);
  for (size_t i = paths.first; i < paths.end; i++) {
    double square = ((double)i + 0.5) / (double)paths.all;
    sum += follow(d, from, lifted(normal, square, (double)i * golden), (uint32_t)i * 2654435761u);
  }
  return sum / (double)paths.all;
}
