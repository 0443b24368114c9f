/* Owns the lowering of definitions and bodies. */
#ifndef VS_LANGUAGES_TRANSLATE_LOWER_DEFINITIONS_H
#define VS_LANGUAGES_TRANSLATE_LOWER_DEFINITIONS_H

#include "languages/translate/lowering.h"

/* The body of a procedure or a let from its form `first` on becomes `into`. */
void tr_lower_body(lowering *l, know_index first, tr_index into);
/* `into` becomes a procedure with parameters from `first` on, the elements of `list`, or with that lone name for
 * all. */
void tr_lower_procedure(lowering *l, tr_index into, know_index list, know_index first, know_index forms);
/* The forms from `first` on become children of `into`, with what `begin` and files bring in among them. */
void tr_lower_sequence(lowering *l, know_index first, tr_index into);
/* Definitions of names that stand for the elements of a list, one each. */
void tr_lower_values(lowering *l, tr_index parent, know_index names, know_index value, know_index source);
/* (define-parameter name default ...), or the script's var name = gui_number(default, ...). */
void tr_lower_parameter(lowering *l, know_index n, tr_index parent);
/* Trouble if the user sets a parameter that the program does not have. */
void tr_lower_settings(lowering *l);

/* Does the symbol name a procedure of several clauses, (define name (case-lambda ...))? Then *variable is the one for
 * so many arguments, 0: there is none. */
bool tr_clause_of(const lowering *l, know_index symbol, uint32_t arguments, tr_index *variable);
/* (for/fold ((name start) ...) (clause ...) body ...): a loop that calls itself. */
void tr_lower_fold(lowering *l, know_index n, tr_index into);

#endif
