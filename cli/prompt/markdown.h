/* Owns how a page of the manual reads in a terminal. Of Markdown it knows what the manual has: headings, paragraphs,
 * lists, tables, blocks of code, and `code`, **strong** and [links](to) within a line. */
#ifndef VS_CLI_PROMPT_MARKDOWN_H
#define VS_CLI_PROMPT_MARKDOWN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Prints the text, its paragraphs, list items and cells of tables filled to `width` columns; code keeps its lines. With
 * `bold`, headings, code and strong words are in bold type. Pictures are left out. False without memory: what was
 * printed is then cut short. */
bool cli_markdown_print(const char *text, size_t length, int width, bool bold, FILE *to);
/* Prints one line of it without any bold type and without a newline, as in a list of headings. */
void cli_markdown_print_line(const char *text, size_t length, FILE *to);
/* How many # the heading at the beginning of this line has; 0 where the line is no heading. */
int cli_markdown_level(const char *line, size_t length);

#endif
