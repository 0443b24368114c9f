/* Contains the table of procedures as C data, and the native that runs all of them. */
#include "bind/procedures.h"

#include "bind/call/contract.h"
#include "bind/call/procedure.h"
#include "bind/functions/dual_points.h"

#define ARG(name, contract) name " "
#define OPT(name, contract) "[" name "] "
#define REST(name, contract) ". " name " "
#define KEY(name, contract) "#:" name " "
#define FORM(...) __VA_ARGS__
#define KEYS(...) __VA_ARGS__
#define PROC(id, name, fn, doc, forms, keys) { name, "" forms keys, vs_bind_enter, 0, doc },
#define PROCS(id, name, signature, fn, doc, forms, keys) { name, signature, vs_bind_enter, 0, doc },
const vs_native_def vs_bind_defs[] = {
#include "bind/procedures.def"
  { NULL, NULL, NULL, 0, NULL }
};
#undef ARG
#undef OPT
#undef REST
#undef KEY
#undef FORM
#undef KEYS
#undef PROC
#undef PROCS

#define ARG(name, contract) { name, VS_ARG_REQUIRED, VS_C_##contract },
#define OPT(name, contract) { name, VS_ARG_OPTIONAL, VS_C_##contract },
#define REST(name, contract) { name, VS_ARG_REST, VS_C_##contract },
#define KEY(name, contract) { name, VS_ARG_OPTIONAL, VS_C_##contract },
#define FORM(...) { 1, { __VA_ARGS__ { "", VS_ARG_END, 0 } } },
#define KEYS(...) { __VA_ARGS__ { "", VS_ARG_END, 0 } }
#define PROC(id, name, fn, doc, forms, keys) { { forms }, keys },
#define PROCS(id, name, signature, fn, doc, forms, keys) { { forms }, keys },
const vs_procedure vs_bind_procedures[] = {
#include "bind/procedures.def"
};
#undef ARG
#undef OPT
#undef REST
#undef KEY
#undef FORM
#undef KEYS
#undef PROC
#undef PROCS

#define PROC(id, name, fn, doc, forms, keys) fn,
#define PROCS(id, name, signature, fn, doc, forms, keys) fn,
/* The C functions of the procedures, in an array separate from the rows of the table. Without function addresses in
 * them, the 320 KB of rows need no relocation when the program is loaded. */
static vs_procedure_fn *const functions[] = {
#include "bind/procedures.def"
};
#undef PROC
#undef PROCS

const vs_native_table vs_bind_table = { "geometry", vs_bind_defs };

vs_status vs_bind_enter(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  static const vs_bind_columns table = { vs_bind_defs, vs_bind_procedures, functions, vs_dual_points };
  return vs_bind_call(vm, &table, a, n, out);
}
