/* Owns the editing of lines on a terminal: keys, completion, history, paste (libedit). */
#ifndef VS_CLI_PROMPT_EDITOR_H
#define VS_CLI_PROMPT_EDITOR_H

#include "visualscheme.h"

typedef struct cli_editor cli_editor;

/* NULL: there is no terminal to edit on, or no memory. `commands` hands the names of the prompt's own commands to
 * each. */
cli_editor *cli_editor_open(vs_scheme *scheme,
                            void (*commands)(void (*each)(void *context, const char *name), void *context));
void cli_editor_close(cli_editor *e); /* saves the history; NULL is fine */

/* A line with its newline, or several that were pasted or recalled; NULL at the end of input, or at an interrupt
 * (errno EINTR). open: the lines before it,
 * whose expression is still open ("" where none is). *whole: the line holds those before it too. */
const char *cli_editor_line(cli_editor *e, const char *prompt, const char *open, size_t *length, bool *whole);
/* While no key comes: `look` is called every few hundredths of a second; where it returns true, `act` is called with
 * the line out of the way, and the line shown again behind what it printed. */
typedef struct { bool (*look)(void *context); void (*act)(void *context); void *context; } cli_idle;
void cli_editor_idle(cli_editor *e, cli_idle idle);
/* A whole expression, or a command, to come back to. */
void cli_editor_remember(cli_editor *e, const char *text, size_t length);
/* Has more been typed already, as when text is pasted on a terminal that does not say so? */
bool cli_editor_has_more(const cli_editor *e);

bool cli_colours(int descriptor);   /* may colours be shown there? A terminal, and NO_COLOR is not set */
int cli_terminal_width(void);       /* in columns; 80 where it is not known */

#endif
