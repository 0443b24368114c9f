/* Implements the option -d: a rule for make. */
#include "cli/dependencies.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli/batch/whole_file.h"
#include "model/store/array.h"

bool cli_dependencies_add(cli_session *c, const char *output) {
  if (!c->options->dependencies || !strcmp(output, "-")) return true;
  char *copy = strdup(output);
  if (copy && VS_GROW(c->outputs, c->output_room, c->output_count + 1))
    return c->outputs[c->output_count++] = copy, true;
  free(copy);
  return fputs("vs: out of memory\n", stderr), false;
}

void cli_dependencies_free(cli_session *c) {
  for (size_t i = 0; i < c->output_count; i++) free(c->outputs[i]);
  free(c->outputs);
}

/* Writes a name for make. A backslash before a blank is doubled, because the blank has a backslash of its own. */
static void put_name(FILE *to, const char *name, bool target) {
  for (const char *at = name; *at; at++) {
    const char *end = at + strspn(at, "\\");
    if (end > at && (*end == ' ' || *end == '\t' || *end == '#' || *end == ':'))
      for (const char *slash = at; slash < end; slash++) fputc('\\', to);
    for (; at < end; at++) fputc('\\', to);
    if (!*at) return;
    if (*at == '$') fputc('$', to);
    else if (strchr(" \t#:", *at) || (target && *at == '%')) fputc('\\', to);
    fputc(*at, to);
  }
}

static void put_rules(FILE *to, const cli_session *c) {
  const char *name;
  for (size_t i = 0; i < c->output_count; i++) {
    if (i) fputc(' ', to);
    put_name(to, c->outputs[i], true);
  }
  fputc(':', to);
  for (size_t i = 0; (name = vs_input_name(c->scheme, i)) != NULL; i++) fputs(" \\\n  ", to), put_name(to, name, false);
  fputc('\n', to);
  for (size_t i = 0; (name = vs_input_name(c->scheme, i)) != NULL; i++)
    fputc('\n', to), put_name(to, name, true), fputs(":\n", to);
}

/* Returns true if make can read the name. Otherwise prints a message. */
static bool is_nameable(const char *name) {
  if (!strchr(name, '\n')) return true;
  return fprintf(stderr, "vs: -d: make has no notation for the line break in the name of a file\n") < 0;
}

bool cli_dependencies_write(cli_session *c) {
  const char *path = c->options->dependencies, *name;
  cli_whole_file file;
  bool ok = true;
  if (!path) return true;
  for (size_t i = 0; ok && i < c->output_count; i++) ok = is_nameable(c->outputs[i]);
  for (size_t i = 0; ok && (name = vs_input_name(c->scheme, i)) != NULL; i++) ok = is_nameable(name);
  if (!ok) return false;
  FILE *to = cli_whole_begin(&file, path);
  if (to) put_rules(to, c);
  if (cli_whole_end(&file, true)) return true;
  return fprintf(stderr, "vs: cannot write %s: %s\n", path, strerror(errno)), false;
}
