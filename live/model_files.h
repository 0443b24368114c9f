/* Owns the model's files: reading them for the interpreter while noting which they were, seeing that one has changed,
 * writing the source back. */
#ifndef VS_LIVE_MODEL_FILES_H
#define VS_LIVE_MODEL_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

typedef struct {
  char *path;
  bool there;
  bool young; /* it was noted within the clock of its file system's times: written again then, it would look the same */
  dev_t device;
  ino_t inode;
  off_t size;
  int64_t seconds;
  long nanoseconds;
} live_file;
typedef struct { live_file *at; size_t count, room; } live_files;

/* Reads a whole file. True: *text is the caller's to free. False: *why says so and is static. */
bool live_file_read(const char *path, char **text, size_t *length, const char **why);
/* Gives the names in a folder to take until it returns false; as vs_host.list_folder. */
bool live_folder_list(const char *path, bool (*take)(void *to, const char *name, size_t length), void *to,
                      const char **why);
bool live_files_note(live_files *f, const char *path); /* as it is now, before it is read; false: out of memory */
/* Is one of them another than it was, or was one of them met between being emptied and written? */
bool live_files_changed(const live_files *f);
bool live_files_newer(const live_files *f); /* Is one of them another than it was? While they are in use. */
/* Waits until the files have been left alone for a moment, at most a third of a second. A file whose last change is
 * younger than the clock of the file system's times could change once more and look the same; an empty one is probably
 * being written. */
void live_files_settle(const live_files *f);
void live_files_clear(live_files *f);
uint64_t live_file_hash(const char *text, size_t length);
/* Writes the file whole or not at all, over what has `expected` for a hash only. Returns NULL, or why not: LIVE_NEWER
 * where the file has changed meanwhile. */
extern const char LIVE_NEWER[];
const char *live_file_write(const char *path, const char *text, size_t length, uint64_t expected);

#endif
