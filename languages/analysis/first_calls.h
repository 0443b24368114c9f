/* Declares the instrumented text of a program, which records the result of each procedure's first call. */
#ifndef VS_LANGUAGES_ANALYSIS_FIRST_CALLS_H
#define VS_LANGUAGES_ANALYSIS_FIRST_CALLS_H

#include "languages/analysis/analysis.h"

enum { KNOW_FIRST_ROOM = 40 };

/* Returns the program's text, changed so that each procedure keeps the result of its first call. Lines keep their
 * numbers. The caller frees the text. Returns NULL if the program is a script, or memory is out. */
char *know_remembering(const knowledge *k, size_t *length);
/* Returns true if the text records results of the procedure. */
bool know_remembers(const knowledge *k, know_index symbol);
/* Writes the expression that returns the recorded result, or #f if the procedure was never called. It has at most
 * KNOW_FIRST_ROOM bytes. */
void know_first_result(know_index symbol, char *expression);

#endif
