/* Owns the making and unmaking of an interpreter. */
#ifndef VS_VM_MACHINE_OPEN_VM_H
#define VS_VM_MACHINE_OPEN_VM_H

#include "vm/values/flat.h"

/* An interpreter with the VM's own natives defined; NULL when memory is refused. */
vs_scheme *vs_open_vm(const vs_config *config);
void vs_close_vm(vs_scheme *vm);
/* Closes the contents of vm and moves those of fresh in their place; fresh is no more then. Objects of the old heap
   know vm by its address, so they are let go there. Fresh is as opened: no object in it knows its address. */
void vs_replace_vm(vs_scheme *vm, vs_scheme *fresh);
/* The host fills rules and gives them before natives are defined; the VM keeps a copy. */
bool vs_flat_register(vs_scheme *vm, const vs_flat_rules *rules);

#endif
