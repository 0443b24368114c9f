/* Declares materials as POV-Ray's textures. `pixel` is the width of a pixel in the scene where the model is nearest: a
 * pattern whose unit is smaller is left out, and the material has its own colour. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_MATERIALS_H
#define VS_BACKENDS_POVRAY_POVRAY_MATERIALS_H

#include "backends/backend.h"

/* ` material { M_3_steel }`, which begin has declared. */
bool vs_povray_paint(vs_emitter *e, const vs_material *m);
/* Declares the material as M_3_steel, after the functions that its pattern needs. */
bool vs_povray_declare_material(vs_emitter *e, const vs_material *m, double pixel);
/* Pigment, normal and finish, as they stand within a texture; the first call puts out what the second's text refers
 * to. */
void vs_povray_prepare_texture(vs_emitter *e, const vs_material *m, double pixel);
void vs_povray_texture(vs_emitter *e, const vs_material *m, double pixel);
void vs_povray_interior(vs_emitter *e, const vs_material *m);
/* Letters, digits and low lines of a user's name; the rest is left out. */
void vs_povray_name(vs_writer *w, const char *text);

#endif
