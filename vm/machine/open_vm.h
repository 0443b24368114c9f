/* Owns the creation and the end of an interpreter. */
#ifndef VS_VM_MACHINE_OPEN_VM_H
#define VS_VM_MACHINE_OPEN_VM_H

#include "vm/values/flat.h"

/* Returns an interpreter with the VM's own natives; NULL when memory is out. */
vs_scheme *vs_open_vm(const vs_config *config);
void vs_close_vm(vs_scheme *vm);
/* Closes the contents of vm and moves those of `fresh` into their place; `fresh` is then gone. Objects of the old
 * heap know vm by its address, so they are released there. `fresh` has just been opened: no object in it knows its
 * address. */
void vs_replace_vm(vs_scheme *vm, vs_scheme *fresh);
/* The host fills the rules and registers them before it defines natives. The VM keeps a copy. */
bool vs_flat_register(vs_scheme *vm, const vs_flat_rules *rules);

#endif
