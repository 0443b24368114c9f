/* Declares the conversion of the trees of the text to the lowered tree. */
#ifndef VS_LANGUAGES_TRANSLATE_LOWER_FORMS_H
#define VS_LANGUAGES_TRANSLATE_LOWER_FORMS_H

#include "languages/translate/core_tree.h"

/* Lowers the program, with the files that it loads, to t->root. Complains about forms that no target can express.
 * Returns false on failure. */
bool tr_lower(translation *t);
/* Makes the variables of the program's symbols, and a root without children. Returns false on failure. */
bool tr_lower_nothing(translation *t);

#endif
