/* Owns the interface of origins.c: the places of calls. */
#ifndef VS_BIND_ORIGINS_H
#define VS_BIND_ORIGINS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* Where the running native was called from, and its callers. NULL: not known (or out of memory: then nothing worse
 * happens). */
const vs_origin *vs_bind_origin(vs_bind *b);
/* A position's file as text of the store; NULL: nowhere, or one of the language's own sources: places in those are not
 * the user's business. */
const char *vs_bind_file_name(vs_bind *b, vs_pos place);
bool vs_bind_is_library(vs_bind *b, uint32_t file); /* is the file of this number one of those sources? */
uint32_t vs_bind_file_count(vs_scheme *vm); /* files that have a number */

#endif
