/* Declares the choice of local names that become definitions at top level, and of their additional arguments. */
#ifndef VS_LANGUAGES_TRANSLATE_LIFT_PROCEDURES_H
#define VS_LANGUAGES_TRANSLATE_LIFT_PROCEDURES_H

#include "languages/translate/core_tree.h"

/* Finds the recursive procedures, the modules and top-level definitions, and the variables that calls pass. */
bool tr_lift(translation *t);
/* Returns true if the call is the next turn of the procedure around it, which becomes a loop in some targets. */
bool tr_turns(const translation *t, tr_index call);
/* Returns the nth additional variable of the definition, or 0 if there are no more. */
tr_index tr_besides(const translation *t, tr_index define, uint32_t nth);

#endif
