/* Prints the names that are defined when a program begins, one on a line, in the form in which the prompt completes
 * them. A test compares them with the names that the manual's reference describes. */
#include "visualscheme.h"

#include <stdio.h>
#include <stdlib.h>

static bool print_name(void *context, const char *name) {
  return name[0] == '%' || fprintf(context, "%s\n", name) > 0;
}

int main(void) {
  vs_options options = vs_options_default();
  vs_scheme *scheme = vs_new(&options);
  if (!scheme) return EXIT_FAILURE;
  size_t count = vs_complete(scheme, "", print_name, stdout);
  vs_free(scheme);
  return count && !fflush(stdout) ? EXIT_SUCCESS : EXIT_FAILURE;
}
