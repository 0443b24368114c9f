/* Owns the materials that exist by name. */
#ifndef VS_MODEL_LOOKS_READY_MATERIALS_H
#define VS_MODEL_LOOKS_READY_MATERIALS_H

#include "model/store/store.h"

/* The material of a name: concrete, glass, ... or a CSS colour, or "#rrggbb". NULL: there is none, or out of memory. */
const vs_material *vs_store_ready_material(vs_store *s, const char *name);
const char *vs_ready_material_name(size_t i); /* those names one by one, NULL after the last */

#endif
