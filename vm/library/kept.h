/* Declares the values that the library keeps between calls: the elements of the vector vm->at.lib. */
#ifndef VS_VM_LIBRARY_KEPT_H
#define VS_VM_LIBRARY_KEPT_H

#include "vm/values/gc.h"

enum {
  VS_LIB_INPUT, VS_LIB_OUTPUT, VS_LIB_ERROR,     /* parameter objects of the current ports (port.c) */
  VS_LIB_RANDOM,                                 /* BYTES: state of the random generator (system.c) */
  VS_LIB_SYMBOLS,                                /* fixnum: number of symbols that the program has generated
                                                  * (system.c) */
  VS_LIB_DUALS,                                  /* fixnum: number of differentiations so far, from which the levels of
                                                  * dual numbers are computed (bind/functions/) */
  VS_LIB_COUNT
};

static inline bool vs_lib_open(vs_scheme *vm) {
  return vs_is_vector(vm->at.lib) || vs_make_vector(vm, VS_LIB_COUNT, VS_FALSE, &vm->at.lib);
}
/* Returns the value in the slot VS_LIB_..., or #f before its first use. */
static inline vs_value vs_lib_get(const vs_scheme *vm, int slot) {
  VS_ASSERT(slot >= 0 && slot < VS_LIB_COUNT);
  return vs_is_vector(vm->at.lib) ? vs_as_vector(vm->at.lib)->at[slot] : VS_FALSE;
}
/* Sets the value in the slot VS_LIB_.... */
static inline void vs_lib_set(vs_scheme *vm, int slot, vs_value v) {
  VS_ASSERT(slot >= 0 && slot < VS_LIB_COUNT);
  vs_gc_store(vm, vs_as_vector(vm->at.lib), &vs_as_vector(vm->at.lib)->at[slot], v);
}

#endif
