/* Declares the effect of each form of the language on names. */
#ifndef VS_LANGUAGES_ANALYSIS_BINDING_FORMS_H
#define VS_LANGUAGES_ANALYSIS_BINDING_FORMS_H

#include "languages/analysis/name_walk.h"

/* Walks a form in a body that defines names: binds the names in the scope, and adds the form's expressions as later
 * tasks. row: the form's row of binding_forms.def. */
void know_form_declare(know_walk *w, know_index node, know_index scope, uint16_t row);
/* Walks a form that defines no names in its scope: binds its local names and continues with its parts. row: the form's
 * row of binding_forms.def. */
void know_form_walk(know_walk *w, know_index node, know_index scope, uint16_t row);

#endif
