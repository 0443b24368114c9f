/* Reads C data from values and from parameter objects (take.h). */
#include "bind/call/take.h"

#include <string.h>

#include "vm/machine/fail.h"
#include "vm/numbers/number.h"
#include "vm/values/text.h"

bool vs_bind_take_number(vs_scheme *vm, vs_value v, double *out) {
  if (vs_is_double(v)) *out = vs_double(v);
  else if (vs_is_fixnum(v)) *out = (double)vs_fixnum(v);
  else return vs_is_number(v) && vs_number_double(vm, v, out);
  return true;
}

int vs_bind_take_numbers(vs_scheme *vm, vs_value v, double d[3]) {
  int n = 0;
  d[0] = d[1] = d[2] = 0;
  if (vs_is_vector(v)) {
    const vs_vector *w = vs_as_vector(v);
    while (w->length <= 3 && n < (int)w->length && vs_bind_take_number(vm, w->at[n], &d[n])) n++;
    return w->length == (size_t)n && n >= 2 ? n : 0;
  }
  for (; vs_is_pair(v) && n < 3 && vs_bind_take_number(vm, vs_car(v), &d[n]); v = vs_cdr(v)) n++;
  return v == VS_NIL && n >= 2 ? n : 0;
}

bool vs_bind_take_text(vs_scheme *vm, vs_value v, char **out, size_t *bytes) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok =
      (vs_is_symbol(v) ? vs_text_put(&t, vs_as_symbol(v)->name, vs_as_symbol(v)->length) : vs_text_string(&t, v)) &&
      vs_text_end(&t);
  *bytes = t.count + 1;
  if (ok && !(*out = vs_mem(vm, NULL, 0, *bytes))) ok = vs_fail_memory(vm);
  if (ok) memcpy(*out, t.at, *bytes);
  vs_text_close(&t);
  return ok;
}
