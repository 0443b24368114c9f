/* Declares the queue of waiting checks: (check-expect expression value) of a program, and similar forms. */
#ifndef VS_VM_MACHINE_CHECK_QUEUE_H
#define VS_VM_MACHINE_CHECK_QUEUE_H

#include "vm/machine/vs.h"

/* Indices in a check, which is a vector. The last three elements are procedures without arguments. */
enum {
  VS_CHECK_FORM,       /* symbol: check-expect, check-within or check-error */
  VS_CHECK_EXPRESSION, /* expression in the source text */
  VS_CHECK_PLACE,      /* place of the check in the source, a vs_pos as a fixnum */
  VS_CHECK_ACTUAL,     /* procedure that returns the value of the expression */
  VS_CHECK_EXPECTED,   /* procedure that returns the expected value or, for check-error, the text of the error; #f if
                        * none is given */
  VS_CHECK_TOLERANCE,  /* procedure that returns the tolerance, or #f */
  VS_CHECK_WORDS
};

bool vs_checks_wait(const vs_scheme *vm); /* Returns true if the queue has a check and no check is running. */
/* Removes the oldest check from the queue, which is not empty, and returns it. */
vs_value vs_checks_take(vs_scheme *vm);
/* Returns the name of a check form, such as check-expect, that the program has redefined at its top level, or NULL. */
const char *vs_checks_redefined(vs_scheme *vm);

#endif
