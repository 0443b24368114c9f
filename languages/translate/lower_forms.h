/* Declares the conversion of the trees of the program's text to the lowered tree (core_tree.h). */
#ifndef VS_LANGUAGES_TRANSLATE_LOWER_FORMS_H
#define VS_LANGUAGES_TRANSLATE_LOWER_FORMS_H

#include "languages/translate/core_tree.h"

/* Lowers the program, with the files that it loads, to the node t->root. Complains about forms that no target can
 * express. Returns false on failure. */
bool tr_lower(translation *t);
/* Makes the variables of the program's symbols, and a root node without children. Returns false on failure. */
bool tr_lower_nothing(translation *t);

#endif
