/* Declares the check of calls with constant arguments, implemented in constant_calls.c. */
#ifndef VS_LANGUAGES_CHECKS_CONSTANT_CALLS_H
#define VS_LANGUAGES_CHECKS_CONSTANT_CALLS_H

#include "languages/checks/checks.h"

/* An expression as text for the interpreter. failed: whether it is not constant, or is too long. */
typedef struct { char *at; size_t count, room; bool failed; int depth; } know_expression;

void know_put(know_expression *t, const char *s, size_t n); /* appends the text and a blank */
/* Writes the expression with the values of its variables. Sets t->failed if the expression is not constant. */
void know_put_constant(const knowledge *k, know_index node, know_expression *t);
/* Returns the interpreter's first error in the expression or, without errors, its first warning; "" if there is none.
 * The expression is evaluated at the node's column. Its line differs for each trial, since a warning is given once for
 * each place. Its value does not become a value of the program. */
const char *know_objection(knowledge *k, know_index node, const char *expression, size_t length);
bool know_guarded(const knowledge *k, know_index node); /* returns true if the node is within a guard, which expects
                                                         * errors */

/* Checks a call of a procedure of plain_calls.def whose arguments are constants. wrong: a byte for each node, set for
 * calls with an error. Returns false if the call or one of its arguments has an error. */
bool know_check_constants(know_findings *f, know_index node, uint8_t *wrong);
/* Checks a call as know_check_constants does, if one of its arguments is not known. An error is a finding if each value
 * tried for this argument leads to an error. */
void know_check_with_unknown(know_findings *f, know_index node, uint8_t *wrong);

#endif
