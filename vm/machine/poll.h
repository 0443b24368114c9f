/* Owns the limits of steps and time, and interrupts. A program has fuel for so many turns; when it is used up the
 * limits are looked at. Natives that work long give up fuel by vs_poll and its like (native.h). */
#ifndef VS_VM_MACHINE_POLL_H
#define VS_VM_MACHINE_POLL_H

#include "vm/machine/vs.h"

/* Looks at the limits now and gives new fuel. Returns false, with the condition set, where one is reached. */
bool vs_poll_limits(vs_scheme *vm);

/* Gives fuel for the next stretch. With a limit of steps the last stretch is as long as what is left of it, so
 * that the limit is exact. */
void vs_refuel(vs_scheme *vm);

/* memmove and memset in pieces, polling between them. A block larger than a piece is an object that does not move, or
   no object. */
bool vs_poll_move(vs_scheme *vm, void *to, const void *from, size_t bytes);
bool vs_poll_set(vs_scheme *vm, void *to, int byte, size_t bytes);

#endif
