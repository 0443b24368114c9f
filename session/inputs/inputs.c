/* Keeps the list of files that a session has read, since no output may overwrite them.
 *
 * A file is identified by device and inode, so that links and other spellings of its name count as the same file. It is
 * also identified by its name, because an editor that saves a file creates a new one of that name. A file that the
 * program has created is no input: the program may read it and overwrite it. */

#include "session/inputs/inputs.h"

#include <string.h>
#include <sys/stat.h>

#include "session/host.h"

static bool is_file(const vs_known_file *f, const struct stat *is) {
  return f->device == (uint64_t)is->st_dev && f->node == (uint64_t)is->st_ino;
}

static bool note(vs_session *s, const char *path, const struct stat *is, bool made) {
  if (!S_ISREG(is->st_mode)) return true;
  for (size_t i = 0; i < s->input_count; i++)
    if (is_file(&s->inputs[i], is) && (s->inputs[i].made || !strcmp(s->inputs[i].path, path))) return true;
  if (s->input_count == s->input_room) {
    size_t more = s->input_room ? 2 * s->input_room : 8;
    vs_known_file *grown = vs_session_memory(s, s->inputs, s->input_room * sizeof *grown, more * sizeof *grown);
    if (!grown) return false;
    s->inputs = grown, s->input_room = more;
  }
  size_t bytes = strlen(path) + 1;
  vs_known_file fresh = { .device = (uint64_t)is->st_dev, .node = (uint64_t)is->st_ino, .made = made,
                     .path = vs_session_memory(s, NULL, 0, bytes) };
  if (!fresh.path) return false;
  memcpy(fresh.path, path, bytes);
  s->inputs[s->input_count++] = fresh;
  return true;
}

bool vs_session_note(vs_session *s, const char *path, int file, bool made) {
  struct stat is;
  return fstat(file, &is) != 0 || note(s, path, &is, made);
}

bool vs_session_note_path(vs_session *s, const char *path) {
  struct stat is;
  return stat(path, &is) != 0 || note(s, path, &is, false);
}

bool vs_session_is_input(const vs_session *s, const char *path) {
  struct stat is, now;
  if (!path || stat(path, &is) != 0) return false;
  bool found = false;
  for (size_t i = 0; i < s->input_count; i++) {
    const vs_known_file *in = &s->inputs[i];
    bool same = is_file(in, &is);
    if (same && in->made) return false;
    found = found || same || (!in->made && stat(in->path, &now) == 0 && now.st_dev == is.st_dev &&
                              now.st_ino == is.st_ino);
  }
  return found;
}

const char *vs_session_input(const vs_session *s, size_t index) {
  for (size_t i = 0; i < s->input_count; i++)
    if (!s->inputs[i].made && index-- == 0) return s->inputs[i].path;
  return NULL;
}

void vs_session_free_inputs(vs_session *s) {
  for (size_t i = 0; i < s->input_count; i++)
    vs_session_memory(s, s->inputs[i].path, strlen(s->inputs[i].path) + 1, 0);
  vs_session_memory(s, s->inputs, s->input_room * sizeof *s->inputs, 0);
  s->inputs = NULL, s->input_count = s->input_room = 0;
}
