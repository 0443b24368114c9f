/* Declares the queries about the rows of binding_forms.def, the table of the language's forms. */
#ifndef VS_LANGUAGES_ANALYSIS_FORM_TABLE_H
#define VS_LANGUAGES_ANALYSIS_FORM_TABLE_H

#include <stdbool.h>
#include <stdint.h>

/* Returns 1 + the row of binding_forms.def for the language's form with this name, or 0 if there is none. */
uint16_t know_form_row(const char *name);
/* Returns true if the form of this row defines names in its scope, or is part of the program's structure. The walk of a
 * body must find such forms first. */
bool know_form_defines(uint16_t row);
bool know_form_splices(uint16_t row); /* returns true for begin, whose parts belong to the scope around it */

#endif
