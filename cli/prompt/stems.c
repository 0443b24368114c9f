/* Compares words by their stems. libstemmer finds the stems; it is loaded for the first search. */
#include "cli/prompt/stems.h"

#include <ctype.h>
#include <string.h>

#include "geometry/dynamic.h"

void cli_stems_open(cli_stems *s) {
  static const vs_dynamic_name names[] = {
#define STEM(name) { #name, offsetof(__typeof__(((cli_stems *)0)->call), name) },
#include "cli/prompt/stems.def"
  };
  vs_error error = { 0 };
  if (vs_dynamic_load(VS_LIBRARY_STEMMER, "the stems of words", names, sizeof names / sizeof *names, &s->call, &error))
    s->english = s->call.sb_stemmer_new("english", NULL);
  else s->english = NULL;
}

void cli_stems_close(cli_stems *s) {
  if (s->english) s->call.sb_stemmer_delete(s->english);
}

static bool in_word(char c) { return isalnum((unsigned char)c) || (unsigned char)c >= 0x80; }

/* Reads the next word of the text. Writes its stem to the array `word` of CLI_STEM_SIZE bytes, or "" if the word is too
 * long. Returns the end of the word, or NULL if there is no further word. */
static const char *next_stem(const cli_stems *s, const char *at, const char *end, char *word) {
  while (at < end && !in_word(*at)) at++;
  if (at == end) return NULL;
  size_t n = 0;
  for (; at < end && in_word(*at); at++, n++)
    if (n < CLI_STEM_SIZE - 1) word[n] = (char)tolower((unsigned char)*at);
  word[n < CLI_STEM_SIZE ? n : 0] = 0;
  if (!s || !s->english || !*word) return at;
  const sb_symbol *stem = s->call.sb_stemmer_stem(s->english, (const sb_symbol *)word, (int)n);
  int length = s->call.sb_stemmer_length(s->english);
  if (stem && length > 0 && length < CLI_STEM_SIZE) {
    memcpy(word, stem, (size_t)length);
    word[length] = 0;
  }
  return at;
}

cli_phrase cli_phrase_of(const cli_stems *s, const char *text, size_t length) {
  cli_phrase p = { .count = 0 };
  char word[CLI_STEM_SIZE];
  for (const char *at = text, *end = text + length; (at = next_stem(s, at, end, word)) != NULL;) {
    if (!*word || p.count == CLI_PHRASE_WORDS) return (cli_phrase){ .count = 0 };
    strcpy(p.word[p.count++], word);
  }
  return p;
}

bool cli_phrase_in(const cli_stems *s, const cli_phrase *p, const char *text, size_t length) {
  char word[CLI_STEM_SIZE];
  const char *end = text + length;
  if (!p->count) return false;
  for (const char *from = text; (from = next_stem(s, from, end, word)) != NULL;) {
    const char *at = from;
    size_t same = 0;
    while (at && same < p->count && strcmp(word, p->word[same]) == 0)
      if (++same < p->count) at = next_stem(s, at, end, word);
    if (same == p->count) return true;
  }
  return false;
}

bool cli_phrase_is(const cli_stems *s, const cli_phrase *p, const char *text, size_t length) {
  cli_phrase other = cli_phrase_of(s, text, length);
  if (!p->count || other.count != p->count) return false;
  for (size_t i = 0; i < p->count; i++)
    if (strcmp(p->word[i], other.word[i]) != 0) return false;
  return true;
}
