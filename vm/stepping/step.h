/* Declares stops in the middle of a program: by (break), or between two of its expressions when it is stepped through.
 *
 * A program that stops leaves the run loop. Its state is a continuation in an error object of kind `stop`, with which
 * vs_run returns false. The host may then run other code, and enter the continuation with vs_step_resume (resume.h). No
 * C function waits meanwhile, and a program may stop while another is stopped. */
#ifndef VS_VM_STEPPING_STEP_H
#define VS_VM_STEPPING_STEP_H

#include "vm/machine/native.h"

/* The reason for a stop. BREAK: the program called (break). CALL: the next instruction calls a procedure. VALUE: a call
 * has returned a value. */
typedef enum { VS_STOP_BREAK, VS_STOP_CALL, VS_STOP_VALUE } vs_stop_kind;

/* Indices of the elements of a stop's payload, a vector. */
enum {
  VS_STOP_CONTINUATION,  /* continuation by which the program continues; it is called without values */
  VS_STOP_KIND,          /* reason for the stop, a vs_stop_kind as a fixnum */
  VS_STOP_SUBJECT,       /* CALL: the called procedure; VALUE: the value of the call */
  VS_STOP_ARGUMENTS,     /* CALL: list of the arguments */
  VS_STOP_KEYWORDS,      /* CALL: a KEYWORDS object with the names of the last arguments, or #f */
  VS_STOP_LEVEL,         /* level of the activation (number of stack slots below it) as a fixnum; the levels of its
                          * callers are smaller */
  VS_STOP_TAIL,          /* CALL: whether the call is a tail call */
  VS_STOP_MODE,          /* vs_step_mode of the previous step, as a fixnum; the next element is its target */
  VS_STOP_TARGET,
  VS_STOP_FLAGS,         /* fixnum for the host's own use */
  VS_STOP_WORDS
};

typedef enum { VS_LOOK_GO, VS_LOOK_STOP, VS_LOOK_FAILED } vs_step_verdict;

/* Checks the instruction at pc before the activation at base runs it. Returns STOP with the stop in vm->condition,
 * FAILED if memory is out, or another verdict if the program continues. */
vs_step_verdict vs_step_look(vs_scheme *vm, vs_value *base, const uint32_t *pc);

bool vs_is_stop(const vs_scheme *vm, vs_value condition);

#endif
