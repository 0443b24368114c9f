/* Declares the reading of unfinished Scheme text for the prompt: open brackets, the call at the cursor, indentation,
 * and the class of each byte for colours. */
#ifndef VS_CLI_PROMPT_SOURCE_TEXT_H
#define VS_CLI_PROMPT_SOURCE_TEXT_H

#include "visualscheme.h"

enum { CLI_DEEP = 256 }; /* greatest number of open brackets that are recorded; brackets nested deeper are ignored */

/* Stores in `open` the positions of the brackets that are open at the end of the text, and returns their number, at
 * most CLI_DEEP. Sets *in_string, which may be NULL, if the text ends within a string. */
size_t cli_text_open(const char *text, size_t length, size_t open[CLI_DEEP], bool *in_string);

/* The innermost call that is not closed at the end of a text. */
typedef struct {
  char name[100];
  int argument; /* number, from 0, of the argument at the end of the text; -1: the end is in the procedure's name, or in
                 * the value of a keyword */
} cli_call;
/* Sets *call to the innermost call that is open at the end of the text. Returns false if no call is open, or its name
 * is too long. */
bool cli_text_call(const char *text, cli_call *call);

/* Returns the indentation in blanks, at most 60, of the line after the text. Arguments are below the first argument.
 * The body of a form such as define is two columns right of the form's bracket; data and clauses are one column right
 * of their bracket. Returns 0 within a string. */
size_t cli_text_indentation(vs_scheme *scheme, const char *text);

/* Returns the number, from 1, of the line that probably lacks a closing bracket at its end, or 0. The line after it
 * begins with a bracket in its first column, or with a definition that would be an argument of a procedure. */
unsigned cli_text_lacks_bracket(vs_scheme *scheme, const char *text);

typedef enum {
#define SYNTAX(name, colour, what) CLI_SYNTAX_##name,
#include "cli/prompt/syntax.def"
} cli_syntax;
extern const char *const cli_syntax_colours[]; /* cli_syntax_colours[c]: colour of class c as the numbers of ESC [ ...
                                                * m, or "" */

/* Writes the class of each byte of the text into `classes`, an array of `length` elements. The cursor is before
 * text[cursor]. */
void cli_text_classes(vs_scheme *scheme, const char *text, size_t length, size_t cursor, unsigned char *classes);

#endif
