/* Implements the errors for names that are reserved for future versions of the language. */
#include "bind/reserved.h"

#include "vm/machine/activation.h"
#include "vm/machine/fail.h"

static const struct { const char *name, *instead; } reserved[] = {
#define RESERVED(name, instead) { name, instead },
#include "bind/reserved.def"
#undef RESERVED
};

static vs_native_fn refuse;
static const vs_native_def defs[] = {
#define RESERVED(name, instead) { name, ". arguments", refuse, 0, "reserved" },
#include "bind/reserved.def"
#undef RESERVED
  { NULL, NULL, NULL, 0, NULL }
};
const vs_native_table vs_bind_reserved_table = { "reserved", defs };

static vs_status refuse(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n, (void)out;
  return vs_fail(vm, vm->sym.unbound, "this procedure does not exist yet; instead: %s",
                 reserved[vm->native->def - defs].instead);
}
