/* Owns the interface of system.c: random numbers, clocks, and the questions of a program about its environment. */
#ifndef VS_VM_LIBRARY_SYSTEM_H
#define VS_VM_LIBRARY_SYSTEM_H

#include "vm/values/value.h"

bool vs_random_keep(vs_scheme *vm, uint64_t state[4]);          /* copies the generator's state */
bool vs_random_restore(vs_scheme *vm, const uint64_t state[4]); /* restores such a copy */
/* Starts the generator again from the program's seed and a key. */
bool vs_random_branch(vs_scheme *vm, uint64_t key);
bool vs_random_unit(vs_scheme *vm, double *out);                /* the next number in [0, 1) */

#endif
