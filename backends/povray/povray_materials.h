/* Declares materials as POV-Ray's textures. A parameter `pixel` is the width of a pixel in the scene at the nearest
 * point of the model. A pattern whose units are smaller than a pixel is omitted, and only the material's colour is
 * shown. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_MATERIALS_H
#define VS_BACKENDS_POVRAY_POVRAY_MATERIALS_H

#include "backends/backend.h"

/* Writes a reference such as ` material { M_3_steel }` to a material that vs_povray_begin has declared. */
bool vs_povray_paint(vs_emitter *e, const vs_material *m);
/* Declares the material under a name such as M_3_steel, after the functions that its pattern needs. */
bool vs_povray_declare_material(vs_emitter *e, const vs_material *m, double pixel);
/* vs_povray_prepare_texture writes the declarations that vs_povray_texture needs. vs_povray_texture writes pigment,
 * normal and finish, to be used inside a texture. */
void vs_povray_prepare_texture(vs_emitter *e, const vs_material *m, double pixel);
void vs_povray_texture(vs_emitter *e, const vs_material *m, double pixel);
void vs_povray_interior(vs_emitter *e, const vs_material *m);
/* Writes the letters, digits and underscores of a user's name, and omits all other characters. */
void vs_povray_name(vs_writer *w, const char *text);

/* Returns true if the scene's style shows all opaque materials in white. */
bool vs_povray_is_white(const vs_scene *scene);

#endif
