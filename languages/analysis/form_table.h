/* Owns the rows of binding_forms.def as others ask for them. */
#ifndef VS_LANGUAGES_ANALYSIS_FORM_TABLE_H
#define VS_LANGUAGES_ANALYSIS_FORM_TABLE_H

#include <stdbool.h>
#include <stdint.h>

/* 1 + the row of the language's form of that name; 0: there is none. */
uint16_t know_form_row(const char *name);
/* Does the form define names where it stands, or structure the program: is it for bodies to look at first? */
bool know_form_defines(uint16_t row);
bool know_form_splices(uint16_t row); /* begin: its parts stand where it stands */

#endif
