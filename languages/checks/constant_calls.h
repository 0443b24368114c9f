/* Declares the functions of constant_calls.c. */
#ifndef VS_LANGUAGES_CHECKS_CONSTANT_CALLS_H
#define VS_LANGUAGES_CHECKS_CONSTANT_CALLS_H

#include "languages/checks/checks.h"

/* An expression as a text for the interpreter; failed: it is not constant, or too long. */
typedef struct { char *at; size_t count, room; bool failed; int depth; } know_expression;

void know_put(know_expression *t, const char *s, size_t n); /* with a blank behind it */
/* Writes the expression with the values of its variables; failed: it is not constant. */
void know_put_constant(const knowledge *k, know_index node, know_expression *t);
/* Returns the interpreter's first error of the expression, or its first warning; "": none. The expression has the
 * column of the node, and a line of its own: a warning is given once for each place. Its value is no value of the
 * program. */
const char *know_objection(knowledge *k, know_index node, const char *expression, size_t length);
bool know_guarded(const knowledge *k, know_index node); /* within a guard, which expects the error */

/* Checks a call of a procedure of plain_calls.def whose arguments are constants. wrong: a byte for each node, set for
 * calls with an error. Returns false if the call or one of its arguments has an error. */
bool know_check_constants(know_findings *f, know_index node, uint8_t *wrong);
/* The same for a call with one argument that is not known: an error is a finding if each value of that argument has
 * one. */
void know_check_with_unknown(know_findings *f, know_index node, uint8_t *wrong);

#endif
