/* Owns the target languages. */
#ifndef VS_LANGUAGES_TARGETS_TARGET_TABLE_H
#define VS_LANGUAGES_TARGETS_TARGET_TABLE_H

#include "languages/translate/target.h"

/* NULL: there is none of that name, or ending. */
const tr_target *tr_target_named(const char *name);
const tr_target *tr_target_of_file(const char *path);

#endif
