/* Declares the checks of calls: the number and types of arguments, and the language's own errors for calls with
 * constants. */
#ifndef VS_LANGUAGES_CHECKS_ARGUMENT_CHECKS_H
#define VS_LANGUAGES_CHECKS_ARGUMENT_CHECKS_H

#include "languages/checks/checks.h"

typedef enum {
  KNOW_TYPE_UNKNOWN, KNOW_TYPE_NUMBER, KNOW_TYPE_STRING, KNOW_TYPE_BOOLEAN, KNOW_TYPE_CHARACTER, KNOW_TYPE_SYMBOL,
      KNOW_TYPE_LIST,
  KNOW_TYPE_VECTOR, KNOW_TYPE_PROCEDURE, KNOW_TYPE_POINT, KNOW_TYPE_GVECTOR, KNOW_TYPE_OBJECT,
  KNOW_TYPE_NOTHING /* type of an expression without a value, such as a loop or a call of display */
} know_type;

/* Returns the type of an expression's value, as far as its text determines the type. */
know_type know_type_of(const knowledge *k, know_index node);
const char *know_type_word(know_type type); /* returns the type as words for a message, such as "a number" */
/* Returns the row of plain_calls.def for the symbol, or -1 if the table has none. The table contains procedures whose
 * result depends only on their arguments. */
int know_plain_row(const knowledge *k, know_index symbol);
know_type know_plain_type(int row); /* returns the type of the result of the procedure in this row of plain_calls.def */
/* Returns the node of the value of a variable that is defined once and never set, or 0 if its value is not known. */
know_index know_constant_value(const knowledge *k, know_index node);
void know_check_calls(know_findings *f);

#endif
