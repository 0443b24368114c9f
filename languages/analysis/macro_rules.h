/* Owns what a program's own macros make: syntax-rules and define-syntax-rule. */
#ifndef VS_LANGUAGES_ANALYSIS_MACRO_RULES_H
#define VS_LANGUAGES_ANALYSIS_MACRO_RULES_H

#include "languages/analysis/name_walk.h"

/* Expands the use at node, in scope, of the macro. *out: the new node. False: it is no macro of rules, or none of them
 * fits. */
bool know_macro_expand(know_walk *w, know_index macro, know_index node, know_index scope, know_index *out);

#endif
