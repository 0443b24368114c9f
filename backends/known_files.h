/* Declares the list of files that a run has read, and that no output may overwrite. */
#ifndef VS_BACKENDS_KNOWN_FILES_H
#define VS_BACKENDS_KNOWN_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/store/store.h"

/* A file in the list. device, node: device and inode. made: whether the program itself has created the file. */
typedef struct { uint64_t device, node; char *path; bool made; } vs_known_file;
typedef struct {
  vs_known_file *at;
  size_t count, room;
  vs_alloc_fn *memory; /* allocator for the list and the names */
  void *context;
} vs_known_files;

/* Adds an open file to the list. made: whether the program itself has created it, and has not only read it. Ignores
 * pipes and everything that is not a regular file. Returns false when memory is out. */
bool vs_known_files_add(vs_known_files *l, const char *path, int file, bool made);
/* Adds the file at path to the list as a file that was read. Returns false when memory is out. Returns true even if
 * there is no such file. */
bool vs_known_files_add_path(vs_known_files *l, const char *path);
/* Returns true if the file at path was read, even under another name. Returns false if l or path is NULL. */
bool vs_known_files_read(const vs_known_files *l, const char *path);
/* Returns the name of the file number `index` among those that were read, or NULL if there is none. */
const char *vs_known_files_name(const vs_known_files *l, size_t index);
void vs_known_files_free(vs_known_files *l);

#endif
