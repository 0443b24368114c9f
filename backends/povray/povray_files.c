/* Writes references to files in a scene: pictures on surfaces and skies.
 *
 * A rendered scene refers to copies in the worker's private folder, so that POV-Ray needs no other part of the disk. A
 * .pov refers to the program's own files. Names are absolute, because POV-Ray searches in the folder in which it
 * starts. In POV-Ray's strings, quotes and backslashes are escaped. */
#define _XOPEN_SOURCE 700 /* declares realpath */
#include "backends/povray/povray_files.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void put_string(vs_writer *w, const char *text) {
  vs_puts(w, "\"");
  for (const char *c = text; *c != '\0'; c++) {
    if (*c == '"' || *c == '\\') vs_puts(w, "\\");
    if ((unsigned char)*c >= ' ') vs_put(w, c, 1);
  }
  vs_puts(w, "\"");
}

static bool write_all(const char *path, const unsigned char *bytes, size_t size) {
  int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
  size_t sent = 0;
  while (file >= 0 && sent < size) {
    ssize_t part = write(file, bytes + sent, size - sent);
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) break;
    sent += (size_t)part;
  }
  bool ok = file >= 0 && sent == size;
  return file >= 0 && close(file) != 0 ? false : ok;
}

/* Writes the bytes into a file with this name in the worker's folder. Writes the file's full name into the scene as a
 * string. */
static bool put_own_file(vs_emitter *e, const char *name, const unsigned char *bytes, size_t size) {
  size_t room = strlen(e->folder) + strlen(name) + 2;
  char *path = vs_store_realloc(e->scene->store, NULL, 0, room);
  if (path == NULL) return vs_emit_no_memory(e);
  snprintf(path, room, "%s/%s", e->folder, name);
  bool ok = write_all(path, bytes, size) ||
            vs_error_set(e->error, VS_ERROR_FILE, NULL, "cannot write %s: %s", path, strerror(errno));
  put_string(e->out, path);
  vs_store_realloc(e->scene->store, path, room, 0);
  return ok;
}

bool vs_povray_put_picture(vs_emitter *e, const vs_picture *p, size_t number) {
  char name[48];
  vs_puts(e->out, p->format);
  vs_puts(e->out, " ");
  if (e->folder != NULL) {
    snprintf(name, sizeof name, "picture%zu.%s", number, p->format);
    return put_own_file(e, name, p->bytes, p->size);
  }
  char *whole = realpath(p->path, NULL);
  put_string(e->out, whole != NULL ? whole : p->path);
  /* the comment contains the hash of the picture, so that the text of the scene changes with the picture's contents */
  vs_putf(e->out, " /* %016llx */", (unsigned long long)p->hash);
  free(whole);
  return true;
}
