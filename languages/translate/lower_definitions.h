/* Declares the lowering of definitions and bodies: their conversion to the lowered tree (core_tree.h). */
#ifndef VS_LANGUAGES_TRANSLATE_LOWER_DEFINITIONS_H
#define VS_LANGUAGES_TRANSLATE_LOWER_DEFINITIONS_H

#include "languages/translate/lowering.h"

/* Lowers the body of a procedure or a let, from its form `first` on, to the node `into`. */
void tr_lower_body(lowering *l, know_index first, tr_index into);
/* Lowers a procedure to the node `into`. Its parameters are the elements of `list` from `first` on, or a single name
 * for all arguments. */
void tr_lower_procedure(lowering *l, tr_index into, know_index list, know_index first, know_index forms);
/* Lowers the forms from `first` on to children of `into`, including the forms inside `begin` and in loaded files. */
void tr_lower_sequence(lowering *l, know_index first, tr_index into);
/* Lowers a definition of several names by one value: each name gets an element of a list. */
void tr_lower_values(lowering *l, tr_index parent, know_index names, know_index value, know_index source);
/* Lowers a parameter of the model: (define-parameter name default ...), or in a script var name = gui_number(default,
 * ...). */
void tr_lower_parameter(lowering *l, know_index n, tr_index parent);
/* Sets k->trouble if the user sets a parameter that the program does not have. */
void tr_lower_settings(lowering *l);

/* Returns true if the symbol names a procedure of several clauses, (define name (case-lambda ...)). *variable is the
 * variable of the clause that accepts this number of arguments, or 0 if none does. */
bool tr_clause_of(const lowering *l, know_index symbol, uint32_t arguments, tr_index *variable);
/* Lowers (for/fold ((name start) ...) (clause ...) body ...) to a procedure that calls itself. */
void tr_lower_fold(lowering *l, know_index n, tr_index into);

#endif
