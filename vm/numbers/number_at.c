/* Owns the reading of numbers that stand in a program. */
#include "vm/numbers/number_at.h"

bool vs_number_parse_at(vs_scheme *vm, const char *s, size_t n, vs_pos place, vs_value *out) {
  if (vs_number_parse(vm, s, n, 10, out)) return true;
  vs_value why = vm->condition;
  if (!vs_is(why, VS_T_CONDITION) || vs_as_condition(why)->kind != vm->sym.range) return false; /* memory */
  return vs_fail_at(vm, vm->sym.read, place, VS_NIL, "%.*s%s: this exact number is too large to be written out",
                    (int)(n > 60 ? 60 : n), s, n > 60 ? "..." : "");
}
