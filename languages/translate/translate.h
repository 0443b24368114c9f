/* Owns `vs translate`: the program as a program in another language. */
#ifndef VS_LANGUAGES_TRANSLATE_TRANSLATE_H
#define VS_LANGUAGES_TRANSLATE_TRANSLATE_H

#include "languages/analysis/analysis.h"

typedef void know_complain(void *context, const know_place *at, const char *text);

/* Is there a language of that name, or of files with the ending of the path? NULL: there is none. Its name else. */
const char *know_language(const char *name, const char *path);
/* The names of all, with blanks between them. */
const char *know_languages(void);
/* The program that was read, in that language, with so many facets a turn and these parameters set; *length bytes,
 * which the caller frees. NULL: what cannot go over has been told to complain, each thing with its place, in the order
 * of the text; or k->trouble says why. */
char *know_translate(knowledge *k, const char *language, unsigned segments, const know_setting *settings,
                     size_t setting_count, know_complain *complain, void *context, size_t *length);

#endif
