/* Declares the expansion of a program's own macros: syntax-rules and define-syntax-rule. */
#ifndef VS_LANGUAGES_ANALYSIS_MACRO_RULES_H
#define VS_LANGUAGES_ANALYSIS_MACRO_RULES_H

#include "languages/analysis/name_walk.h"

/* Expands the use of the macro at node, in scope. *out is the new node. Returns false if the macro is not defined by
 * rules, or if no rule matches. */
bool know_macro_expand(know_walk *w, know_index macro, know_index node, know_index scope, know_index *out);

#endif
