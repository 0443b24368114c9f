/* Declares functions that return the places of calls with their callers (origins). Implemented in origins.c. */
#ifndef VS_BIND_ORIGINS_H
#define VS_BIND_ORIGINS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* Returns the origin of the running native's call: its place with its callers. Returns NULL, without an error, if the
 * place is unknown or memory is out. */
const vs_origin *vs_bind_origin(vs_bind *b);
/* Returns the name of the file that contains the place; the store owns the text. Returns NULL for a place without file,
 * and for sources of the language itself, which do not concern users. */
const char *vs_bind_file_name(vs_bind *b, vs_pos place);
bool vs_bind_is_library(vs_bind *b, uint32_t file); /* Returns true if the file with this number is a source of the
                                                     * language itself. */
uint32_t vs_bind_file_count(vs_scheme *vm); /* Returns the greatest number that a source file has. */

#endif
