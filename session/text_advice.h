/* Declares advice that text_advice.c computes from the program's text around the place of an error. */
#ifndef VS_SESSION_TEXT_ADVICE_H
#define VS_SESSION_TEXT_ADVICE_H

#include "session/session.h"

/* A place in a source text. start, end: beginning and end of the text; at: the place; first_line: line number of the
 * text's beginning. */
typedef struct { const char *start, *at, *end; uint32_t first_line; } vs_text_place;

/* ---- advice: each function appends to the error's text t or replaces it, and returns false when memory is out ---- */

/* Advises if the name of the called value is a parameter or a variable that hides a procedure of the language. Replaces
 * t. */
bool vs_text_advise_hidden(vs_text_place p, vs_text *t);
/* Advises if an operand of the call at p is the parameter x of (lambda x ...), which is a list of all arguments. */
bool vs_text_advise_rest(vs_text_place p, vs_text *t);
/* Advises if the word is an element of a quoted list in the call at p, where the value of the word was meant. */
bool vs_text_advise_quoted(vs_text_place p, const char *word, vs_text *t);
/* Advises if the word at p is an operator after its first operand, as in (3 ** 2). Replaces t. */
bool vs_text_advise_operator(vs_text_place p, vs_text *t);
/* Advises if the call at p is a chain of comparisons such as (< 1 x < 3). */
bool vs_text_advise_chain(vs_text_place p, vs_text *t);
/* Advises if the call at p uses the result of (assq key table), which is #f because the table does not contain the key.
 * Lists the keys that the table contains. */
bool vs_text_advise_missing_key(vs_scheme *vm, vs_text_place p, vs_text *t);
/* Advises if the statement around p is one of another language, as its first word shows. */
bool vs_text_advise_statement(vs_scheme *vm, vs_text_place p, vs_text *t);
/* Advises if an operand of the call at p has no value, such as an `if` without else, a loop or a definition. Also
 * examines the body of a procedure that the call applies to each element of a list. */
bool vs_text_advise_valueless(vs_text_place p, vs_text *t);

#endif
