/* Owns the interface of back_ends.c: the drawing as a value, and the list of the back-ends that programs define. */
#ifndef VS_BIND_BACK_ENDS_H
#define VS_BIND_BACK_ENDS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* A back-end that the program defined; the texts are the store's. */
typedef struct vs_bind_back_end { const char *name, *suffix, *doc; bool binary, optimised; } vs_bind_back_end;

/* Returns the program's back-end of this name, or of this ending of a path; NULL if there is none. */
const vs_bind_back_end *vs_bind_back_end_find(const vs_bind *b, const char *text);
/* Calls the back-end's procedure with these objects. *text gets *bytes bytes and room for one more, from vs_mem; the
 * caller frees it. Returns false with the condition set. */
bool vs_bind_back_end_write(vs_bind *b, const char *name, const vs_ref *refs, size_t count, char **text, size_t *bytes);

#endif
