/* Implements the exchange of vectors of numbers with the library's programs (number_vectors.h). */
#include "bind/analysis/number_vectors.h"

#include <math.h>

#include "bind/call/positional.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "vm/machine/fail.h"
#include "vm/values/gc.h"

double *vs_bind_numbers(vs_args *f, int argument, size_t count) {
  vs_scheme *vm = vs_call_vm(f);
  vs_value v = vs_arg_value(f, argument);
  double *at = vs_bind_scratch(f, (count + 1) * sizeof *at);
  if (!at) return NULL;
  bool ok = vs_is_vector(v) && vs_as_vector(v)->length == count;
  for (size_t i = 0; ok && i < count; i++)
    ok = vs_bind_take_number(vm, vs_as_vector(v)->at[i], &at[i]) && isfinite(at[i]);
  if (ok) return at;
  vs_fail(vm, vm->sym.type, "argument %d must be a vector of %zu finite numbers", argument + 1, count);
  return NULL;
}

size_t vs_bind_vector_length(vs_value v) { return vs_is_vector(v) ? vs_as_vector(v)->length : 0; }

bool vs_bind_give_numbers(vs_args *f, const double *at, size_t count, vs_value *out) {
  if (!vs_make_vector(vs_call_vm(f), count, vs_fix(0), out)) return false;
  for (size_t i = 0; i < count; i++) vs_as_vector(*out)->at[i] = vs_flonum(at[i]); /* doubles contain no addresses, so
                                                                                    * no write barrier is needed */
  return true;
}
