/* Computes the distance between two short names: the least number of insertions, deletions, replacements and swaps of
 * neighbours. */
#include "cli/nearby.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 48 }; /* greatest length of names that are compared, in bytes */

static size_t smaller(size_t a, size_t b) { return a < b ? a : b; }
static int lower(char c) { return tolower((unsigned char)c); }

static size_t distance(const char *a, const char *b) {
  size_t m = strlen(a), n = strlen(b);
  if (m > LONGEST || n > LONGEST) return LONGEST;
  size_t row[3][LONGEST + 1]; /* the row of the table of distances that is being computed, and the two rows before it */
  for (size_t j = 0; j <= n; j++) row[1][j] = j;
  for (size_t i = 1; i <= m; i++) {
    row[2][0] = i;
    for (size_t j = 1; j <= n; j++) {
      size_t change = row[1][j - 1] + (lower(a[i - 1]) != lower(b[j - 1]));
      row[2][j] = smaller(change, smaller(row[1][j], row[2][j - 1]) + 1);
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[2][j] = smaller(row[2][j], row[0][j - 2] + 1);
    }
    memcpy(row[0], row[1], sizeof row[0]);
    memcpy(row[1], row[2], sizeof row[1]);
  }
  return row[1][n];
}

cli_nearby cli_nearby_start(const char *wanted) {
  return (cli_nearby){ .wanted = wanted, .distance = smaller(strlen(wanted) / 3 + 1, 3) + 1 };
}

void cli_nearby_offer(cli_nearby *n, const char *name) {
  size_t d = distance(n->wanted, name);
  if (d < n->distance) {
    n->distance = d;
    n->best = name;
  }
}

bool cli_nearby_is_program(const char *name) {
  const char *dot = strrchr(name, '.');
  return dot && dot > name &&
         (!strcmp(dot, ".vs") || !strcmp(dot, ".js") || !strcmp(dot, ".lsp") ||
          !strcmp(dot, ".gml") || !strcmp(dot, ".scad"));
}

bool cli_nearby_program(const char *path, char *room, size_t size) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
  int folder = slash ? (int)(slash + 1 - path) : 0;
  bool bare = !strchr(name, '.');
  char near[LONGEST + 1] = "";
  if (!*name || (!bare && !cli_nearby_is_program(name)) || strlen(path) >= size) return false;
  snprintf(room, size, "%.*s.", folder, path);
  DIR *d = opendir(room);
  if (!d) return false;
  size_t length = strcspn(name, ".");
  /* permitted distance: a third of the name's length and 1, at most 3; the suffix of the name does not count */
  cli_nearby n = { .wanted = name, .distance = smaller(length / 3 + 1, 3) };
  for (struct dirent *e; (e = readdir(d));) {
    const char *found = e->d_name;
    if (!cli_nearby_is_program(found) || strlen(found) > LONGEST) continue;
    if (bare) n.best = !strncmp(found, name, length) && found + length == strrchr(found, '.') ? found : NULL;
    else cli_nearby_offer(&n, found);
    if (n.best == found) strcpy(near, found);
    n.best = NULL; /* forgets the name, since the next directory entry overwrites it; the distance remains valid */
  }
  closedir(d);
  int put = *near ? snprintf(room, size, "%.*s%s", folder, path, near) : -1;
  return put > 0 && (size_t)put < size;
}
