/* Declares the choice of local names that become definitions at top level, and of their additional arguments. */
#ifndef VS_LANGUAGES_TRANSLATE_LIFT_PROCEDURES_H
#define VS_LANGUAGES_TRANSLATE_LIFT_PROCEDURES_H

#include "languages/translate/core_tree.h"

/* Finds the recursive procedures, the definitions that become modules or move to top level, and the variables that
 * calls must pass to these. */
bool tr_lift(translation *t);
/* Returns true if the call begins the next iteration of the surrounding procedure, which becomes a loop in some
 * targets. */
bool tr_turns(const translation *t, tr_index call);
/* Returns the nth variable that calls pass to the definition in addition to its arguments, or 0 if there are no
 * more. */
tr_index tr_besides(const translation *t, tr_index define, uint32_t nth);

#endif
