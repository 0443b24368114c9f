/* Declares how natives report errors, implemented in fail.c. */
#ifndef VS_VM_MACHINE_FAIL_H
#define VS_VM_MACHINE_FAIL_H

#include "vm/values/value.h"

/* Functions that describe the running calls for a new error object. activation.c, a layer above fail.c, implements
 * them. */
typedef struct vs_traceback {
  bool (*chain)(vs_scheme *vm, size_t max, vs_value *out);    /* Sets *out to names and places of the running calls.
                                                               * Returns false when memory is out. */
  bool (*variables)(vs_scheme *vm, vs_value *out);            /* Sets *out to the variables of the running calls.
                                                               * Returns false when memory is out. */
  vs_pos (*place)(vs_scheme *vm);                             /* returns the place in the source at which the running
                                                               * native was called */
} vs_traceback;

/* Returns true if a[arg] is an object of the type (VS_T_...). Otherwise sets a type error with the type's noun in
 * object.def, and returns false. */
bool vs_arg_type(vs_scheme *vm, const vs_value *a, int arg, int type);
/* Returns the length of a proper list, or -1 for other values. */
int64_t vs_list_length(vs_value list);
/* Returns a noun with an article for the kind of v, for messages: "a string", "a point", "a number". */
const char *vs_noun(vs_scheme *vm, vs_value v);

#endif
