/* Owns the interface of fail.c: how a native reports an error. */
#ifndef VS_VM_MACHINE_FAIL_H
#define VS_VM_MACHINE_FAIL_H

#include "vm/values/value.h"

/* The functions that give a new condition the running calls. activation.c has them, a layer above fail.c. */
typedef struct vs_traceback {
  bool (*chain)(vs_scheme *vm, size_t max, vs_value *out);    /* places and names of the calls; false: out of memory */
  bool (*variables)(vs_scheme *vm, vs_value *out);            /* their variables; returns false when memory is out */
  vs_pos (*place)(vs_scheme *vm);                             /* of the call of the running native */
} vs_traceback;

/* type is a VS_T_ type, with its noun in object.def */
bool vs_arg_type(vs_scheme *vm, const vs_value *a, int arg, int type);
/* Returns the length of a proper list, -1 for an improper or circular one. */
int64_t vs_list_length(vs_value list);
/* Returns the noun of v with its article, for messages: "a string", "a point", "a number". */
const char *vs_noun(vs_scheme *vm, vs_value v);

#endif
