/* Declares the model's files: it reads them for the interpreter and records their names, detects changes, and writes
 * the source back. */
#ifndef VS_LIVE_MODEL_FILES_H
#define VS_LIVE_MODEL_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

typedef struct {
  char *path;
  bool there;
  bool young; /* whether the file had changed less than a clock tick of its file system before its state was recorded,
               * so that a later change could have an equal time */
  dev_t device;
  ino_t inode;
  off_t size;
  int64_t seconds;
  long nanoseconds;
} live_file;
typedef struct { live_file *at; size_t count, room; } live_files;

/* Reads a whole file. Returns true and sets *text, which the caller frees. On failure, returns false and sets *why to
 * the reason, a static text. */
bool live_file_read(const char *path, char **text, size_t *length, const char **why);
/* Calls `take` with each name in a folder until it returns false, as vs_host.list_folder does. */
bool live_folder_list(const char *path, bool (*take)(void *to, const char *name, size_t length), void *to,
                      const char **why);
bool live_files_note(live_files *f, const char *path); /* Records the current state of a file, before it is read.
                                                        * Returns false if memory is out. */
/* Returns true if a file has changed since its state was recorded, or was empty when it was read, since an editor had
 * probably just begun to write it. */
bool live_files_changed(const live_files *f);
bool live_files_newer(const live_files *f); /* Returns true if a recorded file has changed since its state was recorded.
                                             * May be called while the model still reads other files. */
/* Waits, at most about 0.7 seconds, until no file has just changed or is empty. A file that changed less than a clock
 * tick ago could change again without a new time of change. An empty file is probably being written. */
void live_files_settle(const live_files *f);
void live_files_clear(live_files *f);
uint64_t live_file_hash(const char *text, size_t length);
/* Writes the file completely or not at all, and only if the old file has the hash `expected`. Returns NULL on success,
 * otherwise the reason: LIVE_NEWER if another program has changed the file. */
extern const char LIVE_NEWER[];
const char *live_file_write(const char *path, const char *text, size_t length, uint64_t expected);

#endif
