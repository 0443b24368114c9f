/* Declares the instrumented text of a program, which records the result of each procedure's first call. */
#ifndef VS_LANGUAGES_ANALYSIS_FIRST_CALLS_H
#define VS_LANGUAGES_ANALYSIS_FIRST_CALLS_H

#include "languages/analysis/analysis.h"

enum { KNOW_FIRST_ROOM = 40 };

/* Returns the program's text, changed so that it records the result of each procedure's first call. Lines keep their
 * numbers. The caller frees the text. Returns NULL if the program is a script, or memory is out. */
char *know_remembering(const knowledge *k, size_t *length);
/* Returns true if the instrumented text records a result of the procedure. */
bool know_remembers(const knowledge *k, know_index symbol);
/* Writes the expression that returns the recorded result of the procedure, or #f if it was never called. The expression
 * has at most KNOW_FIRST_ROOM bytes. */
void know_first_result(know_index symbol, char *expression);

#endif
