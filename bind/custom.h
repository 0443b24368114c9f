/* Declares objects of kinds that users define: their nodes and numbers, nodes with replaced children, and the calls of
 * drawing functions. Implemented in custom.c. */
#ifndef VS_BIND_CUSTOM_H
#define VS_BIND_CUSTOM_H

#include "model/node.h"

typedef struct vs_bind vs_bind;

void vs_bind_ticket_gone(void *bind, uint32_t number); /* Callback: the last node with this number was released. */
/* vs_bind_hand_on replaces objects in an array by the results of the drawing functions for a format with these names
 * (NULL at the end). The caller owns the new references. At least one function must be registered. If it fails, sets
 * the error and returns false. */
bool vs_bind_hands_on(const vs_bind *b); /* Returns true if a drawing function is registered. */
bool vs_bind_hand_on(vs_bind *b, vs_ref *refs, size_t count, const char *const *names);

#endif
