/* Sums the samples of a run by lines of the program. */
#include "cli/profile/profile_lines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

/* The file and the line of a call, with the call's index. */
typedef struct { const char *file; uint32_t line, call; } place;

static int by_place(const void *a, const void *b) {
  const place *x = a, *y = b;
  int files = strcmp(x->file, y->file);
  return files ? files : x->line < y->line ? -1 : x->line > y->line;
}

/* Makes a line for each place, and finds the line of each call. */
static void number_lines(profile_tree *t, place *places) {
  for (size_t i = 0; i < t->count; i++) {
    const vs_span *at = &t->calls[i].at;
    places[i] = (place){ at->file ? at->file : "", at->line, (uint32_t)i };
  }
  if (t->count) qsort(places, t->count, sizeof *places, by_place);
  for (size_t i = 0; i < t->count; i++) {
    if (!i || by_place(&places[i - 1], &places[i]))
      t->lines[t->line_count++] = (profile_line){ .file = places[i].file, .line = places[i].line };
    t->line_of[places[i].call] = (uint32_t)t->line_count - 1;
  }
}

/* Adds the time of each call to its own line, and once to each line among its callers. */
static void sum_lines(profile_tree *t) {
  for (size_t i = 0; i < t->count; i++) {
    const vs_profile_call_info *c = &t->calls[i];
    t->lines[t->line_of[i]].own += c->seconds;
    t->lines[t->line_of[i]].bytes += c->bytes;
    t->seconds += c->seconds, t->bytes += c->bytes;
    for (size_t k = i + 1; k && c->seconds > 0; k = t->calls[k - 1].caller) {
      profile_line *l = &t->lines[t->line_of[k - 1]];
      if (l->stamp == i + 1) continue;
      l->stamp = i + 1;
      l->whole += c->seconds;
    }
  }
  for (size_t i = t->count; i-- > 0;) {
    t->whole[i] += t->calls[i].seconds;
    if (t->calls[i].caller) t->whole[t->calls[i].caller - 1] += t->whole[i];
  }
}

static int most_own(const void *a, const void *b) {
  const profile_line *x = a, *y = b;
  if (x->own != y->own) return x->own < y->own ? 1 : -1;
  return x->whole < y->whole ? 1 : x->whole > y->whole ? -1 : x->line < y->line ? -1 : x->line > y->line;
}

bool profile_tree_read(profile_tree *t, vs_scheme *scheme) {
  vs_profile_call_info call;
  vs_profile_info procedure;
  *t = (profile_tree){ 0 };
  for (; vs_profile_call(scheme, t->count, &call); t->calls[t->count++] = call)
    if (!VS_GROW(t->calls, t->room, t->count + 1)) return false;
  vs_profile_get(scheme, 0, &procedure, &t->looks);
  place *places = vs_zeros(t->count + 1, sizeof *places);
  t->whole = vs_zeros(t->count + 1, sizeof *t->whole);
  t->line_of = vs_zeros(t->count + 1, sizeof *t->line_of);
  t->lines = vs_zeros(t->count + 1, sizeof *t->lines);
  bool ok = places && t->whole && t->line_of && t->lines;
  if (ok) number_lines(t, places), sum_lines(t);
  free(places);
  if (ok && t->line_count) qsort(t->lines, t->line_count, sizeof *t->lines, most_own);
  return ok;
}

void profile_tree_free(profile_tree *t) {
  free(t->calls);
  free(t->whole);
  free(t->line_of);
  free(t->lines);
  *t = (profile_tree){ 0 };
}

/* Returns the bytes before the column, which counts characters from 1, or those of the blanks at the start of the text
 * if these are more. */
static size_t before(const char *text, uint32_t column) {
  size_t blanks = strspn(text, " \t"), n = 0;
  for (uint32_t at = 1; text[n] && (at < column || (text[n] & 0xC0) == 0x80); n++) at += (text[n + 1] & 0xC0) != 0x80;
  return n > blanks ? n : blanks;
}

void profile_line_text(const char *file, uint32_t number, uint32_t column, char *room, size_t size) {
  char part[4096];
  bool begins = true; /* whether the next part begins a line */
  FILE *from = number ? fopen(file, "rb") : NULL;
  *room = 0;
  for (uint32_t line = 0; from && line < number && fgets(part, sizeof part, from);) {
    line += begins;
    begins = strchr(part, '\n') != NULL;
    if (line != number) continue;
    snprintf(room, size, "%s", part + before(part, column));
    room[strcspn(room, "\r\n")] = 0;
    break;
  }
  if (from) fclose(from);
}
