/* Declares the editor for lines on a terminal: keys, completion, history and paste, by libedit. */
#ifndef VS_CLI_PROMPT_EDITOR_H
#define VS_CLI_PROMPT_EDITOR_H

#include "cli/prompt/completion.h"
#include "visualscheme.h"

typedef struct cli_editor cli_editor;

/* Returns a new editor, or NULL if there is no terminal or no memory. */
cli_editor *cli_editor_open(vs_scheme *scheme, cli_each_command *commands);
void cli_editor_close(cli_editor *e); /* Saves the history and frees the editor. NULL is permitted. */

/* Returns a line with its newline, or several lines that were pasted or recalled. open: the lines of the unfinished
 * expression, or "". Sets *whole if the result includes these lines. Returns NULL at the end of input or, with errno
 * EINTR, at an interrupt. */
const char *cli_editor_line(cli_editor *e, const char *prompt, const char *open, size_t *length, bool *whole);
/* Functions that the editor calls while no key is pressed. It calls `look` every 40 ms. If `look` returns true, the
 * editor removes the line, calls `act`, and shows the line again after the output of `act`. */
typedef struct { bool (*look)(void *context); void (*act)(void *context); void *context; } cli_idle;
void cli_editor_idle(cli_editor *e, cli_idle idle);
/* Adds a complete expression or command to the history. */
void cli_editor_remember(cli_editor *e, const char *text, size_t length);
/* Returns true if more input is waiting, as after a paste on a terminal that does not mark it. */
bool cli_editor_has_more(const cli_editor *e);

bool cli_colours(int descriptor);   /* Returns true if colours may be used on this descriptor: it is a terminal, and
                                     * NO_COLOR is not set. */
int cli_terminal_width(void);       /* Returns the width of the terminal in columns, or 80 if it is unknown. */

#endif
