/* Declares the functions that write each kind of node as POV-Ray text. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_SHAPES_H
#define VS_BACKENDS_POVRAY_POVRAY_SHAPES_H

#include "backends/povray/povray_materials.h"

/* vs_povray_define writes the beginning or the end of a template, and vs_povray_use a reference to it. vs_povray_item
 * is called before and after each drawn object. */
bool vs_povray_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open);
bool vs_povray_use(vs_emitter *e, uint32_t id, const vs_ref *ref);
bool vs_povray_item(vs_emitter *e, size_t index, bool end);

#endif
