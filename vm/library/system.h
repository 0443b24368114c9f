/* Declares functions of system.c on random numbers. */
#ifndef VS_VM_LIBRARY_SYSTEM_H
#define VS_VM_LIBRARY_SYSTEM_H

#include "vm/values/value.h"

bool vs_random_keep(vs_scheme *vm, uint64_t state[4]);          /* Copies the random generator's state to `state`. */
bool vs_random_restore(vs_scheme *vm, const uint64_t state[4]); /* Sets the random generator's state to `state`, a copy
                                                                 * made earlier. */
/* Seeds the random generator with a combination of the program's seed and a key. */
bool vs_random_branch(vs_scheme *vm, uint64_t key);
bool vs_random_unit(vs_scheme *vm, double *out);                /* Sets *out to the next random number in [0, 1). */

#endif
