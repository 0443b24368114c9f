/* Owns the way from a program's text to nodes with places, and its comments. */
#ifndef VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H
#define VS_LANGUAGES_ANALYSIS_SOURCE_TREE_H

#include "languages/analysis/analysis.h"

/* Is the file in a language that is looked into: Scheme or JavaScript? By its name; false for GML. */
bool know_reads(const char *path);

/* Reads the file and adds it to k->files, its root set. loaded_by: the node that loads it; then a file that is there
 * already is not read again. Returns its index; UINT32_MAX with trouble. Errors in the text are told to the
 * interpreter's host, by the language's own reader. */
know_index know_read_file(knowledge *k, const char *path, know_index loaded_by);
enum { KNOW_PATH = 4096 };
/* The path of the file that the string at node names: beside the file that says it, beside the program, else in a
 * folder of k->library_path. False: there is none; path is then what it would be beside the file. */
bool know_find_file(const knowledge *k, know_index node, char path[KNOW_PATH]);

#endif
