/* Owns a waiting check until it runs: (check-expect expression value) of a program, and the like. */
#ifndef VS_VM_MACHINE_CHECK_QUEUE_H
#define VS_VM_MACHINE_CHECK_QUEUE_H

#include "vm/machine/vs.h"

/* A check is a vector of these; the last three are procedures without arguments. */
enum {
  VS_CHECK_FORM,       /* symbol: check-expect, check-within, check-error */
  VS_CHECK_EXPRESSION, /* the source expression */
  VS_CHECK_PLACE,      /* a vs_pos, as a fixnum */
  VS_CHECK_ACTUAL,     /* returns the value of the expression */
  VS_CHECK_EXPECTED,   /* returns the expected value, or the text of the error; #f: none given */
  VS_CHECK_TOLERANCE,  /* #f: none */
  VS_CHECK_WORDS
};

bool vs_checks_wait(const vs_scheme *vm); /* Returns true if a check waits and none runs. */
/* Removes the oldest waiting check, of at least one, from the queue and returns it. */
vs_value vs_checks_take(vs_scheme *vm);
/* Returns the name of a check form, such as check-expect, that the program has redefined at its top level; NULL:
 * none. */
const char *vs_checks_redefined(vs_scheme *vm);

#endif
