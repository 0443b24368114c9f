/* Declares the count of the rules that the last run of a model has broken. */
#ifndef VS_CLI_CURE_BROKEN_RULES_H
#define VS_CLI_CURE_BROKEN_RULES_H

#include "visualscheme.h"

/* The rules that a run has broken. shortfall: the sum of their shortfalls. */
typedef struct { size_t count; double shortfall; } cli_broken_rules;

cli_broken_rules cli_rules_broken(const vs_scheme *scheme);

/* Returns VS_OUTCOME_MODEL, after a message, if the last run has broken a rule; otherwise VS_OUTCOME_DONE. */
vs_outcome cli_rules_hold(const vs_scheme *scheme);

#endif
