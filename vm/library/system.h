/* Owns the interface of system.c: random numbers, clocks, and what a program may ask of its surroundings. */
#ifndef VS_VM_LIBRARY_SYSTEM_H
#define VS_VM_LIBRARY_SYSTEM_H

#include "vm/values/value.h"

bool vs_random_keep(vs_scheme *vm, uint64_t state[4]);          /* copies the generator's state out */
bool vs_random_restore(vs_scheme *vm, const uint64_t state[4]); /* puts such a copy back */
/* starts the generator anew from the program's seed and a key */
bool vs_random_branch(vs_scheme *vm, uint64_t key);
bool vs_random_unit(vs_scheme *vm, double *out);                /* the next number in [0, 1) */

#endif
