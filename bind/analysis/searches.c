/* Implements the natives of optimise, which library/visualscheme/analysis/ calls. A search asks for values of
 * functions; the program in the library computes and returns them. */
#include "geometry/search/optimiser.h"

#include <math.h>

#include "bind/analysis/number_vectors.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/scratch.h"
#include "vm/machine/fail.h"
#include "vm/values/gc.h"

static void release_search(void *s) { vs_search_free(s); }
static const vs_foreign_type search_type = { .name = "a search", .release = release_search };

/* (%search-new method start low high limits): begins a search at the vector `start`. limits: number of constraints,
 * greatest number of evaluations, tolerance. method is an index of vs_search_method. An element of low or high beyond
 * 1e300 means no bound. */
vs_status vs_p_search_new(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  size_t n = vs_bind_vector_length(vs_arg_value(f, 1));
  double *start = vs_bind_numbers(f, 1, n), *low = start ? vs_bind_numbers(f, 2, n) : NULL,
         *high = low ? vs_bind_numbers(f, 3, n) : NULL, *limits = high ? vs_bind_numbers(f, 4, 3) : NULL;
  if (!limits) return VS_ERROR;
  bool ok = n > 0 && n < 10000 && vs_arg_integer(f, 0) <= VS_SEARCH_ISRES && limits[0] >= 0 && limits[1] >= 1 &&
            limits[1] <= 1e9 && limits[2] > 0;
  for (size_t i = 0; ok && i < n; i++) {
    if (low[i] < -1e300) low[i] = -INFINITY;
    if (high[i] > 1e300) high[i] = INFINITY;
    ok = low[i] <= start[i] && start[i] <= high[i];
  }
  if (!ok) return vs_fail(vm, vm->sym.range, "the numbers of a search do not fit");
  vs_error e = { 0 };
  vs_search *s = vs_search_new(&(vs_search_problem){ (vs_search_method)vs_arg_integer(f, 0), n, start, low, high,
                                                     (size_t)limits[0], (size_t)limits[1], limits[2] }, &e);
  return s ? (vs_make_foreign(vm, &search_type, s, 0, out) ? VS_OK : VS_ERROR) : vs_bind_error(vm, &e);
}

/* Returns the search in argument 0. If the argument is no search, sets the error and returns NULL. */
static vs_search *search_of(vs_args *f) {
  vs_scheme *vm = vs_call_vm(f);
  vs_search *s = vs_foreign_get(vs_arg_value(f, 0), &search_type);
  if (!s) vs_fail(vm, vm->sym.type, "a search is expected");
  return s;
}

/* (%search-next search): returns a list of three values. If the search asks for a value: the index of the function,
 * whether its derivatives are needed, and the vector of the unknowns. At the end: the search's final state as a
 * negative number, the best value, and the best unknowns. */
vs_status vs_p_search_next(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_search *s = search_of(f);
  if (!s) return VS_ERROR;
  vs_search_question q;
  vs_search_state state = vs_search_next(s, &q);
  VS_ROOTS(vm, r, 2);
  bool asks = state == VS_SEARCH_ASKS;
  bool ok = vs_bind_give_numbers(f, q.x, q.count, &r[0]) && vs_cons(vm, r[0], VS_NIL, &r[1]) &&
            vs_cons(vm, asks ? (q.slopes ? VS_TRUE : VS_FALSE) : vs_flonum(q.value), r[1], &r[1]) &&
            vs_cons(vm, vs_fix(asks ? (int64_t)q.which : -(int64_t)state), r[1], out);
  return ok ? VS_OK : VS_ERROR;
}

/* (%search-answer search value slopes): passes a function's value to the search. slopes: vector of the derivatives,
 * empty if they are not needed. */
vs_status vs_p_search_answer(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_search *s = search_of(f);
  size_t count = vs_bind_vector_length(vs_arg_value(f, 2));
  const double *slopes = s ? vs_bind_numbers(f, 2, count) : NULL;
  if (!slopes) return VS_ERROR;
  if (!vs_search_answer(s, vs_arg_real(f, 1), slopes, count))
    return vs_fail(vm, vm->sym.range, "the search has not asked for that");
  *out = VS_UNSPECIFIC;
  return VS_OK;
}
