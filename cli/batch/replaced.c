/* Keeps the files that frames replace, until the last frame shows that none of them is an input.
 *
 * Which files a frame reads is unknown before it runs, and earlier frames are written by then. A replaced file is kept
 * as NAME.old-PID, by a second link where the file system has links: this costs neither time nor space. */
#define _GNU_SOURCE
#include "cli/batch/replaced.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "model/store/array.h"

bool cli_replaced_keep(cli_replaced *r, const char *path) {
  struct stat is;
  cli_replaced_file one = { 0 };
  if (stat(path, &is) != 0 || !S_ISREG(is.st_mode)) return true;
  one.path = realpath(path, NULL);
  for (size_t i = 0; one.path && i < r->count; i++)
    if (!strcmp(r->at[i].path, one.path)) return free(one.path), true;
  bool ok = one.path && asprintf(&one.old, "%s.old-%ld", one.path, (long)getpid()) >= 0;
  if (ok && !VS_GROW(r->at, r->room, r->count + 1)) ok = false, errno = ENOMEM;
  ok = ok && (link(one.path, one.old) == 0 || (errno != EEXIST && rename(one.path, one.old) == 0));
  if (ok) r->at[r->count++] = one;
  else free(one.path), free(one.old);
  return ok;
}

bool cli_replaced_unread(cli_replaced *r, const vs_scheme *s, long frame) {
  bool unread = true;
  for (size_t i = 0; i < r->count; i++) {
    cli_replaced_file *f = &r->at[i];
    if (!f->old || !vs_is_input(s, f->path)) continue;
    unread = false;
    if (rename(f->old, f->path) == 0)
      fprintf(stderr, "vs: %s: frame %ld reads this file, which an earlier frame had replaced; the old file is back: "
              "delete it, or name other outputs by -o\n", f->path, frame);
    else
      fprintf(stderr, "vs: %s: frame %ld reads this file, which an earlier frame has replaced; %s is the old file\n",
              f->path, frame, f->old);
    free(f->old);
    f->old = NULL;
  }
  return unread;
}

void cli_replaced_end(cli_replaced *r) {
  for (size_t i = 0; i < r->count; i++) {
    if (r->at[i].old && access(r->at[i].path, F_OK) == 0) unlink(r->at[i].old);
    else if (r->at[i].old) rename(r->at[i].old, r->at[i].path); /* the output failed, and the file was moved away */
    free(r->at[i].path);
    free(r->at[i].old);
  }
  free(r->at);
  *r = (cli_replaced){ 0 };
}
