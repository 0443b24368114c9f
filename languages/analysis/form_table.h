/* Owns the queries about rows of binding_forms.def. */
#ifndef VS_LANGUAGES_ANALYSIS_FORM_TABLE_H
#define VS_LANGUAGES_ANALYSIS_FORM_TABLE_H

#include <stdbool.h>
#include <stdint.h>

/* Returns 1 + the row of the language's form of that name; 0: none. */
uint16_t know_form_row(const char *name);
/* Returns true if the form defines names in its scope, or structures the program, so that a body must see it first. */
bool know_form_defines(uint16_t row);
bool know_form_splices(uint16_t row); /* begin: its parts belong to the scope around it */

#endif
