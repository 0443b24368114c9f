/* Declares the creation and freeing of interpreters. */
#ifndef VS_VM_MACHINE_OPEN_VM_H
#define VS_VM_MACHINE_OPEN_VM_H

#include "vm/values/flat.h"

/* Returns a new interpreter with the VM's own natives, or NULL when memory is out. */
vs_scheme *vs_open_vm(const vs_config *config);
void vs_close_vm(vs_scheme *vm);
/* Frees the contents of vm, moves the contents of `fresh` to vm, and frees the struct `fresh`. `fresh` must have been
 * created just before, so that no object refers to its address. Objects of vm's old heap refer to vm by its address,
 * and are released first. */
void vs_replace_vm(vs_scheme *vm, vs_scheme *fresh);
/* Registers the host's types of flat records (points and vectors). Call it before the host defines natives. The VM
 * keeps a copy of the rules. */
bool vs_flat_register(vs_scheme *vm, const vs_flat_rules *rules);

#endif
