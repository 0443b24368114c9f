/* Compares the mesh of a sweep with the sections of its profile, at the tight bends.
 *
 * Steps at tight bends are filled with tetrahedra, which reach beyond the step by more than the tolerance. Other steps
 * hide most of this, but not always all of it. Therefore random points in the tetrahedra are tested. A point is inside
 * the solid if it lies in the profile of a section. A formula decides this without a mesh (geometry/measure/inside.h).
 * If the mesh does not agree, it is wrong, unless its surface is close to the point. */
#include "solids/astray.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/measure/inside.h"
#include "geometry/measure/ray_crossings.h"
#include "model/store/array.h"

enum { POINTS = 20000 }; /* number of random points that are tested */
static const double far_away = 2.5; /* Distance from the surface of the mesh, in units of the mesh's tolerance. A point
                                     * on the wrong side of the surface counts only beyond this distance. */

/* Returns the point nearest to p on the segment from a to b. */
static vs_vec3 on_segment(vs_vec3 p, vs_vec3 a, vs_vec3 b) {
  vs_vec3 d = vs_v3_sub(b, a);
  double square = vs_v3_dot(d, d), t = square > 0 ? vs_v3_dot(vs_v3_sub(p, a), d) / square : 0;
  return vs_v3_add(a, vs_v3_scale(d, fmax(0, fmin(1, t))));
}

static bool near_triangle(vs_vec3 p, const vs_vec3 v[3], double distance) {
  vs_vec3 n = vs_v3_cross(vs_v3_sub(v[1], v[0]), vs_v3_sub(v[2], v[0]));
  double length = vs_v3_length(n);
  bool over = length > 0 && fabs(vs_v3_dot(vs_v3_sub(p, v[0]), n)) <= distance * length, near = false;
  for (int i = 0; i < 3; i++) {
    vs_vec3 a = v[i], b = v[(i + 1) % 3];
    near = near || vs_v3_length(vs_v3_sub(p, on_segment(p, a, b))) <= distance;
    over = over && vs_v3_dot(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(p, a)), n) >= 0;
  }
  return near || over;
}

/* Returns true if the distance of p from some triangle of the mesh is at most `distance`. */
static bool near_surface(const vs_mesh *m, vs_vec3 p, double distance) {
  for (size_t t = 0; t < m->triangle_count; t++) {
    const vs_vec3 v[3] = { m->vertices[m->triangles[t][0]], m->vertices[m->triangles[t][1]],
                           m->vertices[m->triangles[t][2]] };
    if (fmin(v[0].x, fmin(v[1].x, v[2].x)) > p.x + distance || fmax(v[0].x, fmax(v[1].x, v[2].x)) < p.x - distance ||
        fmin(v[0].y, fmin(v[1].y, v[2].y)) > p.y + distance || fmax(v[0].y, fmax(v[1].y, v[2].y)) < p.y - distance ||
        fmin(v[0].z, fmin(v[1].z, v[2].z)) > p.z + distance || fmax(v[0].z, fmax(v[1].z, v[2].z)) < p.z - distance)
      continue;
    if (near_triangle(p, v, distance)) return true;
  }
  return false;
}

bool vs_sweep_astray(const vs_astray *s, bool *marked, size_t *count, vs_vec3 *at, vs_error *e) {
  enum { ASKS = 64 };
  vs_facet_index index = { 0 };
  vs_step_point *points = vs_fresh(POINTS, sizeof *points);
  size_t all = 0;
  *count = 0;
  bool ok = points && vs_bends_samples(s->bends, points, POINTS, &all) && vs_mesh_copy(s->mesh, &index.mesh) &&
            vs_facet_index_make(&index);
  vs_inside *sections = ok ? vs_inside_within(s->node, s->tolerance / 2, e) : NULL;
  if (!ok) vs_error_memory(e, NULL);
  ok = ok && sections;
  for (size_t i = 0; ok && i < all; i++) {
    vs_vec3 p = points[i].at;
    if (i % ASKS == 0 && !vs_job_going(s->job, "meshing", -1))
      ok = vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
    if (vs_inside_test(sections, p) == vs_facet_index_holds(&index, p) ||
        near_surface(s->mesh, p, far_away * s->tolerance))
      continue;
    if (!*count) *at = p;
    marked[points[i].step] = true;
    ++*count;
  }
  if (sections) vs_inside_free(sections);
  vs_facet_index_free(&index);
  free(points);
  return ok;
}
