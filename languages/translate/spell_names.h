/* Declares the choice of names for the program's variables in the target: valid words, each with a single meaning in
 * its scope. */
#ifndef VS_LANGUAGES_TRANSLATE_SPELL_NAMES_H
#define VS_LANGUAGES_TRANSLATE_SPELL_NAMES_H

#include "languages/translate/core_tree.h"

/* Chooses a name for every variable. Names at top level differ from each other. A local name differs from the names at
 * top level, and from all names that are visible at its binding. Returns false on failure. */
bool tr_spell_names(translation *t);

#endif
