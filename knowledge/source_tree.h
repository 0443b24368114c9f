/* Owns the way from a program's text to nodes with places, and its comments. */
#ifndef VS_KNOWLEDGE_SOURCE_TREE_H
#define VS_KNOWLEDGE_SOURCE_TREE_H

#include "knowledge/knowledge.h"

/* Reads the file and adds it to k->files, its root set. loaded_by: the node that loads it; then a file that is there
 * already is not read
 * again. Returns its index; UINT32_MAX with trouble. What is wrong with the text is told to the interpreter's host, by
 * the language's own reader. */
know_index know_read_file(knowledge *k, const char *path, know_index loaded_by);
/* Is there such a file? */
bool know_file_exists(const char *path);

#endif
