/* Computes the nearest intersection of a ray with an object.
 *
 * If the ray misses the object's bounds, no mesh is computed. Otherwise, all solids are combined to one mesh whose
 * triangles have origins, and surfaces are converted to triangles one by one. The result is the intersection with the
 * nearest triangle on the ray. */
#include "bind/scene/ray_hits.h"

#include <math.h>

#include "bind/call/context.h"
#include "bind/call/precision.h"
#include "geometry/measure/node_measures.h"
#include "geometry/measure/ray_tree.h"
#include "geometry/parts.h"
#include "geometry/tessellate.h"
#include "solids/resolve.h"
#include "solids/solid_meshes.h"

/* A ray: start and direction, which need not have unit length. */
typedef struct { vs_vec3 from, direction; } ray;

static size_t meets_mesh(const vs_mesh *m, const ray *r, double *at) {
  size_t nearest = m->triangle_count;
  *at = INFINITY;
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *c = m->triangles[i];
    const vs_vec3 p[3] = { m->vertices[c[0]], m->vertices[c[1]], m->vertices[c[2]] };
    double t = vs_ray_meets_triangle(p, r->from, r->direction);
    if (t < *at) *at = t, nearest = i;
  }
  return nearest;
}

static bool meets_solid(vs_scheme *vm, vs_ref ref, const vs_fineness *facets, const ray *r, vs_ray_hit *hit,
                        vs_error *e) {
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  vs_solid solid;
  if (!vs_solid_evaluate(&ref, 1, facets, &options, &solid, e)) return false;
  double at;
  size_t nearest = meets_mesh(&solid.mesh, r, &at);
  if (at < hit->at) *hit = (vs_ray_hit){ at, solid.parts[solid.mesh.tags[nearest]].leaf.origin };
  vs_solid_free(&solid);
  return true;
}

static bool meets_surface(vs_ref ref, const vs_fineness *facets, const ray *r, vs_ray_hit *hit, vs_error *e) {
  vs_ref *parts;
  size_t count;
  if (!vs_several_parts(ref, &parts, &count)) return vs_error_memory(e, ref.origin);
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    vs_mesh mesh = { 0 };
    double at;
    ok = vs_tessellate(parts[i].node, facets, &mesh, e);
    if (ok && meets_mesh(&mesh, r, &at) < mesh.triangle_count && at < hit->at)
      *hit = (vs_ray_hit){ at, parts[i].origin };
    vs_mesh_free(&mesh);
  }
  vs_several_free(parts, count);
  return ok;
}

bool vs_ray_meets(vs_scheme *vm, vs_ref object, vs_vec3 from, vs_vec3 direction, vs_ray_hit *hit, vs_error *e) {
  const ray r = { from, direction };
  *hit = (vs_ray_hit){ INFINITY, NULL };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm) };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  vs_bounds bounds;
  if (object.node->class_ == VS_NOTHING) return true;
  if (!vs_node_bounds(object.node, &bounds, e)) return false;
  if (vs_bounds_is_empty(&bounds) || !vs_ray_meets_box(&bounds, from, direction, INFINITY)) return true;
  if (facets.tolerance <= 0) facets.tolerance = vs_fineness_tolerance(&bounds);
  vs_node_retain(object.node);
  bool ok = !(object.node->flags & VS_NODE_UNRESOLVED) || vs_resolve(&object, 1, &facets, &options, e);
  vs_class c = (vs_class)object.node->class_;
  if (ok && (c == VS_SOLID || c == VS_MIXED)) ok = meets_solid(vm, object, &facets, &r, hit, e);
  else if (ok && c == VS_SURFACE) ok = meets_surface(object, &facets, &r, hit, e);
  vs_node_release(object.node);
  return ok;
}
