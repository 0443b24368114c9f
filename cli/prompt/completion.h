/* Declares the search for names that complete the word before the cursor. */
#ifndef VS_CLI_PROMPT_COMPLETION_H
#define VS_CLI_PROMPT_COMPLETION_H

#include "cli/prompt/line_buffer.h"
#include "visualscheme.h"

/* The kind of the word before the cursor. */
typedef enum { CLI_WORD_NAME, CLI_WORD_KEYWORD, CLI_WORD_FILE, CLI_WORD_COMMAND } cli_word_kind;

typedef struct {
  char **at;         /* the names, in order; the owner of the list frees it by cli_names_free */
  size_t count, room;
  size_t common;     /* length in bytes of the longest common beginning of the names; it does not end within a
                      * character */
  cli_word_kind kind;
  size_t prefix;     /* length in bytes of the word before the cursor, with which every name begins */
} cli_names;

/* A function that passes the name of each command of the prompt to `each`. */
typedef void cli_each_command(void (*each)(void *context, const char *name), void *context);

/* Finds the names that complete the word at the end of the text `before`. When memory is out, some names are missing in
 * the list. */
void cli_names_find(vs_scheme *scheme, cli_each_command *commands, const char *before, cli_names *found);
void cli_names_free(cli_names *n);

/* Appends the names in columns, for a terminal of that width; each row ends in "\r\n". Appends at most `rows` rows:
 * those around name number `chosen`, or the first rows if it is -1. If rows are omitted, the last row is the number of
 * all names. The chosen name is in reverse video with `colours`, otherwise in brackets. Returns the number of rows. */
int cli_names_rows(const cli_names *n, int chosen, int width, int rows, bool colours, line_buffer *to);

#endif
