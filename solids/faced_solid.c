/* Finds the faces of solids (faced_solid.h). */
#include "solids/faced_solid.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/measure/node_measures.h"
#include "geometry/shapes/simple_nodes.h"
#include "model/store/array.h"

void vs_faced_solid_free(vs_faced_solid *s) {
  vs_mesh_faces_free(&s->faces);
  vs_mesh_edges_free(&s->edges);
  vs_solid_free(&s->solid);
}

static bool is_round(const vs_node *n) {
  if (!n || !vs_node_has(n, VS_IS_ROUND)) return false;
  if (n->kind == VS_HULL) return n->child_count > 0;
  if (n->kind != VS_EXTRUDE || n->child_count != 1 || VS_AS(extrude, n)->twist != 0) return true;
  const vs_node *profile = n->children[0].node;
  return profile->kind != VS_LINE && !vs_node_is_outline(profile);
}

static const vs_node *primitive_of(const vs_faced_solid *s, uint32_t triangle) {
  return s->solid.parts[s->solid.mesh.tags[triangle]].leaf.node;
}

bool vs_faced_solid_is_round(const vs_faced_solid *s, uint32_t face) {
  VS_ASSERT(face < s->faces.face_count);
  return is_round(primitive_of(s, s->faces.faces[face].first));
}

bool vs_faced_solid_find(vs_ref ref, const vs_fineness *facets, const vs_kernel_options *options, vs_faced_solid *out,
                         vs_error *error) {
  vs_fineness own = *facets;
  vs_bounds b;
  *out = (vs_faced_solid){ 0 };
  if (!vs_node_bounds(ref.node, &b, error)) return false;
  if (!(own.tolerance > 0)) own.tolerance = fmax(vs_fineness_tolerance(&b) / 4, 1e-300);
  if (!vs_solid_of_leaves(ref, &own, options, &out->solid, error)) return false;
  const vs_mesh *m = &out->solid.mesh;
  bool *round = NULL, ok = VS_FRESH(round, m->triangle_count + 1) && vs_mesh_edges_make(&out->edges, m);
  for (uint32_t t = 0; ok && t < m->triangle_count; t++) round[t] = is_round(primitive_of(out, t));
  ok = ok && vs_mesh_faces_find(&out->edges, m->tags, round, &out->faces);
  free(round);
  return ok || vs_error_memory(error, NULL);
}
