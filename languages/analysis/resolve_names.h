/* Owns the reading of a program, from its text to what its names mean. */
#ifndef VS_LANGUAGES_ANALYSIS_RESOLVE_NAMES_H
#define VS_LANGUAGES_ANALYSIS_RESOLVE_NAMES_H

#include "languages/analysis/analysis.h"

/* Reads and analyses the program in the file, and what it loads and includes. False: k->trouble says why, or the
 * interpreter's host was told; k->outcome is the exit code. know_free in either case. scheme must have no program of
 * its own yet. */
/* library_path: as in vs_options, or NULL. */
bool know_read(knowledge *k, vs_scheme *scheme, const char *path, const char *library_path);
/* As know_read, but the program's own text is the one given, as an editor has it before it is saved. */
bool know_read_given(knowledge *k, vs_scheme *scheme, const char *path, const char *text, size_t length,
    const char *library_path);

#endif
