/* Owns the interface of custom.c: objects of users' kinds in C: their nodes and numbers, the rebuilding of a node
 * with other children, and the way into the drawing functions. */
#ifndef VS_BIND_CUSTOM_H
#define VS_BIND_CUSTOM_H

#include "model/node.h"

typedef struct vs_bind vs_bind;

void vs_bind_ticket_gone(void *bind, uint32_t number); /* custom.c */
/* Objects as drawing functions want them for a format of these names (NULL at the end): in place, new references for
 * old. False: the condition is set. Needs one registered. */
bool vs_bind_hands_on(const vs_bind *b); /* was a drawing function registered? */
bool vs_bind_hand_on(vs_bind *b, vs_ref *refs, size_t count, const char *const *names);

#endif
