/* Declares the reading of unfinished Scheme text for the prompt: open brackets, the call at the cursor, indentation,
 * and the class of each byte for colours. */
#ifndef VS_CLI_PROMPT_SOURCE_TEXT_H
#define VS_CLI_PROMPT_SOURCE_TEXT_H

#include "visualscheme.h"

enum { CLI_DEEP = 256 }; /* brackets that are open further in are not followed */

/* Stores in `open` the positions of the brackets that are open at the end of the text, and returns their number, at
 * most CLI_DEEP. Sets *in_string, which may be NULL, if the text ends within a string. */
size_t cli_text_open(const char *text, size_t length, size_t open[CLI_DEEP], bool *in_string);

/* The innermost call that is open at the end of a text. */
typedef struct {
  char name[100];
  int argument; /* number of the argument at the end, from 0; -1: the name itself, or the argument of a keyword */
} cli_call;
/* Returns false if no call is open, or its name is too long. */
bool cli_text_call(const char *text, cli_call *call);

/* Returns the number of blanks, at most 60, at the start of the line after the text. Arguments are below the first one;
 * the body of a form is two columns right of its bracket, data and clauses are one. Returns 0 within a string. */
size_t cli_text_indentation(vs_scheme *scheme, const char *text);

/* Returns the number of the line, from 1, that probably lacks a closing bracket at its end, or 0. The line after it
 * begins with a bracket in its first column, or with a definition as an argument of a procedure. */
unsigned cli_text_lacks_bracket(vs_scheme *scheme, const char *text);

typedef enum {
#define SYNTAX(name, colour, what) CLI_SYNTAX_##name,
#include "cli/prompt/syntax.def"
} cli_syntax;
extern const char *const cli_syntax_colours[]; /* by cli_syntax: the numbers of ESC [ ... m, or "" */

/* Writes the class of each byte of the text into `classes`, of `length` bytes, with the cursor before text[cursor]. */
void cli_text_classes(vs_scheme *scheme, const char *text, size_t length, size_t cursor, unsigned char *classes);

#endif
