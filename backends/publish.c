/* Implements files that appear completely or not at all, in two ways. If the system allows it (O_TMPFILE of Linux), the
 * file has no name until it is complete. Otherwise the file is NAME.tmp-PID beside its target. A file without a name
 * leaves nothing on disk even if the process is killed. */
#define _GNU_SOURCE /* declares O_TMPFILE */
#include "backends/publish.h"
#include "model/signals.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { NUMBER_ROOM = 40 };

#ifdef O_TMPFILE
static void link_name(int file, char name[NUMBER_ROOM]) { snprintf(name, NUMBER_ROOM, "/proc/self/fd/%d", file); }

/* Opens a file without a name in the target's folder. Returns -1 if the file system cannot do this, or the system has
 * no /proc. */
static int open_nameless(const char *target) {
  char name[NUMBER_ROOM], *folder = strdup(target), *slash = folder ? strrchr(folder, '/') : NULL;
  if (!folder) return -1;
  if (slash) slash[slash == folder] = 0;
  int file = open(slash ? folder : ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  free(folder);
  if (file < 0) return -1;
  link_name(file, name);
  if (access(name, F_OK) == 0) return file;
  close(file);
  return -1;
}

/* Gives the nameless file a name: the target's name if no file has it, otherwise p->name. Sets *done to true if the
 * file now has the target's name. */
static bool give_name(vs_publish *p, bool *done) {
  char from[NUMBER_ROOM];
  link_name(p->file, from);
  *done = linkat(AT_FDCWD, from, AT_FDCWD, p->target, AT_SYMLINK_FOLLOW) == 0;
  if (*done || errno != EEXIST) return *done;
  if (linkat(AT_FDCWD, from, AT_FDCWD, p->name, AT_SYMLINK_FOLLOW) == 0) return true;
  if (errno != EEXIST || unlink(p->name) != 0) return false; /* a file with the name p->name was left by a killed
                                                              * process that had the same process number */
  return linkat(AT_FDCWD, from, AT_FDCWD, p->name, AT_SYMLINK_FOLLOW) == 0;
}
#else
static int open_nameless(const char *target) { return (void)target, -1; }
static bool give_name(vs_publish *p, bool *done) { return (void)p, *done = false; }
#endif

/* Returns the end of the chain of symbolic links at path. The export replaces the file at the end, and the links
 * remain. The file need not exist. The caller frees the text. Returns NULL on failure, with the reason in errno. */
static char *end_of_links(const char *path) {
  enum { LINKS_MOST = 40 };
  char *at = strdup(path);
  for (int links = 0; at; links++) {
    char to[4096];
    ssize_t length = readlink(at, to, sizeof to - 1);
    if (length < 0) return at; /* `at` is not a symbolic link, so it is the end of the chain */
    const char *slash = strrchr(at, '/');
    size_t folder = slash && to[0] != '/' ? (size_t)(slash + 1 - at) : 0;
    bool good = links < LINKS_MOST && (size_t)length < sizeof to - 1;
    char *next = NULL;
    int problem = links == LINKS_MOST ? ELOOP : good ? ENOMEM : ENAMETOOLONG;
    if (good && asprintf(&next, "%.*s%.*s", (int)folder, at, (int)length, to) < 0) next = NULL;
    free(at);
    at = next;
    if (!at) errno = problem;
  }
  return NULL;
}

/* Returns the name NAME.tmp-PID. A name that would be too long is shortened, and a hash distinguishes it from other
 * shortened names. */
static char *name_beside(const char *target) {
  enum { NAME_MOST = 255, CUT = 160 };
  const char *slash = strrchr(target, '/'), *base = slash ? slash + 1 : target;
  char *name = NULL;
  if (strlen(base) + NUMBER_ROOM <= NAME_MOST)
    return asprintf(&name, "%s.tmp-%ld", target, (long)getpid()) < 0 ? NULL : name;
  size_t kept = CUT;
  while (kept > 0 && ((unsigned char)base[kept] & 0xC0) == 0x80) kept--; /* does not divide a character of UTF-8 */
  uint32_t hash = 2166136261u;
  for (const char *c = base; *c; c++) hash = (hash ^ (unsigned char)*c) * 16777619u;
  int length = asprintf(&name, "%.*s-%08" PRIx32 ".tmp-%ld", (int)((size_t)(base - target) + kept), target, hash,
                        (long)getpid());
  return length < 0 ? NULL : name;
}

void vs_publish_clear(const char *folder) {
  DIR *d = opendir(folder);
  const struct dirent *entry;
  while (d && (entry = readdir(d)) != NULL)
    if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) unlinkat(dirfd(d), entry->d_name, 0);
  if (d) closedir(d);
  rmdir(folder);
}

enum { YOUNG = 10 /* age in seconds up to which a file counts as new, and is not removed */ };

/* Removes the temporary file `name` in the folder if the process that created it has ended. */
static void sweep_one(DIR *d, const char *folder, const char *name) {
  char path[4096];
  struct stat is;
  int n = snprintf(path, sizeof path, "%s/%s", folder, name);
  int file = openat(dirfd(d), name, O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return;
  bool ours = fstat(file, &is) == 0 && is.st_uid == geteuid() && time(NULL) - is.st_mtime > YOUNG &&
              (S_ISREG(is.st_mode) || S_ISDIR(is.st_mode)) && flock(file, LOCK_EX | LOCK_NB) == 0;
  if (ours && S_ISREG(is.st_mode)) unlinkat(dirfd(d), name, 0);
  else if (ours && n > 0 && n < (int)sizeof path) vs_publish_clear(path);
  close(file);
}

void vs_publish_sweep(const char *folder, const char *beginning, const char *end) {
  DIR *d = opendir(folder);
  const struct dirent *entry;
  while (d && (entry = readdir(d)) != NULL)
    if (!strncmp(entry->d_name, beginning, strlen(beginning))) {
      const char *rest = entry->d_name + strlen(beginning);
      if (*rest && !rest[strspn(rest, end)]) sweep_one(d, folder, entry->d_name);
    }
  if (d) closedir(d);
}

/* Removes the files NAME.tmp-PID that killed processes left beside the same target. */
static void sweep_siblings(const vs_publish *p) {
  const char *slash = strrchr(p->name, '/'), *base = slash ? slash + 1 : p->name;
  char *folder = slash ? strndup(p->name, (size_t)(slash - p->name) + 1) : strdup(".");
  char *beginning = strndup(base, (size_t)(strrchr(base, '-') + 1 - base));
  if (folder && beginning) vs_publish_sweep(folder, beginning, "0123456789");
  free(folder), free(beginning);
}

bool vs_publish_begin(vs_publish *p, const char *path, bool named) {
  *p = (vs_publish){ .file = -1, .target = end_of_links(path) };
  if (p->target && !(p->name = name_beside(p->target))) errno = ENOMEM;
  if (p->target && p->name) {
    p->file = named ? -1 : open_nameless(p->target);
    p->nameless = p->file >= 0;
    if (!p->nameless) {
      sweep_siblings(p);
      p->file = open(p->name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (p->file >= 0) flock(p->file, LOCK_EX | LOCK_NB);
    }
  }
  if (p->file >= 0) return true;
  int problem = errno;
  free(p->target), free(p->name);
  *p = (vs_publish){ .file = -1 };
  errno = problem;
  return false;
}

/* Gives a nameless file the name p->name, and renames it at once to the target. If the process is killed between the
 * two calls, p->name remains. Returns 0, or the errno of the call that failed. */
static int place_nameless(vs_publish *p) {
  bool done = false;
  if (!give_name(p, &done)) return errno;
  if (done || rename(p->name, p->target) == 0) return 0;
  int problem = errno;
  unlink(p->name);
  return problem;
}

bool vs_publish_end(vs_publish *p, bool whole) {
  int problem = 0;
  sigset_t was;
  vs_signals_hold(&was); /* blocks signals, so that none can end the process between naming and renaming */
  if (whole && p->nameless) problem = place_nameless(p);
  if (close(p->file) != 0 && !problem) problem = errno;
  if (!p->nameless && whole && !problem && rename(p->name, p->target) != 0) problem = errno;
  if (!p->nameless && (!whole || problem)) unlink(p->name);
  vs_signals_release(&was);
  free(p->target), free(p->name);
  *p = (vs_publish){ .file = -1 };
  errno = problem;
  return problem == 0;
}
