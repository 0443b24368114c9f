/* Writes compiled code as text: one instruction per line, with the names of its constants. */
#include "vm/compiler/code.h"

#include <stdio.h>

#include "vm/values/printer.h"
#include "vm/machine/run.h"
#include "vm/compiler/dump.h"

static const char *const names[VS_O_COUNT] = {
#define VS_OP(name, operands, extra, generic) #name,
#include "vm/compiler/opcodes.def"
#undef VS_OP
};

/* Appends constant number `index` of the code to the text: the name of a global variable, or a literal. */
static bool put_constant(vs_scheme *vm, vs_value code, uint32_t index, vs_text *t) {
  if (index >= vs_as_vector(vs_as_code(code)->consts)->length) return true;
  vs_value v = vs_code_consts(vs_as_code(code))[index];
  if (vs_is(v, VS_T_CELL)) v = vs_as_cell(v)->name;
  if (vs_is(v, VS_T_CODE)) v = vs_as_code(v)->name;
  return vs_text_puts(t, "  ; ") && vs_print(vm, v, VS_PRINT_WRITE, t);
}

static bool dump_one(vs_scheme *vm, vs_value code, uint32_t pc, vs_text *t, uint32_t *next) {
  const uint32_t *at = vs_code_ins(vs_as_code(code)) + pc;
  uint32_t op = at[0] & 255, extra = vs_op_extra(op);
  const char *operands = vs_op_operands(op);
  char text[120];
  int n = snprintf(text, sizeof text, "%5u  %-10s", pc, names[op]);
  for (int i = 0; i < 3 && operands[i] != '-'; i++) {
    uint32_t v = operands[i] == 'x' ? VS_BX(at[0]) : i == 0 ? VS_A(at[0]) : i == 1 ? VS_B(at[0]) : VS_C(at[0]);
    bool number = operands[i] == 'i' || operands[i] == 'x';
    n += snprintf(text + n, sizeof text - (size_t)n, number ? " %u" : " r%u", v);
    if (operands[i] == 'x') break;
  }
  for (uint32_t i = 1; i <= extra; i++) n += snprintf(text + n, sizeof text - (size_t)n, " [%d]", (int)at[i]);
  *next = pc + 1 + extra;
  if (!vs_text_puts(t, text)) return false;
  bool named = op == VS_O_GLOBAL || op == VS_O_SETGLOBAL || op == VS_O_DEFGLOBAL || op == VS_O_CALLG ||
      op == VS_O_TAILG || op == VS_O_CONSTX || op == VS_O_CLOSURE;
  if (op == VS_O_CONST) return put_constant(vm, code, VS_BX(at[0]), t);
  if (op == VS_O_CLOSURE && at[1] < vs_as_vector(vs_as_code(code)->consts)->length &&
      vs_is(vs_code_consts(vs_as_code(code))[at[1]], VS_T_CODE))
    *next += vs_as_code(vs_code_consts(vs_as_code(code))[at[1]])->free;
  return !named || put_constant(vm, code, at[1], t);
}

bool vs_code_dump(vs_scheme *vm, vs_value code, bool (*each)(void *context, const char *line), void *context) {
  VS_ROOTS(vm, r, 1);
  r[0] = code;
  uint32_t words = (uint32_t)(vs_as_bytes(vs_as_code(r[0])->ins)->length / sizeof(uint32_t));
  bool ok = true;
  for (uint32_t pc = 0, next; ok && pc < words; pc = next) {
    vs_text t;
    vs_text_open(vm, &t, 300);
    ok = dump_one(vm, r[0], pc, &t, &next) && vs_text_end(&t);
    bool more = ok && each(context, t.at);
    vs_text_close(&t);
    if (!more) break;
  }
  return ok;
}
