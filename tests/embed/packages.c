/* Tests that a host imports a package of `vs add`: packages FOLDER, the folder that has .vs. Prints the box's size. */
#include <stdio.h>
#include <string.h>
#include <visualscheme.h>

static void diagnose(void *context, const vs_diagnostic *d) {
  (void)context;
  printf("not ok embed:packages, C: %s\n", d->message);
}

int main(int argc, char **argv) {
  static const char program[] = "(import (visualscheme) (towers spire))\n(draw (spire 2))\n";
  char path[4096];
  vs_summary s;
  snprintf(path, sizeof path, "%s/.vs", argc > 1 ? argv[1] : ".");
  vs_options o = { .library_path = path, .host = { .diagnose = diagnose } };
  vs_scheme *scheme = vs_new(&o);
  if (!scheme || vs_eval_text(scheme, "host", 1, program, strlen(program), VS_EVAL_PROGRAM) != VS_OUTCOME_DONE) return 1;
  if (vs_drawing_summary(scheme, &s) != VS_OUTCOME_DONE) return 1;
  bool same = s.has_bounds && s.max[0] - s.min[0] == 1 && s.max[2] - s.min[2] == 6;
  printf("%s embed:packages, C\n", same ? "ok" : "not ok");
  vs_free(scheme);
  return 0;
}
