/* Declares the effect of each form of the language on names. */
#ifndef VS_LANGUAGES_ANALYSIS_BINDING_FORMS_H
#define VS_LANGUAGES_ANALYSIS_BINDING_FORMS_H

#include "languages/analysis/name_walk.h"

/* Walks a defining form in a body: binds its names in scope, and defers its expressions. */
void know_form_declare(know_walk *w, know_index node, know_index scope, uint16_t row);
/* Walks any other form: binds its names and continues with its parts. */
void know_form_walk(know_walk *w, know_index node, know_index scope, uint16_t row);

#endif
