/* Owns the text of a program that remembers what its procedures give when they are first called. */
#ifndef VS_LANGUAGES_ANALYSIS_FIRST_CALLS_H
#define VS_LANGUAGES_ANALYSIS_FIRST_CALLS_H

#include "languages/analysis/analysis.h"

enum { KNOW_FIRST_ROOM = 40 };

/* The program's text, each procedure of which, when it is first called, keeps what it gives. Lines stay where they are.
 * NULL: it is a script, or out of memory. The caller frees it. */
char *know_remembering(const knowledge *k, size_t *length);
/* Is that kept for the procedure? */
bool know_remembers(const knowledge *k, know_index symbol);
/* The expression that gives it, #f where it was never called: at most KNOW_FIRST_ROOM bytes. */
void know_first_result(know_index symbol, char *expression);

#endif
