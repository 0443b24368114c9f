/* Declares the reading of a program's text into nodes with places, and of its comments. */
#ifndef VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H
#define VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H

#include "languages/analysis/analysis.h"

/* Returns true if the analysis can read files with this name: Scheme and JavaScript, not GML. */
bool know_reads(const char *path);

/* Reads the file and adds it to k->files, with its root. loaded_by: the node that loads it. If this is set and the file
 * was read before, it is not read again. Returns the file's index, or UINT32_MAX on failure. The language's own reader
 * reports errors in the text to the interpreter's host. */
know_index know_read_file(knowledge *k, const char *path, know_index loaded_by);
/* Returns true if the language's reader accepts the text, named path in messages. Runs nothing. */
bool know_readable(knowledge *k, const char *path, const char *text, size_t length);
/* Returns the text of the file, or of standard input for "-", with a final NUL. The caller frees it. Returns NULL on
 * failure. */
char *know_file_text(knowledge *k, const char *path, size_t *length);
enum { KNOW_PATH = 4096 };
/* Sets path to the file to which the string at node refers. Searches beside the file with the string, beside the
 * program, and in the folders of k->library_path. Returns false if there is no such file; path is then the one beside
 * the file with the string. */
bool know_find_file(const knowledge *k, know_index node, char path[KNOW_PATH]);

#endif
