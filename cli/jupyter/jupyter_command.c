/* Implements `vs jupyter`. */
#include "cli/jupyter/jupyter_command.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/json.h"
#include "cli/jupyter/kernel.h"

enum { PATH = 4096 };

/* Makes the folder and those around it. */
static bool make_folders(char *path) {
  for (char *at = strchr(path + 1, '/'); at; at = strchr(at + 1, '/')) {
    *at = 0;
    bool ok = mkdir(path, 0777) == 0 || errno == EEXIST;
    *at = '/';
    if (!ok) return false;
  }
  return mkdir(path, 0777) == 0 || errno == EEXIST;
}

static bool find_folder(char path[PATH]) {
  const char *own = getenv("JUPYTER_DATA_DIR"), *data = getenv("XDG_DATA_HOME"), *home = getenv("HOME");
  int n = own && *own     ? snprintf(path, PATH, "%s/kernels/visualscheme", own)
          : data && *data ? snprintf(path, PATH, "%s/jupyter/kernels/visualscheme", data)
                          : snprintf(path, PATH, "%s/.local/share/jupyter/kernels/visualscheme", home ? home : "");
  return n > 0 && n < PATH - 40;
}

static vs_outcome describe(void) {
  char folder[PATH], file[PATH + 20], program[PATH];
  ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
  snprintf(program + (n > 0 ? n : 0), 3, "%s", n > 0 ? "" : "vs");
  FILE *to = NULL;
  bool ok = find_folder(folder) && make_folders(folder);
  if (ok) snprintf(file, sizeof file, "%s/kernel.json", folder), to = fopen(file, "wb");
  if (to) {
    fputs("{\"argv\": [", to);
    cli_json_text(to, program);
    fputs(", \"jupyter\", \"{connection_file}\"], \"display_name\": \"VisualScheme\", \"language\": \"scheme\", "
          "\"interrupt_mode\": \"signal\"}\n", to);
    ok = !ferror(to);
    ok = fclose(to) == 0 && ok;
  }
  if (to && ok) return printf("%s\n", file), VS_OUTCOME_DONE;
  fprintf(stderr, "vs jupyter: %s: %s\n", folder, strerror(errno));
  return VS_OUTCOME_USAGE;
}

vs_outcome cli_jupyter_command(const cli_options *o, const volatile sig_atomic_t *interrupts,
                               const volatile sig_atomic_t *ended) {
  return o->source_count ? kernel_run(o, o->sources[0].text, interrupts, ended) : describe();
}
