/* Owns the interface of custom.c: objects of users' kinds in C, with their nodes and numbers; the rebuilding of a node
 * with other children; and the calls of the drawing functions. */
#ifndef VS_BIND_CUSTOM_H
#define VS_BIND_CUSTOM_H

#include "model/node.h"

typedef struct vs_bind vs_bind;

void vs_bind_ticket_gone(void *bind, uint32_t number); /* custom.c */
/* Replaces objects by the results of the drawing functions for a format of these names (NULL at the end), in place,
 * with new references. Needs a registered function. Returns false with the condition set. */
bool vs_bind_hands_on(const vs_bind *b); /* returns true if a drawing function is registered */
bool vs_bind_hand_on(vs_bind *b, vs_ref *refs, size_t count, const char *const *names);

#endif
