/* Owns the way from the text's trees to the lowered tree. */
#ifndef VS_LANGUAGES_TRANSLATE_LOWER_FORMS_H
#define VS_LANGUAGES_TRANSLATE_LOWER_FORMS_H

#include "languages/translate/core_tree.h"

/* Lowers the program, what it loads included, into t->root. A form that no target has is complained of. False:
 * trouble. */
bool tr_lower(translation *t);
/* Makes the variables of the program's symbols and a root without children. False: trouble. */
bool tr_lower_nothing(translation *t);

#endif
