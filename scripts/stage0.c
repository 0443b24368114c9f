/* Makes the heap image: `stage0 IMAGE SOURCE...` opens an interpreter without an image, loads the library's sources
 * into it in order and writes the resulting heap as 64-bit words. Part of the build, not of the program. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bind/records.h"
#include "bind/scene/node_natives.h"
#include "vm/machine/image.h"
#include "vm/values/printer.h"
#include "vm/machine/program.h"
#include "vm/machine/open_vm.h"

static char *read_file(const char *path, size_t *size) {
  FILE *f = fopen(path, "rb");
  char *text = NULL;
  size_t room = 1 << 16, n;
  *size = 0;
  if (!f || !(text = malloc(room))) return NULL;
  while ((n = fread(text + *size, 1, room - *size, f)) > 0)
    if ((*size += n) == room && !(text = realloc(text, room *= 2))) return NULL;
  fclose(f);
  return text;
}

static bool put(void *to, const uint64_t *words, size_t count) { return fwrite(words, 8, count, to) == count; }

static int failed(vs_scheme *vm, const char *what) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  if (vs_is(vm->condition, VS_T_CONDITION)) {
    const vs_condition *c = vs_as_condition(vm->condition);
    vs_pos at = c->place;
    fprintf(stderr, "stage0: %s:%u:%u: ", what, vs_pos_line(at), vs_pos_col(at));
    if (vs_print(vm, c->message, VS_PRINT_DISPLAY, &t) && vs_text_puts(&t, " ") &&
        vs_print(vm, vs_as_condition(vm->condition)->irritants, VS_PRINT_WRITE, &t) && vs_text_end(&t))
      fputs(t.at, stderr);
  } else fprintf(stderr, "stage0: %s: failed", what);
  fputc('\n', stderr);
  vs_text_close(&t);
  return 1;
}

int main(int argc, char **argv) {
  vs_config config = { .tables = vs_nodes_tables() };
  vs_scheme *vm = vs_open_vm(&config);
  vs_flat_rules *rules = calloc(1, sizeof *rules);
  if (argc < 3 || !vm || !rules) {
    fprintf(stderr, argc < 3 ? "usage: stage0 IMAGE SOURCE...\n" : "stage0: out of memory\n");
    return 2;
  }
  vs_bind_flat_rules(rules);
  if (!vs_flat_register(vm, rules) || !vs_front_open(vm)) return failed(vm, "natives");
  for (int i = 2; i < argc; i++) {
    size_t size;
    char *text = read_file(argv[i], &size);
    const char *name = strrchr(argv[i], '/');
    if (!text) return fprintf(stderr, "stage0: cannot read %s\n", argv[i]), 1;
    if (!vs_library_load(vm, name ? name + 1 : argv[i], text, size)) return failed(vm, argv[i]);
    free(text);
  }
  vs_library_done(vm);
  FILE *f = fopen(argv[1], "wb");
  if (!f) return fprintf(stderr, "stage0: cannot write %s\n", argv[1]), 1;
  if (!vs_image_write(vm, put, f)) return failed(vm, argv[1]);
  if (fclose(f) != 0) return fprintf(stderr, "stage0: cannot write %s\n", argv[1]), 1;
  free(rules);
  vs_close_vm(vm);
  return 0;
}
