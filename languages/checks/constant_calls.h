/* Declares the check of calls with constant arguments, implemented in constant_calls.c. */
#ifndef VS_LANGUAGES_CHECKS_CONSTANT_CALLS_H
#define VS_LANGUAGES_CHECKS_CONSTANT_CALLS_H

#include "languages/checks/checks.h"

/* An expression as text for the interpreter, while it is written. failed: whether the expression is not constant, or is
 * too long. */
typedef struct { char *at; size_t count, room; bool failed; int depth; } know_expression;

void know_put(know_expression *t, const char *s, size_t n); /* appends the text and a blank */
/* Writes the expression as text, with the values of its variables in place of their names. Sets t->failed if the
 * expression is not constant. */
void know_put_constant(const knowledge *k, know_index node, know_expression *t);
/* Evaluates the expression, and returns the interpreter's first error or, without errors, its first warning; "" if
 * there is none. The expression has the node's column. Its line differs for each evaluation, since a warning is given
 * once for each place. Its value does not become a value of the program. */
const char *know_objection(knowledge *k, know_index node, const char *expression, size_t length);
bool know_guarded(const knowledge *k, know_index node); /* returns true if the node is inside a guard, which expects
                                                         * errors, so that they are no findings */

/* Checks a call of a procedure of plain_calls.def (whose result depends only on its arguments) with constant arguments.
 * wrong: a byte for each node, set for calls with an error. Returns false if the call or one of its arguments has an
 * error. */
bool know_check_constants(know_findings *f, know_index node, uint8_t *wrong);
/* Checks a call in which the value of one argument is unknown. Values of all kinds are tried for this argument. An
 * error is a finding if each of them leads to an error. wrong: as in know_check_constants. */
void know_check_with_unknown(know_findings *f, know_index node, uint8_t *wrong);

#endif
