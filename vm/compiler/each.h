/* Owns the row of registers for EACH and MORE, which call a procedure with the elements of a list in order and return
 * the result of the row. The window of the call ends the row. Therefore the data for the next call are at fixed places
 * below the activation of the procedure that returns.
 *
 * Results are a list that grows at its end while no continuation can return to the shorter list. After a continuation
 * was made since the start, the list grows at its front, in reverse; no pair of it changes, and the end of the row
 * copies it. */
#ifndef VS_VM_COMPILER_EACH_H
#define VS_VM_COMPILER_EACH_H

#include "vm/values/pairs.h"

enum {
  VS_EACH_PROCEDURE,
  VS_EACH_CAPTURES,     /* the number of continuations at the start; #f: the list of results is reversed */
  VS_EACH_RESULTS,      /* the list of results; unspecific if none are kept */
  VS_EACH_LAST,         /* its last pair, or '(); #f if no results are kept */
  VS_EACH_LIST,         /* the remaining elements */
  VS_EACH_WINDOW
};

/* Keeps the result of a call, row[VS_EACH_WINDOW]. Returns false when memory is out or a limit is reached. */
bool vs_each_keep(vs_scheme *vm, vs_value *row);

/* Ends the row: row[VS_EACH_RESULTS] is its result. Returns false as above. */
bool vs_each_end(vs_scheme *vm, vs_value *row);

/* Takes v, which the procedure of the row below is about to return from the activation at base, for the element of the
 * call. No continuation was made during the call, as it would have moved the row. Returns 0, with no effect, if MORE
 * has to handle it; 1: the activation has the next element; 2: there is none. Allocates only in the nursery, and moves
 * nothing. */
static inline int vs_each_again(vs_scheme *vm, vs_value *base, vs_value v) {
  vs_value *row = base - 2 - VS_EACH_WINDOW, last = row[VS_EACH_LAST], list = row[VS_EACH_LIST];
  if (base[-2] != row[VS_EACH_PROCEDURE] || vm->fuel <= 1) return 0;
  if (last == VS_FALSE) {
    if (vs_is_object(v)) return 0;        /* MORE handles dropped objects */
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

/* A register of the row, relative to the base of the called activation. */
#define VS_EACH_BELOW(base, which) ((base)[(which) - VS_EACH_WINDOW - 2])

#endif
