/* Owns what each form of the language does with the names in it. */
#ifndef VS_LANGUAGES_ANALYSIS_BINDING_FORMS_H
#define VS_LANGUAGES_ANALYSIS_BINDING_FORMS_H

#include "languages/analysis/name_walk.h"

/* A defining form in a body: its names are bound in scope, and what it evaluates is left for later. */
void know_form_declare(know_walk *w, know_index node, know_index scope, uint16_t row);
/* Any other form: binds and goes on with its parts. */
void know_form_walk(know_walk *w, know_index node, know_index scope, uint16_t row);

#endif
