/* Owns the writing of JSON: text and numbers. */
#ifndef VS_CLI_JSON_H
#define VS_CLI_JSON_H

#include <stdio.h>

void cli_json_text(FILE *to, const char *text);
void cli_json_number(FILE *to, double v); /* the shortest text that reads back as v; null for a number that JSON
                                           * lacks */

#endif
