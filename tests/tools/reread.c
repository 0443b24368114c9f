/* Tests the round trip of a tree dump: `reread FILE.tree` reads the drawing and writes it again. Exits with 0 if both
 * texts are equal, which means that the trees are equal. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backends/export.h"
#include "backends/tree/tree_reader.h"

typedef struct { char *at; size_t used, room; } buffer;

static bool append(void *to, const void *bytes, size_t count) {
  buffer *b = to;
  if (b->used + count > b->room) {
    char *more = realloc(b->at, b->room = 2 * (b->used + count));
    if (!more) return false;
    b->at = more;
  }
  memcpy(b->at + b->used, bytes, count);
  b->used += count;
  return true;
}

int main(int argc, char **argv) {
  buffer text = {0}, again = {0};
  FILE *f = argc == 2 ? fopen(argv[1], "rb") : NULL;
  char part[4096];
  size_t got;
  while (f && (got = fread(part, 1, sizeof part, f)) > 0) append(&text, part, got);
  if (f) fclose(f);
  if (!text.at) return fprintf(stderr, "reread: cannot read\n"), 2;
  vs_store *store = vs_store_new(NULL, NULL);
  vs_scene scene;
  vs_error e = {VS_ERROR_NONE, NULL, ""};
  vs_export_options options;
  vs_export_options_init(&options);
  vs_scene_init(&scene, store);
  bool good = vs_tree_read(&scene, text.at, text.used, &e) && vs_export_to(&scene, vs_export_format_find("tree"), append, &again, &options, &e);
  if (!good) fprintf(stderr, "reread: %s\n", e.message);
  else if (!(good = again.used == text.used && memcmp(again.at, text.at, text.used) == 0)) {
    size_t same = 0, line = 1;
    while (same < again.used && same < text.used && again.at[same] == text.at[same]) line += text.at[same++] == '\n';
    fprintf(stderr, "reread: line %zu comes back as another: %.*s\n", line, (int)(again.used - same < 80 ? again.used - same : 80), again.at + same);
  }
  vs_scene_free(&scene);
  vs_store_release(store);
  free(text.at), free(again.at);
  return !good;
}
