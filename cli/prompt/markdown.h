/* Declares functions that print Markdown on a terminal. They support the parts that the manual uses: headings,
 * paragraphs, lists, tables, blocks of code, and `code`, **strong** and [links](to) within a line. */
#ifndef VS_CLI_PROMPT_MARKDOWN_H
#define VS_CLI_PROMPT_MARKDOWN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Prints the text. Paragraphs, list items and table cells fill `width` columns; code keeps its lines. With `bold`,
 * headings, code and strong words are in bold type. Omits pictures. Returns false when memory is out; the output then
 * ends early. */
bool cli_markdown_print(const char *text, size_t length, int width, bool bold, FILE *to);
/* Prints one line of Markdown without bold type and without a newline, for lists of headings. */
void cli_markdown_print_line(const char *text, size_t length, FILE *to);
/* Returns the number of # of the heading on this line, or 0 if the line is no heading. */
int cli_markdown_level(const char *line, size_t length);

#endif
