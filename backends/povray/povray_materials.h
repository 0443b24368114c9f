/* Owns materials as POV-Ray's textures. `pixel` is the width of a pixel in the scene at the nearest point of the model:
 * a pattern with a smaller unit is omitted, and the material has its own colour. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_MATERIALS_H
#define VS_BACKENDS_POVRAY_POVRAY_MATERIALS_H

#include "backends/backend.h"

/* Writes ` material { M_3_steel }`, which begin has declared. */
bool vs_povray_paint(vs_emitter *e, const vs_material *m);
/* Declares the material as M_3_steel, after the functions that its pattern needs. */
bool vs_povray_declare_material(vs_emitter *e, const vs_material *m, double pixel);
/* Write pigment, normal and finish, for use inside a texture; the first call writes the declarations to which the
 * second refers. */
void vs_povray_prepare_texture(vs_emitter *e, const vs_material *m, double pixel);
void vs_povray_texture(vs_emitter *e, const vs_material *m, double pixel);
void vs_povray_interior(vs_emitter *e, const vs_material *m);
/* Writes the letters, digits and underscores of a user's name, and omits all others. */
void vs_povray_name(vs_writer *w, const char *text);

#endif
