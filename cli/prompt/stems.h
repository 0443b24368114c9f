/* Declares the comparison of words by their stems, for searches in the manual: contours has the stem of contour,
 * animated that of animation, spiral-stair those of Spiral stairs. */
#ifndef VS_CLI_PROMPT_STEMS_H
#define VS_CLI_PROMPT_STEMS_H

#include <stdbool.h>
#include <stddef.h>

#include <libstemmer.h>

/* The stems of English words, by libstemmer. */
typedef struct {
  struct {
#define STEM(name) __typeof__(&name) name;
#include "cli/prompt/stems.def"
  } call;
  struct sb_stemmer *english; /* stemmer for English; NULL if the library is missing: each word is then its own stem */
} cli_stems;

/* Loads the library. The caller closes s. */
void cli_stems_open(cli_stems *s);
void cli_stems_close(cli_stems *s);

enum { CLI_PHRASE_WORDS = 8, CLI_STEM_SIZE = 32 };

/* The words of a short text in lower case, or their stems. A word is a sequence of letters, digits and bytes of
 * UTF-8. */
typedef struct {
  char word[CLI_PHRASE_WORDS][CLI_STEM_SIZE];
  size_t count; /* number of words; 0 if the text has no word, too many words, or a word that is too long */
} cli_phrase;

/* Returns the stems of the text's words. If s is NULL, returns the words themselves in lower case. */
cli_phrase cli_phrase_of(const cli_stems *s, const char *text, size_t length);
/* Returns true if the text contains the words of the phrase as consecutive words. */
bool cli_phrase_in(const cli_stems *s, const cli_phrase *p, const char *text, size_t length);
/* Returns true if the words of the text are exactly those of the phrase. */
bool cli_phrase_is(const cli_stems *s, const cli_phrase *p, const char *text, size_t length);

#endif
