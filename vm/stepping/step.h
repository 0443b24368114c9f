/* Owns stops in the middle of a program: by (break), or between two of its expressions while it is stepped through.
 *
 * A program that stops leaves the run loop. Its whole state is a continuation, in a condition of the kind `stop`;
 * vs_run returns false with that condition. The host may then run other code, and enter the continuation again with
 * vs_step_resume (resume.h). No C function waits while a user thinks, and a program may stop while another is
 * stopped. */
#ifndef VS_VM_STEPPING_STEP_H
#define VS_VM_STEPPING_STEP_H

#include "vm/machine/native.h"

/* The reason of a stop. BREAK: the program called (break). CALL: the program will call a procedure next. VALUE: a call
 * has returned a value. */
typedef enum { VS_STOP_BREAK, VS_STOP_CALL, VS_STOP_VALUE } vs_stop_kind;

/* The payload of the condition is a vector of these. */
enum {
  VS_STOP_CONTINUATION,  /* the rest of the program; takes no value */
  VS_STOP_KIND,          /* a vs_stop_kind as a fixnum */
  VS_STOP_SUBJECT,       /* CALL: the procedure; VALUE: the value */
  VS_STOP_ARGUMENTS,     /* CALL: a list of its arguments */
  VS_STOP_KEYWORDS,      /* CALL: a KEYWORDS object with the names of the last arguments, or #f */
  VS_STOP_LEVEL,         /* the activation's level as a fixnum: those of its callers are smaller */
  VS_STOP_TAIL,          /* CALL: it is a tail call */
  VS_STOP_MODE,          /* the previous stepping, a vs_step_mode as a fixnum, and its target: */
  VS_STOP_TARGET,
  VS_STOP_FLAGS,         /* for the host's own use */
  VS_STOP_WORDS
};

typedef enum { VS_LOOK_GO, VS_LOOK_STOP, VS_LOOK_FAILED } vs_step_verdict;

/* Checks the instruction at pc of the activation at base before it runs. STOP: vm->condition is the stop. FAILED:
 * memory is out. */
vs_step_verdict vs_step_look(vs_scheme *vm, vs_value *base, const uint32_t *pc);

bool vs_is_stop(const vs_scheme *vm, vs_value condition);

#endif
