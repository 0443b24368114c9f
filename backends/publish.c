/* Owns the two ways to make a file that appears whole: without a name until it is complete, where the system can do
 * that (Linux' O_TMPFILE), else as NAME.tmp-PID beside its target. Without a name nothing is left behind even when the
 * process is killed. */
#define _GNU_SOURCE /* O_TMPFILE */
#include "backends/publish.h"
#include "model/signals.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { NUMBER_ROOM = 40 };

#ifdef O_TMPFILE
static void link_name(int file, char name[NUMBER_ROOM]) { snprintf(name, NUMBER_ROOM, "/proc/self/fd/%d", file); }

/* Opens a file without a name in the target's folder; -1: the file system, or a system without /proc, has no such
 * thing. */
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

/* Gives the file a name: the target's where nothing stands there, else p->name. */
static bool give_name(vs_publish *p, bool *done) {
  char from[NUMBER_ROOM];
  link_name(p->file, from);
  *done = linkat(AT_FDCWD, from, AT_FDCWD, p->target, AT_SYMLINK_FOLLOW) == 0;
  if (*done || errno != EEXIST) return *done;
  if (linkat(AT_FDCWD, from, AT_FDCWD, p->name, AT_SYMLINK_FOLLOW) == 0) return true;
  if (errno != EEXIST || unlink(p->name) != 0) return false; /* of a process with our number that was killed */
  return linkat(AT_FDCWD, from, AT_FDCWD, p->name, AT_SYMLINK_FOLLOW) == 0;
}
#else
static int open_nameless(const char *target) { return (void)target, -1; }
static bool give_name(vs_publish *p, bool *done) { return (void)p, *done = false; }
#endif

bool vs_publish_begin(vs_publish *p, const char *target, bool named) {
  size_t room = strlen(target) + NUMBER_ROOM;
  *p = (vs_publish){ .file = -1, .target = strdup(target), .name = malloc(room) };
  if (p->target && p->name) {
    snprintf(p->name, room, "%s.tmp-%ld", target, (long)getpid());
    p->file = named ? -1 : open_nameless(target);
    p->nameless = p->file >= 0;
    if (p->file < 0) p->file = open(p->name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  } else errno = ENOMEM;
  if (p->file >= 0) return true;
  int problem = errno;
  free(p->target), free(p->name);
  *p = (vs_publish){ .file = -1 };
  errno = problem;
  return false;
}

/* Of a file without a name: it gets one, and the target's at once after it, so that a process that is killed in between
 * hardly ever leaves the first. Returns 0, or the errno of what failed. Such files are local: closing them later tells
 * nothing new. */
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
  vs_signals_hold(&was); /* nothing ends the process between the name and its change */
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
