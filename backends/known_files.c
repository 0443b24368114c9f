/* Implements the list of the files that a run has read. No output may overwrite these files.
 *
 * A file is identified by device and inode, so that links and other spellings of its name count as the same file. It is
 * also identified by its name, because an editor that saves a file creates a new file of that name. A file that the
 * program has created is not an input: the program may read it and overwrite it. */
#define _POSIX_C_SOURCE 200809L
#include "backends/known_files.h"

#include <string.h>
#include <sys/stat.h>

static bool is_file(const vs_known_file *f, const struct stat *is) {
  return f->device == (uint64_t)is->st_dev && f->node == (uint64_t)is->st_ino;
}

static bool add(vs_known_files *l, const char *path, const struct stat *is, bool made) {
  if (!S_ISREG(is->st_mode)) return true;
  for (size_t i = 0; i < l->count; i++)
    if (is_file(&l->at[i], is) && (l->at[i].made || !strcmp(l->at[i].path, path))) return true;
  if (l->count == l->room) {
    size_t more = l->room ? 2 * l->room : 8;
    vs_known_file *grown = l->memory(l->context, l->at, l->room * sizeof *grown, more * sizeof *grown);
    if (!grown) return false;
    l->at = grown, l->room = more;
  }
  size_t bytes = strlen(path) + 1;
  vs_known_file fresh = { .device = (uint64_t)is->st_dev, .node = (uint64_t)is->st_ino, .made = made,
                          .path = l->memory(l->context, NULL, 0, bytes) };
  if (!fresh.path) return false;
  memcpy(fresh.path, path, bytes);
  l->at[l->count++] = fresh;
  return true;
}

bool vs_known_files_add(vs_known_files *l, const char *path, int file, bool made) {
  struct stat is;
  return fstat(file, &is) != 0 || add(l, path, &is, made);
}

bool vs_known_files_add_path(vs_known_files *l, const char *path) {
  struct stat is;
  return stat(path, &is) != 0 || add(l, path, &is, false);
}

bool vs_known_files_read(const vs_known_files *l, const char *path) {
  struct stat is, now;
  if (!l || !path || stat(path, &is) != 0) return false;
  bool found = false;
  for (size_t i = 0; i < l->count; i++) {
    const vs_known_file *in = &l->at[i];
    bool same = is_file(in, &is);
    if (same && in->made) return false;
    found = found || same || (!in->made && stat(in->path, &now) == 0 && now.st_dev == is.st_dev &&
                              now.st_ino == is.st_ino);
  }
  return found;
}

const char *vs_known_files_name(const vs_known_files *l, size_t index) {
  for (size_t i = 0; i < l->count; i++)
    if (!l->at[i].made && index-- == 0) return l->at[i].path;
  return NULL;
}

void vs_known_files_free(vs_known_files *l) {
  for (size_t i = 0; i < l->count; i++) l->memory(l->context, l->at[i].path, strlen(l->at[i].path) + 1, 0);
  l->memory(l->context, l->at, l->room * sizeof *l->at, 0);
  l->at = NULL, l->count = l->room = 0;
}
