/* Owns the editing of lines on a terminal: keys, completion, history, paste (libedit). */
#ifndef VS_CLI_PROMPT_EDITOR_H
#define VS_CLI_PROMPT_EDITOR_H

#include "visualscheme.h"

typedef struct cli_editor cli_editor;

/* Returns a new editor; NULL: there is no terminal, or no memory. `commands` passes the names of the prompt's own
 * commands to each. */
cli_editor *cli_editor_open(vs_scheme *scheme,
                            void (*commands)(void (*each)(void *context, const char *name), void *context));
void cli_editor_close(cli_editor *e); /* saves the history; NULL is fine */

/* Returns a line with its newline, or several that were pasted or recalled; NULL at the end of input, or at an
 * interrupt (errno EINTR). open: the lines of the unfinished expression ("": none). *whole: the result includes those
 * lines. */
const char *cli_editor_line(cli_editor *e, const char *prompt, const char *open, size_t *length, bool *whole);
/* Work while no key comes: the editor calls `look` every few hundredths of a second. If it returns true, the editor
 * removes the line, calls `act`, and shows the line again after its output. */
typedef struct { bool (*look)(void *context); void (*act)(void *context); void *context; } cli_idle;
void cli_editor_idle(cli_editor *e, cli_idle idle);
/* Adds a whole expression, or a command, to the history. */
void cli_editor_remember(cli_editor *e, const char *text, size_t length);
/* Returns true if more input waits already, as after a paste on a terminal that does not mark it. */
bool cli_editor_has_more(const cli_editor *e);

bool cli_colours(int descriptor);   /* true if colours are allowed there: a terminal, without NO_COLOR */
int cli_terminal_width(void);       /* in columns; 80 if it is not known */

#endif
