/* Contains the declarations for the files of the POV-Ray back-end. povray_scene.c writes begin and end, povray_shapes.c
 * each kind of node, povray_meshes.c triangles. povray_plan.c, povray_worker.c and povray_process.c run POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_H
#define VS_BACKENDS_POVRAY_POVRAY_H

#include "backends/povray/povray_materials.h"

/* Returns the fraction of white light that a matt surface of material m scatters; the colour is multiplied by it. m may
 * be NULL. For clear glass the fraction is 0. */
static inline double vs_povray_diffuse(const vs_material *m) {
  if (m && m->transparency > 0) return m->transparency < 0.9 ? 0.8 * (1 - m->transparency) : 0;
  return m && m->metallic > 0.5 ? 0.35 + 0.35 * m->roughness : 0.82;
}

vs_emit_fn vs_povray_line, vs_povray_region, vs_povray_box, vs_povray_sphere, vs_povray_cylinder, vs_povray_cone,
    vs_povray_cut_cone, vs_povray_half_space, vs_povray_e_cone, vs_povray_superellipsoid, vs_povray_revolve,
    vs_povray_torus, vs_povray_extrude, vs_povray_transform, vs_povray_material, vs_povray_layer,
    vs_povray_csg, vs_povray_native;

#endif
