/* Writes words of a command line for a shell. */
#include "cli/usage/shell_words.h"

#include <string.h>

void cli_put_quoted(FILE *to, const char *word) {
  fputc('\'', to);
  for (; *word; word++)
    if (*word == '\'') fputs("'\\''", to);
    else fputc(*word, to);
  fputc('\'', to);
}

void cli_put_word(FILE *to, const char *word) {
  static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.,:/=+@%#";
  if (*word && *word != '#' && word[strspn(word, plain)] == 0) fputs(word, to);
  else cli_put_quoted(to, word);
}
