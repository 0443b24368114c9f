/* Reads, watches and writes the model's files. See model_files.h. Checking a few files costs a microsecond each, so the
 * session checks them about twenty times a second. Notification by the system would not suffice: editors save by
 * renaming or by writing twice, and some file systems send no events. */
#define _XOPEN_SOURCE 700 /* for realpath */
#include "live/model_files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

const char LIVE_NEWER[] = "the file has changed on disk since it was read here";
enum { MOST_BYTES = 256 << 20 };
/* Times in milliseconds. A file's recorded time of change is late by at most ten milliseconds, a tick of the system's
 * clock. If a file has been unchanged for SETTLE, every later change has a different time and is detected. */
enum { SETTLE = 12, SETTLE_EMPTY = 500, SETTLE_MOST = 700, SETTLE_LOOK = 2 };

bool live_file_read(const char *path, char **text, size_t *length, const char **why) {
  struct stat s;
  int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    *why = errno == ENOENT ? "no such file" : errno == EACCES ? "permission denied" : "it cannot be opened";
    return false;
  }
  if (fstat(file, &s) != 0 || !S_ISREG(s.st_mode) || s.st_size > MOST_BYTES) {
    *why = S_ISDIR(s.st_mode)       ? "it is a folder"
           : s.st_size > MOST_BYTES ? "it is too large"
                                    : "this is no ordinary file";
    close(file);
    return false;
  }
  size_t room = (size_t)s.st_size + 1, used = 0;
  char *at = malloc(room);
  bool ok = at != NULL;
  *why = "out of memory";
  while (ok) {
    ssize_t got = read(file, at + used, room - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      *why = "it cannot be read";
      ok = false;
    }
    if (got <= 0) break;
    used += (size_t)got;
    if (used < room) continue;
    char *more = room < MOST_BYTES ? realloc(at, room * 2) : NULL;
    ok = more != NULL;
    if (ok) at = more, room *= 2;
  }
  close(file);
  if (!ok) {
    free(at);
    return false;
  }
  at[used] = 0;
  *text = at;
  *length = used;
  return true;
}

bool live_folder_list(const char *path, bool (*take)(void *to, const char *name, size_t length), void *to,
                      const char **why) {
  DIR *folder = opendir(*path ? path : ".");
  if (folder == NULL) {
    *why = errno == ENOENT ? "no such folder" : "it cannot be opened";
    return false;
  }
  bool ok = true;
  for (const struct dirent *entry; ok && (entry = readdir(folder)) != NULL;)
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
      ok = take(to, entry->d_name, strlen(entry->d_name));
  closedir(folder);
  return ok;
}

static live_file file_now(const char *path) {
  struct stat s;
  live_file f = { .there = stat(path, &s) == 0 };
  if (f.there)
    f.device = s.st_dev, f.inode = s.st_ino, f.size = s.st_size, f.seconds = s.st_mtim.tv_sec,
    f.nanoseconds = s.st_mtim.tv_nsec;
  return f;
}

/* Returns the milliseconds since the file's last change. */
static double file_age(const live_file *f) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  return 1e3 * difftime(now.tv_sec, (time_t)f->seconds) + 1e-6 * (double)(now.tv_nsec - f->nanoseconds);
}

bool live_files_note(live_files *f, const char *path) {
  for (size_t i = 0; i < f->count; i++)
    if (strcmp(f->at[i].path, path) == 0) return true; /* if the file is already recorded, keeps the state recorded at
                                                        * its first read */
  if (f->count == f->room) {
    size_t room = f->room * 2 + 16;
    live_file *grown = realloc(f->at, room * sizeof *grown);
    if (grown == NULL) return false;
    f->at = grown;
    f->room = room;
  }
  live_file now = file_now(path);
  now.path = strdup(path);
  if (now.path == NULL) return false;
  now.young = now.there && file_age(&now) < SETTLE;
  f->at[f->count++] = now;
  return true;
}

static bool is_another(const live_file *a, const live_file *b) {
  return a->there != b->there || a->device != b->device || a->inode != b->inode || a->size != b->size ||
         a->seconds != b->seconds || a->nanoseconds != b->nanoseconds;
}

bool live_files_newer(const live_files *f) {
  for (size_t i = 0; i < f->count; i++) {
    live_file now = file_now(f->at[i].path);
    if (is_another(&now, &f->at[i])) return true;
  }
  return false;
}

bool live_files_changed(const live_files *f) {
  for (size_t i = 0; i < f->count; i++) {
    const live_file *was = &f->at[i];
    live_file now = file_now(was->path);
    if (is_another(&now, was)) return true;
    double age = file_age(&now);
    if (was->young && age > SETTLE) return true; /* a file that changed just before it was read is read once more when
                                                  * it is older than SETTLE */
    /* the file was empty when it was read: an editor is probably writing it */
    if (was->there && was->size == 0 && age >= 0 && age < SETTLE_EMPTY) return true;
  }
  return false;
}

void live_files_settle(const live_files *f) {
  for (int waited = 0; waited < SETTLE_MOST; waited += SETTLE_LOOK) {
    struct timespec pause = { .tv_nsec = SETTLE_LOOK * 1000000L };
    double youngest = SETTLE_MOST;
    bool empty = false;
    for (size_t i = 0; i < f->count; i++) {
      live_file file = file_now(f->at[i].path);
      double age = file_age(&file);
      if (file.there && age >= 0 && age < youngest) youngest = age, empty = file.size == 0;
    }
    if (youngest > (empty ? SETTLE_EMPTY : SETTLE)) return;
    nanosleep(&pause, NULL);
  }
}

void live_files_clear(live_files *f) {
  for (size_t i = 0; i < f->count; i++) free(f->at[i].path);
  free(f->at);
  *f = (live_files){ NULL, 0, 0 };
}

uint64_t live_file_hash(const char *text, size_t length) { /* the hash FNV-1a */
  uint64_t h = 0xcbf29ce484222325u;
  for (size_t i = 0; i < length; i++) h = (h ^ (unsigned char)text[i]) * 0x100000001b3u;
  return h;
}

const char *live_file_write(const char *path, const char *text, size_t length, uint64_t expected) {
  char *now = NULL, *real = realpath(path, NULL); /* real: path without symbolic links, so that the target of a
                                                   * link is written, and the link remains */
  const char *why = "out of memory";
  size_t now_length;
  if (real == NULL) return "the file is gone";
  size_t room = strlen(real) + 32;
  char *temporary = malloc(room);
  int file = -1;
  if (temporary == NULL || !live_file_read(real, &now, &now_length, &why)) goto done;
  why = LIVE_NEWER;
  if (live_file_hash(now, now_length) != expected) goto done;
  struct stat s;
  snprintf(temporary, room, "%s.tmp-%ld", real, (long)getpid());
  why = "it cannot be written";
  file = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) goto done;
  bool ok = stat(real, &s) == 0 && fchmod(file, s.st_mode & 07777) == 0;
  for (size_t at = 0; ok && at < length;) {
    ssize_t put = write(file, text + at, length - at);
    if (put < 0 && errno == EINTR) continue;
    ok = put > 0;
    if (ok) at += (size_t)put;
  }
  ok = ok && fsync(file) == 0;
  ok = close(file) == 0 && ok && rename(temporary, real) == 0;
  if (ok) why = NULL;
  else unlink(temporary);
done:
  free(now);
  free(real);
  free(temporary);
  return why;
}
