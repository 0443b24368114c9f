/* Owns what the program's names are called in the target: words that it takes, each meaning one thing where it
 * stands. */
#ifndef VS_LANGUAGES_TRANSLATE_SPELL_NAMES_H
#define VS_LANGUAGES_TRANSLATE_SPELL_NAMES_H

#include "languages/translate/core_tree.h"

/* Names every variable. Names at top level differ from each other; a local one differs from those and from all that are
 * in sight where it is bound. False: trouble. */
bool tr_spell_names(translation *t);

#endif
