/* Owns the interface of back_ends.c: Owns, for programs, the drawing as a value and the back-ends that they bring. */
#ifndef VS_BIND_BACK_ENDS_H
#define VS_BIND_BACK_ENDS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

/* that the program brought; texts are the store's */
typedef struct vs_bind_back_end { const char *name, *suffix, *doc; bool binary, optimised; } vs_bind_back_end;

/* The program's back-end of this name, or of this ending of a path; NULL: it brought none such. */
const vs_bind_back_end *vs_bind_back_end_find(const vs_bind *b, const char *text);
/* Calls its procedure with these objects: *text holds *bytes bytes and room for one more, from vs_mem, the caller's to
 * free. False: the condition is set. */
bool vs_bind_back_end_write(vs_bind *b, const char *name, const vs_ref *refs, size_t count, char **text, size_t *bytes);

#endif
