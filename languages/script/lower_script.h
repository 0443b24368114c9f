/* Owns the lowering of scripts: programs in JavaScript whose functions work out values. */
#ifndef VS_LANGUAGES_SCRIPT_LOWER_SCRIPT_H
#define VS_LANGUAGES_SCRIPT_LOWER_SCRIPT_H

#include "languages/translate/lowering.h"

/* Lowers the statements of the script into `root`, which is a BODY. All that the lowered tree cannot say is complained
 * of. */
void tr_lower_script(lowering *l, know_index first, tr_index root);

#endif
