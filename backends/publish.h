/* Owns files that appear whole or not at all. */
#ifndef VS_BACKENDS_PUBLISH_H
#define VS_BACKENDS_PUBLISH_H

#include <stdbool.h>

typedef struct {
  int file;       /* open for writing; the caller does not close it */
  char *target;   /* the final path */
  char *name;     /* the temporary path, beside the target */
  bool nameless;  /* it has no name yet, and vanishes with the process */
} vs_publish;

/* Begins a file that will appear at path. If path is a symbolic link, the file appears at its end, and the link
 * remains. named: another program will write it, by its name p->name. Returns false with the reason in errno; nothing
 * is then open. */
bool vs_publish_begin(vs_publish *p, const char *path, bool named);
/* Ends the file. whole: it replaces the target, in one step; else it is removed. Returns false with the first failure
 * in errno (of closing or of renaming); the target is then unchanged. */
bool vs_publish_end(vs_publish *p, bool whole);

/* Removes the leftovers of killed runs from a folder: this user's files, and folders of files, whose names are
 * `beginning` followed only by characters of `end`. A living run locks its own with flock. An entry that is only some
 * seconds old may not be locked yet, and remains. */
void vs_publish_sweep(const char *folder, const char *beginning, const char *end);
/* Removes a folder that contains only files. */
void vs_publish_clear(const char *folder);

#endif
