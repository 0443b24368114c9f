/* Declares the search for materials by name. */
#ifndef VS_MODEL_LOOKS_READY_MATERIALS_H
#define VS_MODEL_LOOKS_READY_MATERIALS_H

#include "model/store/store.h"

/* Returns the material with this name: a predefined material such as concrete or glass, a CSS colour, or "#rrggbb".
 * Returns NULL if the name is unknown or memory is out. */
const vs_material *vs_store_ready_material(vs_store *s, const char *name);
/* In which table a material is: in none, in the predefined materials, or in the CSS colours. */
typedef enum { VS_NAMED_NONE, VS_NAMED_MATERIAL, VS_NAMED_COLOR } vs_named;
/* Returns the table that contains a material with the name and all properties of m, or VS_NAMED_NONE. */
vs_named vs_ready_material_table(const vs_material *m);
const char *vs_ready_material_name(size_t i); /* Returns the name of predefined material number i, counted from 0; NULL
                                               * if there are no more. */

#endif
