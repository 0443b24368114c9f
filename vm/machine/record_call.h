/* Calls the procedures that define-record-type creates. Their code has one instruction between the loading of the type
 * and the return, and an activation (frame) would cost several times as much. The functions of this file therefore
 * interpret the code without an activation. In unusual cases (another number of arguments, a record of another type, a
 * full nursery) the code itself runs, and reports errors. */
#ifndef VS_VM_MACHINE_RECORD_CALL_H
#define VS_VM_MACHINE_RECORD_CALL_H

#include "vm/compiler/code.h"
#include "vm/machine/vs.h"
#include "vm/values/gc.h"

/* Allocates a record of the type. The instructions at `ins` determine its fields: each is an argument in `at` or a
 * constant. Returns false if the nursery is full. */
static inline bool vs_record_make(vs_scheme *vm, const uint32_t *ins, vs_value type, const vs_value *at,
                                  vs_value *out) {
  if (!vs_is(type, VS_T_RECORD_TYPE)) return false;
  size_t fields = (size_t)vs_as_vector(vs_as_record_type(type)->fields)->length, words = VS_WORDS(vs_record) + fields;
  if (vm->end - vm->free < (ptrdiff_t)(words * sizeof(vs_value))) return false;
  vs_record *r = (vs_record *)(void *)vm->free;
  size_t i = 0;
  for (uint32_t one = *ins; (one & 255) != VS_O_RECORD; one = *++ins) {
    if (i == fields) return false;
    r->at[i++] = (one & 255) == VS_O_MOVE ? at[VS_B(one)] : VS_IMMEDIATE(VS_B(one), VS_C(one));
  }
  if (i != fields) return false;
  vm->free += words * sizeof(vs_value);
  r->h = (vs_object){VS_T_RECORD, 0, 0, (uint32_t)words};
  r->type = type;
  *out = vs_from_object(r);
  return true;
}

/* Calls the closure f, a procedure that define-record-type has created, with the n arguments in `at`. Returns false,
 * without effect, if f's code must run instead. */
static inline bool vs_record_call(vs_scheme *vm, vs_value f, const vs_value *at, size_t n, vs_value *out) {
  const vs_closure *c = vs_as_closure(f);
  const vs_code *code = vs_as_code(c->code);
  const uint32_t *ins = vs_code_ins(code);
  VS_ASSERT(code->flags & VS_CODE_RECORD);
  if (n != code->required || vm->fuel <= 1) return false;
  vs_value type = (*ins & 255) == VS_O_FREE ? c->free[VS_BX(*ins)] : vs_as_cell(vs_code_consts(code)[ins[1]])->value;
  ins += (*ins & 255) == VS_O_FREE ? 1 : 2;
  if (code->flags & VS_CODE_MAKE) {
    if (!vs_record_make(vm, ins, type, at, out)) return false;
  } else {
    bool its = vs_is(at[0], VS_T_RECORD) && vs_as_record(at[0])->type == type;
    if (code->flags & VS_CODE_TEST) {
      if (type == VS_UNDEFINED) return false;
      *out = vs_bool(its);
    } else if (!its || (ins[1] & 255) >= vs_record_fields(vs_as_record(at[0]))) {
      return false;
    } else if (code->flags & VS_CODE_GET) {
      *out = vs_as_record(at[0])->at[ins[1] & 255];
    } else {
      vs_record *r = vs_as_record(at[0]);
      vs_gc_store(vm, r, &r->at[ins[1] & 255], at[1]);
      *out = VS_UNSPECIFIC;
    }
  }
  vm->fuel--;
  return true;
}

#endif
