/* Owns files that appear whole or not at all. */
#ifndef VS_BACKENDS_PUBLISH_H
#define VS_BACKENDS_PUBLISH_H

#include <stdbool.h>

typedef struct {
  int file;       /* to write to; the caller does not close it */
  char *target;   /* the path that it is to have */
  char *name;     /* of the file meanwhile, beside the target */
  bool nameless;  /* it has no name yet, and goes with the process */
} vs_publish;

/* Begins a file that is to stand at path; where that is a symbolic link, at its end, and the link stays. named: another
 * program is to write it, by its name p->name. False: errno says why, and nothing is open. */
bool vs_publish_begin(vs_publish *p, const char *path, bool named);
/* Ends it. whole: the file takes the target's place, in one step; else it goes. False: errno is the first failure (of
 * closing or of taking the place), and the target is as it was. */
bool vs_publish_end(vs_publish *p, bool whole);

/* Removes the leftovers of killed runs from a folder: this user's files, and folders of files, whose names begin so and
 * go on with characters of `end` only. A living run holds its own by flock; an entry that is only some seconds old may
 * not be locked yet and stays. */
void vs_publish_sweep(const char *folder, const char *beginning, const char *end);
/* Removes a folder that holds files alone. */
void vs_publish_clear(const char *folder);

#endif
