/* Declares files that appear completely or not at all. */
#ifndef VS_BACKENDS_PUBLISH_H
#define VS_BACKENDS_PUBLISH_H

#include <stdbool.h>

typedef struct {
  int file;       /* descriptor, open for writing; the caller does not close it */
  char *target;   /* path at which the file will appear */
  char *name;     /* temporary path, beside the target */
  bool nameless;  /* whether the file has no name yet, so that it vanishes when the process ends */
} vs_publish;

/* Begins a file that will appear at path, or at the end of a symbolic link there, when it is complete. named: whether
 * another program will write the file, under the name p->name. On failure returns false, with the reason in errno. */
bool vs_publish_begin(vs_publish *p, const char *path, bool named);
/* Ends the file. If `whole` is true, the file replaces the target in a single step; otherwise the file is removed.
 * Returns false if closing or renaming fails, with the errno of the first failure; the target is then unchanged. */
bool vs_publish_end(vs_publish *p, bool whole);

/* Removes files and folders that ended processes of this user left in a folder. Their name must be `beginning` followed
 * only by characters of `end`. Entries that a running process has locked, or that are a few seconds old, are kept. */
void vs_publish_sweep(const char *folder, const char *beginning, const char *end);
/* Removes a folder together with its contents, which must be files. */
void vs_publish_clear(const char *folder);

#endif
