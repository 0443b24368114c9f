/* Owns the target languages. */
#ifndef VS_LANGUAGES_TARGETS_TARGET_TABLE_H
#define VS_LANGUAGES_TARGETS_TARGET_TABLE_H

#include "languages/translate/target.h"

/* Returns the target with that name or ending; NULL: none. */
const tr_target *tr_target_named(const char *name);
const tr_target *tr_target_of_file(const char *path);

#endif
