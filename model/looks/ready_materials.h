/* Owns the materials that exist by name. */
#ifndef VS_MODEL_LOOKS_READY_MATERIALS_H
#define VS_MODEL_LOOKS_READY_MATERIALS_H

#include "model/store/store.h"

/* Returns the material of a name: concrete, glass, ... or a CSS colour, or "#rrggbb". NULL: no material has that name,
 * or memory is out. */
const vs_material *vs_store_ready_material(vs_store *s, const char *name);
const char *vs_ready_material_name(size_t i); /* returns the name of that index, NULL after the last */

#endif
