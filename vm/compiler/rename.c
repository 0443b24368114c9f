/* Implements (%renamed procedure name), by which the library gives a procedure a second name. The procedure's code is
 * copied, and the new name replaces every constant that is the old name. Errors then show the name that the program
 * uses. */
#include "vm/compiler/code.h"
#include "vm/machine/native.h"

enum { DEEPEST = 16 };      /* greatest nesting of procedures in the library's own code */

static bool rename_code(vs_scheme *vm, vs_value code, vs_value from, vs_value to, int depth, vs_value *out) {
  VS_ROOTS(vm, r, 5);       /* roots of the garbage collector: code, its copy, constants, a constant, its copy */
  if (depth > DEEPEST) return vs_fail(vm, vm->sym.internal, "nested too deeply");
  r[0] = code;
  vs_code *copy = (vs_code *)(void *)vs_gc_alloc_old(vm, VS_T_CODE, VS_WORDS(vs_code));
  if (!copy) return false;
  const vs_code *c = vs_as_code(r[0]);
  vs_object header = copy->h;
  *copy = *c;
  copy->h = header;
  r[1] = vs_from_object(copy);
  if (copy->name == from) copy->name = to;
  size_t n = vs_as_vector(c->consts)->length;
  vs_vector *v = (vs_vector *)(void *)vs_gc_alloc_old(vm, VS_T_VECTOR, 2 + n);
  if (!v) return false;
  v->length = n;
  for (size_t i = 0; i < n; i++) v->at[i] = VS_FALSE;
  r[2] = vs_from_object(v);
  vs_gc_store(vm, vs_as_code(r[1]), &vs_as_code(r[1])->consts, r[2]);
  for (size_t i = 0; i < n; i++) {
    r[3] = vs_code_consts(vs_as_code(r[0]))[i];
    if (vs_is(r[3], VS_T_CODE) && !rename_code(vm, r[3], from, to, depth + 1, &r[3])) return false;
    vs_gc_store(vm, vs_as_vector(r[2]), &vs_as_vector(r[2])->at[i], r[3] == from ? to : r[3]);
  }
  *out = r[1];
  return true;
}

/* Renames a closure without captured variables, such as a procedure at a library's top level. */
static bool rename_closure(vs_scheme *vm, vs_value closure, vs_value to, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  vs_value code = vs_as_closure(closure)->code;
  if (vs_as_code(code)->free) return vs_fail(vm, vm->sym.internal, "this procedure captures variables");
  if (!rename_code(vm, code, vs_as_code(code)->name, to, 0, &r[0])) return false;
  vs_closure *c = (vs_closure *)(void *)vs_gc_alloc(vm, VS_T_CLOSURE, VS_WORDS(vs_closure));
  if (!c) return false;
  c->code = r[0];
  *out = vs_from_object(c);
  return true;
}

static vs_status renamed(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (vs_is(a[0], VS_T_PARAMETER)) {       /* a parameter object is not copied, only renamed */
    vs_gc_store(vm, vs_as_parameter(a[0]), &vs_as_parameter(a[0])->name, a[1]);
    *out = a[0];
    return VS_OK;
  }
  if (vs_is(a[0], VS_T_CLOSURE)) return rename_closure(vm, a[0], a[1], out);
  if (!vs_is(a[0], VS_T_CASE)) return vs_fail_type(vm, 0, "a procedure of the library in Scheme", a[0]);
  VS_ROOTS(vm, r, 2);
  size_t count = vs_as_case(a[0])->count;
  if (!vs_make_vector(vm, count, VS_FALSE, &r[0])) return VS_ERROR;
  for (size_t i = 0; i < count; i++) {
    if (!rename_closure(vm, vs_as_case(a[0])->clause[i], a[1], &r[1])) return VS_ERROR;
    vs_gc_store(vm, vs_as_vector(r[0]), &vs_as_vector(r[0])->at[i], r[1]);
  }
  vs_case *c = (vs_case *)(void *)vs_gc_alloc(vm, VS_T_CASE, VS_WORDS(vs_case) + count);
  if (!c) return VS_ERROR;
  c->count = count;
  memcpy(c->clause, vs_as_vector(r[0])->at, count * sizeof *c->clause);
  *out = vs_from_object(c);
  return VS_OK;
}

static const vs_native_def defs[] = {
  {"%renamed", "procedure name", renamed, 0, NULL},
  {0}
};
const vs_native_table vs_rename_natives = {"rename", defs};
