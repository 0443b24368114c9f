/* Computes volume, area and centroid of a closed mesh. */
#include "geometry/measure/measure.h"

void vs_mesh_measure(const vs_mesh *mesh, vs_measure *out) {
  *out = (vs_measure){ .known = true, .area_known = true, .volume = vs_mesh_volume(mesh), .area = vs_mesh_area(mesh) };
  if (!mesh->triangle_count) return;
  vs_vec3 o = mesh->vertices[mesh->triangles[0][0]], sum = { 0, 0, 0 };
  double six = 0;
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    vs_vec3 p[3];
    for (int k = 0; k < 3; k++) p[k] = vs_v3_sub(mesh->vertices[mesh->triangles[i][k]], o);
    double v = vs_v3_dot(p[0], vs_v3_cross(p[1], p[2]));
    six += v;
    sum = vs_v3_add(sum, vs_v3_scale(vs_v3_add(vs_v3_add(p[0], p[1]), p[2]), v / 4));
  }
  out->centroid = six != 0 ? vs_v3_add(o, vs_v3_scale(sum, 1 / six)) : o;
}
