/* Declares the table of the target languages. */
#ifndef VS_LANGUAGES_TARGETS_TARGET_TABLE_H
#define VS_LANGUAGES_TARGETS_TARGET_TABLE_H

#include "languages/translate/target.h"

/* Return the target with this name, or with the suffix of this path. Return NULL if there is none. */
const tr_target *tr_target_named(const char *name);
const tr_target *tr_target_of_file(const char *path);

#endif
