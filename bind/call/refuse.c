/* Sets the errors of checked calls that refuse an argument. An error contains the argument's name, its contract, the
 * value, and the form that was probably meant. */
#include "bind/call/refuse.h"

#include <stdio.h>
#include <string.h>

#include "bind/call/call.h"
#include "bind/call/convert.h"
#include "bind/call/procedure.h"
#include "bind/call/take.h"
#include "bind/objects.h"
#include "bind/print.h"
#include "bind/records.h"
#include "vm/machine/activation.h"
#include "vm/machine/arguments.h"
#include "vm/machine/fail.h"
#include "vm/numbers/dual.h"
#include "vm/numbers/number.h"
#include "vm/values/heap.h"

static const struct { const char *noun, *condition; } contracts[] = {
#define VS_CONTRACT(name, noun, condition, convert) { noun, condition },
#include "bind/call/contracts.def"
#undef VS_CONTRACT
};

const char *vs_contract_noun(uint8_t contract) { return contracts[contract].noun; }
const char *vs_contract_condition(uint8_t contract) { return contracts[contract].condition; }

const char *vs_bind_own_name(const vs_args *f, char room[64]) {
  const char *names = f->names + (*f->names == '%');
  size_t n = strcspn(names, " ");
  if (n > 63) n = 63;
  memcpy(room, names, n);
  room[n] = 0;
  return room;
}

vs_status vs_bind_refuse(vs_args *f, const char *param, const char *expected, vs_value got) {
  VS_ROOTS(f->vm, r, 2);
  r[0] = got;
  if (!vs_cons(f->vm, r[0], VS_NIL, &r[1])) return VS_ERROR;
  return vs_fail_with(f->vm, f->vm->sym.type, r[1], "%s must be %s, got", param, expected);
}

vs_status vs_bind_refuse_hint(vs_args *f, const char *param, const char *expected, vs_value got, const char *hint) {
  char text[256];
  snprintf(text, sizeof text, "%s (%s?)", expected, hint);
  return vs_bind_refuse(f, param, text, got);
}

/* Refuses a procedure that was passed instead of its result, with an error such as "..., got the procedure wall; call
 * it: (wall length)". Returns false, without an error, if v is no procedure. */
bool vs_bind_refuse_uncalled(vs_args *f, const vs_bind_param *p, vs_value v) {
  char form[120];
  if (!vs_is(v, VS_T_CLOSURE) && !vs_is(v, VS_T_NATIVE)) return false;
  const char *call = vs_procedure_form(v, form, sizeof form);
  if (!call)
    return vs_is(v, VS_T_CLOSURE) && !vs_fail(f->vm, f->vm->sym.type,
                                              "%s must be %s, got #<procedure>; call the lambda, or add the missing "
                                              "arguments of the call ((subtract a) lacks an argument)",
                                              p->name, vs_contract_noun(p->contract));
  size_t name = strcspn(call + 1, " )");
  vs_fail(f->vm, f->vm->sym.type, "%s must be %s, got the procedure %.*s; call it: %s", p->name,
      vs_contract_noun(p->contract), (int)name, call + 1, call);
  return true;
}

/* Refuses a value of the wrong kind. If it is a point instead of a gvector, or a gvector instead of a point, the error
 * shows the correct form. */
vs_status vs_bind_refuse_kind(vs_args *f, const vs_bind_param *p, vs_value got) {
  if (vs_is_dual(got))
    return vs_fail(f->vm, f->vm->sym.type,
                   "%s is a number that is being differentiated, and objects accept plain numbers only",
                   p->name);
  bool wants_vector = p->contract == VS_C_VECTOR || p->contract == VS_C_DIRECTION || p->contract == VS_C_PATH,
       wants_point = p->contract == VS_C_POINT;
  if ((wants_vector && vs_is_flat(got, VS_FLAT_POINT)) || (wants_point && vs_is_flat(got, VS_FLAT_VECTOR))) {
    const double *d = vs_as_flat(got)->at;
    char x[32], y[32], z[32], hint[128];
    vs_bind_number_text(x, d[0]), vs_bind_number_text(y, d[1]), vs_bind_number_text(z, d[2]);
    snprintf(hint, sizeof hint, "(%s %s %s %s)", wants_vector ? "vxyz" : "xyz", x, y, z);
    return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
  }
  double d[3];
  int listed = wants_vector || wants_point ? vs_bind_take_numbers(f->vm, got, d) : 0;
  if (listed) {
    char x[32], y[32], z[32], hint[128];
    vs_bind_number_text(x, d[0]), vs_bind_number_text(y, d[1]), vs_bind_number_text(z, d[2]);
    if (listed == 2 && wants_point) snprintf(hint, sizeof hint, "(xy %s %s)", x, y);
    else snprintf(hint, sizeof hint, "(%s %s %s %s)", wants_vector ? "vxyz" : "xyz", x, y, z);
    return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
  }
  if (vs_bind_refuse_uncalled(f, p, got)) return VS_ERROR;
  const vs_bind_param *first = f->procedure->form[0].at;
  if (wants_point && vs_bind_take_number(f->vm, got, d) && (!strcmp(p->name, "apex") || !strcmp(p->name, "c2"))) {
    char number[32], hint[96]; /* a number instead of a point was probably meant as the solid's height: the error
                                * suggests the point */
    vs_bind_number_text(number, d[0]);
    snprintf(hint, sizeof hint, "(+z %s %s)", first->name, number);
    return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
  }
  if (p->contract == VS_C_ANGLE && first->mode != VS_ARG_END && first->contract == VS_C_SECTIONS &&
      vs_bind_take_ref(got).node)
    return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got,
                       "put the sections into one list: (list section ...)");
  vs_arg word; /* suggests a symbol for a string, or a string for a symbol: 'walls for "walls", "top" for 'top */
  if (((p->contract == VS_C_TEXT && vs_is_symbol(got)) || (p->contract == VS_C_NAME && vs_is_string(got))) &&
      vs_convert_text(f, p, got, &word) && word.text.length < 40 &&
      strcspn(word.text.at, " \t\n\"'()") == word.text.length && strcmp(p->name, "sheet") != 0) {
    char hint[64];
    snprintf(hint, sizeof hint, p->contract == VS_C_TEXT ? "\"%s\"" : "'%s", word.text.at);
    return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
  }
  return vs_bind_refuse(f, p->name, vs_contract_noun(p->contract), got);
}
vs_status vs_bind_refuse_condition(vs_args *f, const vs_bind_param *p, vs_value got) {
  return vs_bind_refuse(f, p->name, vs_contract_condition(p->contract), got);
}
