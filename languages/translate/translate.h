/* Declares `vs translate`, which translates a program to another language. */
#ifndef VS_LANGUAGES_TRANSLATE_TRANSLATE_H
#define VS_LANGUAGES_TRANSLATE_TRANSLATE_H

#include "languages/analysis/analysis.h"

typedef void know_complain(void *context, const know_place *at, const char *text);

/* The options of a translation: the language, the number of facets in a full turn, the parameters that the user has
 * set, and the function that receives complaints. */
typedef struct {
  const char *language;
  unsigned segments;
  const know_setting *settings; size_t setting_count;
  know_complain *complain; void *context;
} know_translation;

/* Returns the name of the language with this name, or of the language that the path's suffix denotes. Returns NULL if
 * there is none. */
const char *know_language(const char *name, const char *path);
/* Returns the names of all languages, separated by blanks. */
const char *know_languages(void);
/* Returns the program in the language that `wanted` names: *length bytes, which the caller frees. Returns NULL on
 * failure. Then wanted->complain has received each part that the language cannot express, with its place, in the order
 * of the text, or k->trouble has the reason. */
char *know_translate(knowledge *k, const know_translation *wanted, size_t *length);

#endif
