/* Declares objects of kinds that users define: their nodes and numbers, nodes with replaced children, and the calls of
 * drawing functions. Implemented in custom.c. */
#ifndef VS_BIND_CUSTOM_H
#define VS_BIND_CUSTOM_H

#include "model/node.h"

typedef struct vs_bind vs_bind;

void vs_bind_ticket_gone(void *bind, uint32_t number); /* Called when the last node with this number is released. */
/* vs_bind_hand_on replaces each object in an array by the result of the program's drawing function for it. names: the
 * names of the output format, ended by NULL. The caller owns the new references. At least one drawing function must be
 * registered. If it fails, sets the error and returns false. */
bool vs_bind_hands_on(const vs_bind *b); /* Returns true if the program has registered a drawing function. */
bool vs_bind_hand_on(vs_bind *b, vs_ref *refs, size_t count, const char *const *names);

#endif
