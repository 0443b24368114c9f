/* Owns the entry into the run loop, and what the host sees of an error. */
#ifndef VS_RUN_H
#define VS_RUN_H

#include "vm/machine/native.h"

/* Calls a procedure from outside and runs until it returns. false: uncaught error, vm->condition is what was raised (a
   CONDITION, or any object). Not for natives: they return VS_CALL. A captured continuation of an earlier vs_run may be
   entered: it then ends the current one. */
bool vs_run(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv, vs_value *out);

/* The instructions of a code object as text, to each until it returns false (dump.c). False: out of memory. */
bool vs_code_dump(vs_scheme *vm, vs_value code, bool (*each)(void *context, const char *line), void *context);

/* Returns the value that a call of the parameter gives now. */
vs_value vs_parameter_value(const vs_scheme *vm, vs_value parameter);

/* The chain of calls now active, innermost first, at most `max`: list of (name . place) pairs; name symbol or #f, place
   a fixnum vs_pos; (#t . 0) before one stands for calls in between that ended with tail calls and left no frames. For
   natives such as `error`; conditions made by vs_fail have it already. */
bool vs_call_chain(vs_scheme *vm, size_t max, vs_value *out);
/* The innermost calls with their variables, for vs_condition.frames (activation.c says how they lie). False: out of
 * memory. */
enum { VS_FRAME_PROCEDURE, VS_FRAME_PLACE, VS_FRAME_VARIABLES, VS_FRAME_WORDS = VS_FRAME_VARIABLES + 2 * 64 };
bool vs_call_variables(vs_scheme *vm, vs_value *out);
/* The chain without allocating, names and places apart: how many were written. */
size_t vs_call_links(vs_scheme *vm, vs_value *name, vs_pos *place, size_t max);
/* The places alone, without allocating: how many were written. */
size_t vs_call_places(vs_scheme *vm, vs_pos *place, size_t max);
/* A hash of where those calls are, for less than the places cost; the same chain has the same until vm->collections
   changes. */
uint64_t vs_call_key(vs_scheme *vm, size_t max);
/* Place of the call that the running native was made from. */
vs_pos vs_call_place(vs_scheme *vm);

#endif
