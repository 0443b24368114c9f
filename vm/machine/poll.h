/* Owns the limits of steps and time, and interrupts. A program has fuel for a number of turns; the machine checks the
 * limits when it is used up. Natives that run long use fuel with vs_poll and its like (native.h). */
#ifndef VS_VM_MACHINE_POLL_H
#define VS_VM_MACHINE_POLL_H

#include "vm/machine/vs.h"

/* Checks the limits now and refuels. Returns false with the condition set if a limit is reached. */
bool vs_poll_limits(vs_scheme *vm);

/* Sets the fuel for the next stretch. If there is a limit of steps, no stretch exceeds its rest, so the limit is
 * exact. */
void vs_refuel(vs_scheme *vm);

/* memmove and memset in pieces, with polls between them. A block larger than a piece is an object that does not move,
 * or no object. */
bool vs_poll_move(vs_scheme *vm, void *to, const void *from, size_t bytes);
bool vs_poll_set(vs_scheme *vm, void *to, int byte, size_t bytes);

#endif
