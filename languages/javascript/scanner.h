/* Declares the conversion of a script's text to tokens and comments. */
#ifndef VS_LANGUAGES_JAVASCRIPT_SCANNER_H
#define VS_LANGUAGES_JAVASCRIPT_SCANNER_H

#include "languages/javascript/script.h"

typedef enum {
  VS_TOKEN_END,
  VS_TOKEN_NAME,
  VS_TOKEN_WORD,
  VS_TOKEN_NUMBER,
  VS_TOKEN_STRING,
  VS_TOKEN_MARK,
  VS_TOKEN_NATIVE
} vs_token_kind;

typedef enum {
#define VS_SCRIPT_WORD(name, text, out) VS_WORD_##name,
#include "languages/javascript/script_words.def"
#undef VS_SCRIPT_WORD
  VS_WORD_COUNT
} vs_script_word;

typedef struct {
  uint8_t kind;
  bool newline;          /* whether a line ended between the last token and this token */
  uint8_t word;          /* WORD (a reserved word): which word, a vs_script_word */
  char mark[5];          /* MARK (an operator or bracket): its characters */
  uint32_t name;         /* NAME, WORD: index of the name in the script's names */
  uint32_t text, length; /* STRING, NATIVE: offset and length of the token's contents in the script's `texts` */
  double number;
  vs_script_place at;
} vs_token;

typedef struct {
  vs_script *s;
  size_t at, line_start, column_at;
  uint32_t line, column;
  bool line_has_code;
  vs_token token; /* the token that was read last */
} vs_scanner;

/* Checks that the text is valid UTF-8 and moves to the position before its first token. Returns false with the script's
 * trouble set. */
bool vs_scanner_open(vs_scanner *c, vs_script *s);
/* Reads the next token. Returns false with the script's trouble set. */
bool vs_scanner_next(vs_scanner *c);
const char *vs_script_word_out(vs_script_word word);

#endif
