/* Implements `vs search WORD`: packages of an index, as lines or as JSON. */
#define _GNU_SOURCE
#include "cli/packages/search_command.h"

#include <string.h>

#include "cli/json.h"
#include "cli/packages/package_index.h"

static bool has_words(const package_entry *e, const cli_options *o) {
  for (size_t i = 0; i < o->source_count; i++)
    if (!strcasestr(e->name, o->sources[i].text) && !strcasestr(e->description, o->sources[i].text)) return false;
  return true;
}

/* Prints a text of the index, with blanks instead of control characters, which could change the terminal. */
static void put(const char *text) {
  for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
    bool second = c[0] == 0xC2 && c[1] >= 0x80 && c[1] < 0xA0; /* a control character in two bytes */
    putchar(*c < ' ' || *c == 0x7F || second ? ' ' : *c);
    c += second;
  }
}

static void print_line(const package_entry *e) {
  printf("%s%s", e->name, *e->version ? " " : "");
  put(e->version);
  fputs(*e->description ? ": " : "", stdout);
  put(e->description);
  fputs(" (", stdout);
  put(e->address);
  fputs(")\n", stdout);
}

static void print_json(const package_entry *e, const char *comma) {
  const char *const keys[] = { "name", "address", "description", "version" };
  const char *const values[] = { e->name, e->address, e->description, e->version };
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
    printf("%s\"%s\": ", i ? ", " : comma, keys[i]);
    cli_json_text(stdout, values[i]);
  }
  putchar('}');
}

vs_outcome cli_search_command(const cli_options *o) {
  package_index x;
  char why[PACKAGE_WHY];
  const char *source = package_index_source(o->index);
  if (!source) {
    fputs("vs search: name an index by --index FILE, or by the environment variable VS_PACKAGE_INDEX\n", stderr);
    return VS_OUTCOME_USAGE;
  }
  fetch_outcome got = package_index_read(&x, source, why);
  if (got != FETCHED) fprintf(stderr, "vs search: %s\n", why);
  size_t found = 0;
  if (got == FETCHED && o->json) fputs("{\"schema\": 1, \"packages\": [", stdout);
  for (size_t i = 0; got == FETCHED && i < x.count; i++) {
    if (!has_words(&x.at[i], o)) continue;
    if (o->json) print_json(&x.at[i], found ? ",\n  {" : "\n  {");
    else print_line(&x.at[i]);
    found++;
  }
  if (got == FETCHED && o->json) puts("\n]}");
  else if (got == FETCHED && !found) printf("no package of %s has these words\n", source);
  package_index_free(&x);
  return got == FETCHED ? VS_OUTCOME_DONE : got == NO_GIT ? VS_OUTCOME_WORKER : VS_OUTCOME_USAGE;
}
