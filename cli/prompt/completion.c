/* Finds the names by which the Tab key completes a word at the prompt: names of the language and the program, keywords
 * of the call, commands of the prompt, and files within a string. */
#include "cli/prompt/completion.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/prompt/source_text.h"

typedef struct { cli_names *names; const char *prefix; bool failed; } search;

static bool collect(void *context, const char *name) {
  search *s = context;
  cli_names *n = s->names;
  if (n->count == n->room) {
    size_t room = n->room ? n->room * 2 : 64;
    char **grown = realloc(n->at, room * sizeof *grown);
    if (!grown) return !(s->failed = true);
    n->at = grown;
    n->room = room;
  }
  n->at[n->count] = strdup(name);
  s->failed = !n->at[n->count];
  if (!s->failed) n->count++;
  return !s->failed;
}

static void collect_matching(void *context, const char *name) {
  search *s = context;
  if (strncmp(name, s->prefix, strlen(s->prefix)) == 0) collect(s, name);
}

static int by_text(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* Collects the paths of files that begin with the prefix. Paths of folders end in a slash. */
static void collect_files(search *s) {
  const char *slash = strrchr(s->prefix, '/');
  size_t folder = slash ? (size_t)(slash - s->prefix) + 1 : 0;
  char path[1024], full[1400];
  if (folder >= sizeof path) return;
  memcpy(path, s->prefix, folder);
  path[folder] = 0;
  DIR *d = opendir(folder ? path : ".");
  if (!d) return;
  for (struct dirent *entry; (entry = readdir(d)) != NULL;) {
    if (strncmp(entry->d_name, s->prefix + folder, strlen(s->prefix + folder)) != 0) continue;
    if (entry->d_name[0] == '.' && s->prefix[folder] != '.') continue;
    if (snprintf(full, sizeof full - 1, "%s%s", path, entry->d_name) >= (int)sizeof full - 1) continue;
    struct stat st;
    if (stat(full, &st) == 0 && S_ISDIR(st.st_mode)) strcat(full, "/");
    collect(s, full);
  }
  closedir(d);
}

static void collect_keywords(vs_scheme *scheme, const char *before, search *s) {
  char word[80];
  cli_call call;
  vs_name_info info;
  if (!cli_text_call(before, &call) || !vs_name_get(scheme, call.name, &info)) return;
  for (const char *at = info.keywords; *at;) {
    size_t length = strcspn(at, " ");
    snprintf(word, sizeof word, "%.*s", (int)length, at);
    collect_matching(s, word);
    at += length + (at[length] == ' ');
  }
}

/* Returns the kind of the word at the end of the text before the cursor. Sets *start to the word's beginning. */
static cli_word_kind word_at(const char *before, const char **start) {
  bool in_string;
  size_t open[CLI_DEEP], n = strlen(before);
  const char *end = before + n, *line = before + n;
  while (line > before && line[-1] != '\n') line--;
  const char *first = line + strspn(line, " \t");
  if (*first == ',') { /* completes a command of the prompt, or its argument: a file or a name */
    const char *space = strpbrk(first, " \t");
    if (!space) return *start = first + 1, CLI_WORD_COMMAND;
    const char *argument = space + strspn(space, " \t");
    static const char *const files[] = {"write", "run", "load", "save", "render", "reload"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
      if (!strncmp(first + 1, files[i], (size_t)(space - first - 1)) && space - first > 1) return *start = argument,
          CLI_WORD_FILE;
  }
  cli_text_open(before, n, open, &in_string);
  if (in_string) {
    *start = end;
    while (*start > before && (*start)[-1] != '"') --*start;
    return CLI_WORD_FILE;
  }
  *start = end;
  while (*start > before && !strchr(" \t\n()[]'`,;\"", (*start)[-1])) --*start;
  return (*start)[0] == '#' && (*start)[1] == ':' ? CLI_WORD_KEYWORD : CLI_WORD_NAME;
}

void cli_names_find(vs_scheme *scheme, cli_each_command *commands, const char *before, cli_names *found) {
  const char *start;
  *found = (cli_names){ .kind = word_at(before, &start) };
  search s = { .names = found, .prefix = start };
  found->prefix = strlen(start);
  if (found->kind == CLI_WORD_FILE) collect_files(&s);
  else if (found->kind == CLI_WORD_COMMAND) commands(collect_matching, &s);
  else if (found->kind == CLI_WORD_KEYWORD) collect_keywords(scheme, before, &s);
  else if (found->prefix) vs_complete(scheme, start, collect, &s);
  if (!found->count) return;
  qsort(found->at, found->count, sizeof *found->at, by_text);
  size_t common = strlen(found->at[0]);
  for (size_t i = 1; i < found->count; i++) {
    size_t same = 0;
    while (same < common && found->at[i][same] == found->at[0][same]) same++;
    common = same;
  }
  while (common > found->prefix && ((unsigned char)found->at[0][common] & 0xC0) == 0x80) common--;
  found->common = common;
}

void cli_names_free(cli_names *n) {
  for (size_t i = 0; i < n->count; i++) free(n->at[i]);
  free(n->at);
  *n = (cli_names){ 0 };
}

/* ---- rows of names ---- */

static bool put_name(const char *name, size_t width, bool chosen, bool colours, line_buffer *to) {
  char text[1500];
  const char *before = chosen ? colours ? "\033[7m" : "[" : "", *after = chosen ? colours ? "\033[0m" : "]" : "";
  size_t marks = chosen && !colours ? 2 : 0, length = strlen(name) + marks;
  int n = snprintf(text, sizeof text, "%s%s%s%*s", before, name, after, length < width ? (int)(width - length) : 0, "");
  return n > 0 && n < (int)sizeof text && cli_line_buffer_add(to, text, (size_t)n);
}

int cli_names_rows(const cli_names *n, int chosen, int width, int rows, bool colours, line_buffer *to) {
  size_t widest = 0;
  for (size_t i = 0; i < n->count; i++)
    if (strlen(n->at[i]) > widest) widest = strlen(n->at[i]);
  int column = (int)widest + 3, across = (width - 1) / column > 0 ? (width - 1) / column : 1, count = (int)n->count;
  int all = (count + across - 1) / across, shown = all <= rows ? all : rows - 1;
  if (shown < 1) return 0;
  int at = chosen < 0 ? 0 : chosen / across, first = at < shown ? 0 : at - shown + 1;
  for (int row = first; row < first + shown; row++) {
    for (int i = row * across; i < (row + 1) * across && i < count; i++)
      if (!put_name(n->at[i], i + 1 < (row + 1) * across ? (size_t)column : 0, i == chosen, colours, to)) return 0;
    if (!cli_line_buffer_add(to, "\r\n", 2)) return 0;
  }
  if (shown == all) return shown;
  char more[60];
  int length = snprintf(more, sizeof more, "... %d names\r\n", count);
  return cli_line_buffer_add(to, more, (size_t)length) ? shown + 1 : shown;
}
