/* Declares the registers of the instructions EACH and MORE, which call a procedure with each element of a list and
 * return the results. These consecutive registers are called the row. The row ends with the registers of the calls: the
 * procedure and its arguments. The data for the next call are therefore at fixed positions below the activation of the
 * called procedure.
 *
 * The results are a list. New results are appended at its end as long as no continuation can return to an earlier,
 * shorter state of the list. Once a continuation was created, new results are put at the front, in reverse order. The
 * list's pairs are then never changed, and at the end a copy in the right order is made. */
#ifndef VS_VM_COMPILER_EACH_H
#define VS_VM_COMPILER_EACH_H

#include "vm/values/pairs.h"

enum {
  VS_EACH_PROCEDURE,
  VS_EACH_CAPTURES,     /* number of continuations that existed before the first call; #f: the list of results is in
                         * reverse order */
  VS_EACH_RESULTS,      /* list of results, or the unspecific value if results are not kept */
  VS_EACH_LAST,         /* last pair of the results, or '(); #f if results are not kept */
  VS_EACH_LIST,         /* list of the elements for which the procedure was not yet called */
  VS_EACH_WINDOW
};

/* Adds the result of a call, row[VS_EACH_WINDOW], to the list row[VS_EACH_RESULTS]. Returns false when memory is out or
 * a limit is reached. */
bool vs_each_keep(vs_scheme *vm, vs_value *row);

/* Completes the list of results in row[VS_EACH_RESULTS]; row: the registers of an instruction EACH. Returns false when
 * memory is out or a limit is reached. */
bool vs_each_end(vs_scheme *vm, vs_value *row);

/* Called when a procedure that EACH has called is about to return v. Adds v to the results and prepares the next call.
 * Returns 1 if the list has a next element, 2 if it has none, 0 if the instruction MORE must do this instead. */
static inline int vs_each_again(vs_scheme *vm, vs_value *base, vs_value v) {
  vs_value *row = base - 2 - VS_EACH_WINDOW, last = row[VS_EACH_LAST], list = row[VS_EACH_LIST];
  if (base[-2] != row[VS_EACH_PROCEDURE] || vm->fuel <= 1) return 0;
  if (last == VS_FALSE) {
    if (vs_is_object(v)) return 0;        /* the instruction MORE must report the unused value of the call */
  } else {
    if (vs_is(v, VS_T_VALUES) || vm->end - vm->free < (ptrdiff_t)sizeof(vs_pair)) return 0;
    if (last != VS_NIL && !vs_gc_is_young(vm, vs_as_pair(last))) return 0;
    vs_pair *p = (vs_pair *)(void *)vm->free;
    vm->free += sizeof *p;
    p->h = (vs_object){VS_T_PAIR, 0, 0, VS_WORDS(vs_pair)};
    p->car = v; p->cdr = VS_NIL;
    row[VS_EACH_LAST] = vs_from_object(p);
    if (last == VS_NIL) row[VS_EACH_RESULTS] = row[VS_EACH_LAST];
    else vs_as_pair(last)->cdr = row[VS_EACH_LAST];
  }
  if (!vs_is_pair(list)) return 2;
  base[0] = vs_car(list);
  row[VS_EACH_LIST] = vs_cdr(list);
  vm->fuel--;
  return 1;
}

/* Register `which` of the consecutive registers of the instruction EACH. base: the activation of the procedure that
 * EACH has called. */
#define VS_EACH_BELOW(base, which) ((base)[(which) - VS_EACH_WINDOW - 2])

#endif
