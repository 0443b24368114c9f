/* Declares functions that write texts and numbers as JSON. */
#ifndef VS_CLI_JSON_H
#define VS_CLI_JSON_H

#include <stdio.h>

void cli_json_text(FILE *to, const char *text);
void cli_json_number(FILE *to, double v); /* Writes the shortest text that reads back as v, or null if v is infinite or
                                           * NaN. */

#endif
