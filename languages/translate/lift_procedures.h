/* Owns which local names become definitions at top level, what those get handed besides. */
#ifndef VS_LANGUAGES_TRANSLATE_LIFT_PROCEDURES_H
#define VS_LANGUAGES_TRANSLATE_LIFT_PROCEDURES_H

#include "languages/translate/core_tree.h"

/* Finds who calls itself, who becomes a module or stands at top level, and the variables that go along. */
bool tr_lift(translation *t);
/* Is the call the next turn of the procedure around it, which becomes a loop in some targets? */
bool tr_turns(const translation *t, tr_index call);
/* The nth variable that the definition gets besides its parameters; 0: no more. */
tr_index tr_besides(const translation *t, tr_index define, uint32_t nth);

#endif
