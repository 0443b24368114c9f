/* Owns the interface of thrown.c: warnings of objects that a program makes and throws away. */
#ifndef VS_BIND_THROWN_H
#define VS_BIND_THROWN_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

void vs_bind_dropped(vs_scheme *vm, vs_value v); /* notes that an expression of a body, not its last, gave v; for
                                                  * vs_config */
void vs_bind_tell_dropped(vs_bind *b);    /* warns of those that did not become part of the model, and forgets them */
void vs_bind_forget_dropped(vs_bind *b);
void vs_bind_warn_thrown(vs_bind *b, const vs_node *node, const vs_origin *origin, bool in_body);

#endif
