/* Declares the table of the target languages. */
#ifndef VS_LANGUAGES_TARGETS_TARGET_TABLE_H
#define VS_LANGUAGES_TARGETS_TARGET_TABLE_H

#include "languages/translate/target.h"

/* tr_target_named returns the target with this name, tr_target_of_file the target whose suffix the path has. They
 * return NULL if there is none. */
const tr_target *tr_target_named(const char *name);
const tr_target *tr_target_of_file(const char *path);

#endif
