/* Prints the change of a parameter's default as a patch of its line. */
#include "cli/cure/source_edit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool cure_place_keep(cure_place *out, const vs_span *at) {
  *out = (cure_place){ .line = at->line };
  return !at->file || (out->file = strdup(at->file)) != NULL;
}

void cure_place_free(cure_place *p) { free(p->file); }

/* Returns the line of a place, which the caller frees; NULL if it cannot be read. */
static char *line_of(const cure_place *p) {
  FILE *from = p->file ? fopen(p->file, "r") : NULL;
  char *line = NULL;
  size_t room = 0;
  uint32_t at = 0;
  while (from && at < p->line && getline(&line, &room, from) >= 0) at++;
  if (from) fclose(from);
  if (from && at == p->line) return line[strcspn(line, "\r\n")] = 0, line;
  free(line);
  return NULL;
}

/* Returns the end of the number, string or other atom at `from`; `from` itself for an expression. */
static const char *atom_end(const char *from) {
  if (*from == '"') {
    const char *end = from + 1;
    while (*end && *end != '"') end += *end == '\\' && end[1] ? 2 : 1;
    return *end ? end + 1 : from;
  }
  return from + strcspn(from, " \t()\"'`;[]");
}

void cure_print_edit(const cure_place *p, const char *name, const char *value) {
  static const char form[] = "(define-parameter ";
  char *line = line_of(p), *at = line;
  size_t n = strlen(name);
  while (at && (at = strstr(at, form)) != NULL) {
    at += strlen(form);
    if (strncmp(at, name, n)) continue;
    char *from = at + n + strspn(at + n, " \t");
    if (from == at + n) continue;
    const char *end = atom_end(from);
    if (end == from) break;
    bool text = *from == '"' && *value != '"';
    printf("--- %s\n+++ %s\n@@ -%u +%u @@\n-%s\n+%.*s%s%s%s%s\n", p->file, p->file, (unsigned)p->line,
           (unsigned)p->line, line, (int)(from - line), line, text ? "\"" : "", value, text ? "\"" : "", end);
    break;
  }
  free(line);
}
