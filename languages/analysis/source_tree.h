/* Declares the reading of a program's text into nodes with places, and of its comments. */
#ifndef VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H
#define VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H

#include "languages/analysis/analysis.h"

/* Returns true if the analysis can read files with this name: Scheme and JavaScript, not GML. */
bool know_reads(const char *path);

/* Reads the file and adds it to k->files, with the node of its forms. loaded_by: node of the form that loads the file,
 * or 0. If it is not 0, a file that was read before is not read again. Returns the file's index, or UINT32_MAX on
 * failure. The language's own reader reports errors in the text to the interpreter's host. */
know_index know_read_file(knowledge *k, const char *path, know_index loaded_by);
/* Returns true if the language's reader accepts the text. path: the text's name in messages. Runs no part of the
 * text. */
bool know_readable(knowledge *k, const char *path, const char *text, size_t length);
/* Returns the text of the file, or of standard input if path is "-", with a final NUL. The caller frees it. Returns
 * NULL on failure. */
char *know_file_text(knowledge *k, const char *path, size_t *length);
enum { KNOW_PATH = 4096 };
/* Sets path to the file to which the string at the node refers. Searches in the folder of the file that contains the
 * string, in that of the program, and in the folders of k->library_path. Returns false if none has the file; path is
 * then in the first folder. */
bool know_find_file(const knowledge *k, know_index node, char path[KNOW_PATH]);

#endif
