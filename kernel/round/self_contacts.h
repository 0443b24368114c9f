/* Declares the functions of self_contacts.c: the search for triangles that rounding has made meet, anywhere in the
 * mesh. */
#ifndef VS_KERNEL_ROUND_SELF_CONTACTS_H
#define VS_KERNEL_ROUND_SELF_CONTACTS_H

#include "kernel/round/rounding_state.h"

/* Counts the triangles that intersect another triangle after rounding; each is counted once. */
bool vs_rounding_count_met(vs_rounding *s, vs_rounded *out);

#endif
