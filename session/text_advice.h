/* Declares the functions of text_advice.c: advice that the program's own text gives. */
#ifndef VS_SESSION_TEXT_ADVICE_H
#define VS_SESSION_TEXT_ADVICE_H

#include "session/session.h"

/* A place in a source: `at` lies in the text from `start` to `end`. */
typedef struct { const char *start, *at, *end; uint32_t first_line; } vs_text_place;

/* Each of these writes to t, the error's text, and returns false when memory is out. Without advice t stays as it
 * is. */

/* The called name is a parameter or a variable that hides a procedure of the language: replaces t. */
bool vs_text_advise_hidden(vs_text_place p, vs_text *t);
/* An operand of the call at p is x of (lambda x ...), the list of all arguments. */
bool vs_text_advise_rest(vs_text_place p, vs_text *t);
/* The word is an element of a quoted list of the call at p, where its value was meant. */
bool vs_text_advise_quoted(vs_text_place p, const char *word, vs_text *t);
/* The word at p is an operator behind its first operand, (3 ** 2): replaces t. */
bool vs_text_advise_operator(vs_text_place p, vs_text *t);
/* The call at p is (< 1 x < 3). */
bool vs_text_advise_chain(vs_text_place p, vs_text *t);
/* The call at p takes a part of (assq key table), which is #f: names the keys of the table. */
bool vs_text_advise_missing_key(vs_scheme *vm, vs_text_place p, vs_text *t);
/* The statement around p is of another language: its first word gives the advice. */
bool vs_text_advise_statement(vs_scheme *vm, vs_text_place p, vs_text *t);
/* A part of the call at p gives no value: an if without else, a loop, a definition; also within a procedure that is
 * mapped. */
bool vs_text_advise_valueless(vs_text_place p, vs_text *t);

#endif
