/* Contains the table of the target languages. */
#include "languages/targets/target_table.h"

#include <stddef.h>
#include <string.h>

#include "languages/targets/to_javascript.h"
#include "languages/targets/to_openscad.h"
#include "languages/targets/to_povray.h"
#include "languages/targets/script_to_javascript.h"

static const tr_target targets[] = {
#define TR_TARGET(...) {__VA_ARGS__},
#include "languages/targets/translate_targets.def"
};
enum { TARGETS = sizeof targets / sizeof *targets };

const tr_target *tr_target_named(const char *name) {
  for (size_t i = 0; i < TARGETS; i++)
    if (!strcmp(targets[i].name, name)) return &targets[i];
  return NULL;
}

const tr_target *tr_target_of_file(const char *path) {
  const char *dot = strrchr(path, '.');
  for (size_t i = 0; dot && i < TARGETS; i++)
    if (!strcmp(targets[i].ending, dot)) return &targets[i];
  return NULL;
}
