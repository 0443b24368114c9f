/* Declares the limits of steps and time, and interrupts. A program has fuel: a number of turns (calls and loop
 * iterations) until the next check. When the fuel is used up, the run loop checks the limits. Natives that run long
 * reduce the fuel by vs_poll and similar functions (native.h). */
#ifndef VS_VM_MACHINE_POLL_H
#define VS_VM_MACHINE_POLL_H

#include "vm/machine/vs.h"

/* Checks the limits now and sets new fuel. Returns false with the error set if a limit is reached. */
bool vs_poll_limits(vs_scheme *vm);

/* Sets the fuel (number of turns) until the next check. The fuel never exceeds the turns that the limit of steps still
 * allows, so that the limit is exact. */
void vs_refuel(vs_scheme *vm);

/* Works as memmove, in pieces with polls between them. A block larger than a piece must not be in an object that the
 * garbage collector could move. */
bool vs_poll_move(vs_scheme *vm, void *to, const void *from, size_t bytes);
/* Works as memset, in pieces with polls between them; for the same blocks as vs_poll_move. */
bool vs_poll_set(vs_scheme *vm, void *to, int byte, size_t bytes);

#endif
