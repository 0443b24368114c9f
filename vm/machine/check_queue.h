/* Owns what a waiting check is: one of the program's (check-expect expression value) and the like, until it runs. */
#ifndef VS_VM_MACHINE_CHECK_QUEUE_H
#define VS_VM_MACHINE_CHECK_QUEUE_H

#include "vm/machine/vs.h"

/* A check is a vector of these; the last three are procedures without arguments. */
enum {
  VS_CHECK_FORM,       /* symbol: check-expect, check-within, check-error */
  VS_CHECK_EXPRESSION, /* as it is written */
  VS_CHECK_PLACE,      /* a vs_pos, as a fixnum */
  VS_CHECK_ACTUAL,     /* the expression */
  VS_CHECK_EXPECTED,   /* its value, or the text of its error; #f: not said */
  VS_CHECK_TOLERANCE,  /* #f: none */
  VS_CHECK_WORDS
};

bool vs_checks_wait(const vs_scheme *vm); /* one at least, and none is running */
/* Takes the oldest of the checks that wait, one at least, off the queue. */
vs_value vs_checks_take(vs_scheme *vm);
/* Is a word of the checks, such as check-expect, defined anew at the program's top level? Its name, or NULL. */
const char *vs_checks_redefined(vs_scheme *vm);

#endif
