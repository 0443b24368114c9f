/* Owns the interface of fail.c: how a native fails. */
#ifndef VS_VM_MACHINE_FAIL_H
#define VS_VM_MACHINE_FAIL_H

#include "vm/values/value.h"

/* How a new condition learns of the calls under way. activation.c has them; fail.c is below it. */
typedef struct vs_traceback {
  bool (*chain)(vs_scheme *vm, size_t max, vs_value *out);    /* places and names of the calls; false: out of memory */
  bool (*variables)(vs_scheme *vm, vs_value *out);            /* their variables; false: out of memory */
  vs_pos (*place)(vs_scheme *vm);                             /* of the call of the running native */
} vs_traceback;

/* a VS_T_ type; the noun from object.def */
bool vs_arg_type(vs_scheme *vm, const vs_value *a, int arg, int type);
/* Length of a proper list, -1 if improper or circular. */
int64_t vs_list_length(vs_value list);
/* what v is, with article, for messages: "a string", "a point", "a number" */
const char *vs_noun(vs_scheme *vm, vs_value v);

#endif
