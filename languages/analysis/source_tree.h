/* Owns the way from a program's text to nodes with places, and its comments. */
#ifndef VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H
#define VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H

#include "languages/analysis/analysis.h"

/* Returns true if the analysis knows the file's language, by its name: Scheme and JavaScript, not GML. */
bool know_reads(const char *path);

/* Reads the file and adds it to k->files, with its root. loaded_by: the node that loads it; then a file that is there
 * already is not read again. Returns its index; UINT32_MAX: trouble. The language's own reader reports errors in the
 * text to the interpreter's host. */
know_index know_read_file(knowledge *k, const char *path, know_index loaded_by);
enum { KNOW_PATH = 4096 };
/* Gives the path of the file that the string at node names: beside the file with the string, beside the program, else
 * in a folder of k->library_path. Returns false if there is no such file; path is then the one beside the file. */
bool know_find_file(const knowledge *k, know_index node, char path[KNOW_PATH]);

#endif
