/* Raises the error of a lower layer in the program (raise.h). */
#include "bind/call/raise.h"

#include "vm/machine/fail.h"

vs_status vs_bind_error(vs_scheme *vm, const vs_error *e) {
  switch (e->kind) {
    case VS_ERROR_MEMORY: return vs_fail_memory(vm);
    case VS_ERROR_LIMIT: return vs_fail(vm, vm->sym.limit, "%s", e->message);
    case VS_ERROR_INTERRUPT: return vs_fail(vm, vm->sym.interrupt, "interrupted");
    case VS_ERROR_FILE: return vs_fail(vm, vm->sym.file, "%s", e->message);
    case VS_ERROR_NONE: case VS_ERROR_MODEL: case VS_ERROR_WORKER: break;
  }
  return vs_fail(vm, vm->sym.error, "%s", *e->message ? e->message : "cannot be computed");
}
