/* Owns the expansions of a program's own macros: syntax-rules and define-syntax-rule. */
#ifndef VS_LANGUAGES_ANALYSIS_MACRO_RULES_H
#define VS_LANGUAGES_ANALYSIS_MACRO_RULES_H

#include "languages/analysis/name_walk.h"

/* Expands the use at node, in scope, of the macro. *out: the new node. Returns false if it is not a macro of rules, or
 * if no rule fits. */
bool know_macro_expand(know_walk *w, know_index macro, know_index node, know_index scope, know_index *out);

#endif
