/* Declares the analysis of a program, from its text to the meanings of its names. */
#ifndef VS_LANGUAGES_ANALYSIS_RESOLVE_NAMES_H
#define VS_LANGUAGES_ANALYSIS_RESOLVE_NAMES_H

#include "languages/analysis/analysis.h"

/* Reads and analyses the program in the file at `path`, and the files that it loads and includes. Returns false on
 * failure. The reason is then in k->trouble, or in a message to the interpreter's host, and k->outcome is the exit
 * code. The caller calls know_free also after a failure. scheme must not have run a program. */
/* library_path: folders as in vs_options, or NULL. */
bool know_read(knowledge *k, vs_scheme *scheme, const char *path, const char *library_path);
/* Reads and analyses a program as know_read does, but with the given text instead of the file's text, as in an editor
 * before a save. */
bool know_read_given(knowledge *k, vs_scheme *scheme, const char *path, const char *text, size_t length,
    const char *library_path);

#endif
