/* Owns the interface of origins.c: the places of calls. */
#ifndef VS_BIND_ORIGINS_H
#define VS_BIND_ORIGINS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* Returns the place of the running native's call, with its callers. NULL: not known, or out of memory, which has no
 * other effect. */
const vs_origin *vs_bind_origin(vs_bind *b);
/* Returns the name of a position's file, a text of the store; NULL for no file, and for the language's own sources,
 * which do not concern users. */
const char *vs_bind_file_name(vs_bind *b, vs_pos place);
bool vs_bind_is_library(vs_bind *b, uint32_t file); /* returns true if the file of this number is one of those
                                                     * sources */
uint32_t vs_bind_file_count(vs_scheme *vm); /* the number of files that have a number */

#endif
