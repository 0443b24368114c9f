/* Owns the row of registers that EACH and MORE work on: a procedure called with one element of a list after the other.
 * The result of the row is returned. The window of the call ends it, so that what is needed for the next call lies at
 * fixed places below the activation of the procedure that returns.
 *
 * Results are kept as a list that grows at its end, while nobody can come back to where it was shorter. Once a
 * continuation was made since the start somebody can: from then on it grows at its front, turned round, no pair of it
 * is changed, and the end of the row copies it. */
#ifndef VS_VM_COMPILER_EACH_H
#define VS_VM_COMPILER_EACH_H

#include "vm/values/pairs.h"

enum {
  VS_EACH_PROCEDURE,
  VS_EACH_CAPTURES,     /* how many continuations there were at the start; #f: the list of results is turned round */
  VS_EACH_RESULTS,      /* the list of results; unspecific where none are kept */
  VS_EACH_LAST,         /* its last pair, or '(); #f where no results are kept */
  VS_EACH_LIST,         /* the elements still to come */
  VS_EACH_WINDOW
};

/* Keeps what a call gave, row[VS_EACH_WINDOW]. False: out of memory, or a limit is reached. */
bool vs_each_keep(vs_scheme *vm, vs_value *row);

/* Ends the row: row[VS_EACH_RESULTS] is what all of it gives. False as above. */
bool vs_each_end(vs_scheme *vm, vs_value *row);

/* The procedure of the row below is about to return v from the activation at base, and the element for which it was
 * called is done; nobody has made a continuation meanwhile, as that would have moved the row. Returns 0, with nothing
 * done, where MORE has to see to it; 1: the activation has the next element; 2: there is none. Nothing is allocated but
 * from the nursery, and nothing moves. */
static inline int vs_each_again(vs_scheme *vm, vs_value *base, vs_value v) {
  vs_value *row = base - 2 - VS_EACH_WINDOW, last = row[VS_EACH_LAST], list = row[VS_EACH_LIST];
  if (base[-2] != row[VS_EACH_PROCEDURE] || vm->fuel <= 1) return 0;
  if (last == VS_FALSE) {
    if (vs_is_object(v)) return 0;        /* MORE looks at objects that nobody takes */
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

/* A register of the row, seen from the base of the called activation. */
#define VS_EACH_BELOW(base, which) ((base)[(which) - VS_EACH_WINDOW - 2])

#endif
