/* Declares the drawing as a Scheme value, and the list of the back-ends (export formats) that programs define.
 * Implemented in back_ends.c. */
#ifndef VS_BIND_BACK_ENDS_H
#define VS_BIND_BACK_ENDS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* A back-end that the program has defined. The store owns the texts of its members. */
typedef struct vs_bind_back_end { const char *name, *suffix, *doc; bool binary, optimised; } vs_bind_back_end;

/* Returns the program's back-end with this name or, if the text is a path, the back-end with the path's suffix. Returns
 * NULL if there is none. */
const vs_bind_back_end *vs_bind_back_end_find(const vs_bind *b, const char *text);
/* Calls the procedure of the back-end `name` with a list of the `count` objects. Sets *text to the result and *bytes to
 * its length. The memory of *text comes from vs_mem, has bytes + 1 bytes, and is freed by the caller. If it fails,
 * returns false and sets the error. */
bool vs_bind_back_end_write(vs_bind *b, const char *name, const vs_ref *refs, size_t count, char **text, size_t *bytes);

#endif
