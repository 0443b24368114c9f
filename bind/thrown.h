/* Declares warnings about objects that a program creates but does not use. Implemented in thrown.c. */
#ifndef VS_BIND_THROWN_H
#define VS_BIND_THROWN_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

void vs_bind_dropped(vs_scheme *vm, vs_value v); /* Records that v, the value of an expression in a body, is not used.
                                                  * The interpreter calls it (vs_config.dropped). */
void vs_bind_tell_dropped(vs_bind *b);    /* Warns about the recorded objects that are not part of the model, and
                                           * deletes the record. */
void vs_bind_forget_dropped(vs_bind *b);
void vs_bind_warn_thrown(vs_bind *b, const vs_node *node, const vs_origin *origin, bool in_body);

#endif
