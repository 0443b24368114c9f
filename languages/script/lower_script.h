/* Declares the lowering of scripts (programs in JavaScript) to the lowered tree. The functions of the script must
 * compute values. */
#ifndef VS_LANGUAGES_SCRIPT_LOWER_SCRIPT_H
#define VS_LANGUAGES_SCRIPT_LOWER_SCRIPT_H

#include "languages/translate/lowering.h"

/* Lowers the statements of the script to `root`, which is a BODY. Complains about each part that the lowered tree
 * cannot express. */
void tr_lower_script(lowering *l, know_index first, tr_index root);

#endif
