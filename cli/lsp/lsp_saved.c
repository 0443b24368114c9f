/* Runs a text when it is saved, and adds the messages of the run to the text's diagnostics. */
#include "cli/lsp/lsp_saved.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/lsp/lsp_lens.h"
#include "cli/lsp/lsp_messages.h"
#include "cli/lsp/lsp_runs.h"
#include "cli/lsp/lsp_words.h"
#include "model/store/array.h"

enum { SECONDS = 10, MEGABYTES = 1024 };
/* Least share of the run's time, and least seconds of the run, with which a line has a hint. */
static const double LEAST_SHARE = 0.05, LEAST_SECONDS = 0.05;

/* ---- reading the output ---- */

static const char *file_name(const lsp_document *d) {
  return strrchr(d->path, '/') ? strrchr(d->path, '/') + 1 : d->path;
}

static bool begins(const char *text, const char *with) { return !strncmp(text, with, strlen(with)); }

/* Returns whether there is a file of this name, for a run in the folder of the text. */
static bool is_file(const lsp_document *d, const char *file) {
  char path[8200];
  int folder = (int)(file_name(d) - d->path);
  int n = snprintf(path, sizeof path, "%.*s%s", *file == '/' ? 0 : folder, d->path, file);
  return n < (int)sizeof path && access(path, R_OK) == 0;
}

static void add_message(lsp_document *d, const lsp_run_message *m) {
  if (VS_GROW(d->messages, d->message_room, d->message_count + 1)) d->messages[d->message_count++] = *m;
}

/* Gives the last message the place of the call that led there, if it has none in this file yet. */
static void take_call(lsp_document *d, const lsp_run_message *call) {
  lsp_run_message *last = d->message_count ? &d->messages[d->message_count - 1] : NULL;
  if (last && !last->line) last->line = call->line, last->column = call->column;
}

/* Adds the message of a line FILE:LINE:COLUMN: text. A message on another file has line 0. Other lines, which the
 * program may have printed, are no messages. */
static void take_line(lsp_document *d, const char *line, size_t length) {
  char text[sizeof ((lsp_run_message *)0)->text], room[4096], head[300];
  unsigned row = 0, column = 0;
  int read = 0;
  if (length >= sizeof room) return;
  snprintf(room, sizeof room, "%.*s", (int)length, line);
  snprintf(head, sizeof head, "%.290s:", file_name(d));
  char *file = strstr(room, head); /* the program may have printed a part of the line */
  if (!file) file = room;
  char *colon = strchr(file, ':');
  if (!colon || sscanf(colon, ":%u:%u: %n", &row, &column, &read) < 2 || !read) return;
  const char *said = colon + read;
  lsp_run_message m = { .line = row, .column = column, .severity = 1 };
  if (begins(said, "warning: ")) m.severity = 2, said += 9;
  else if (begins(said, "note: ")) m.severity = 3, said += 6;
  /* The confined run does not see all folders of libraries; the analysis reports files that are missing. */
  if (begins(said, "import: there is no library") || begins(said, "load: cannot open")) return;
  snprintf(text, sizeof text, "%.*s", (int)sizeof text - 1, said);
  *colon = 0;
  bool own = !strcmp(file, file_name(d));
  if (!own && !is_file(d, file)) return;
  if (begins(said, "called from ")) {
    if (own) take_call(d, &m);
    return;
  }
  if (!own) m.line = 0;
  if (own) snprintf(m.text, sizeof m.text, "%s", text);
  else snprintf(m.text, sizeof m.text, "%.150s:%u:%u: %.200s", file, row, column, text);
  add_message(d, &m);
}

static void take_forms(const lsp_server *s, lsp_document *d, cli_data forms) {
  for (size_t i = 0; i < cli_data_count(&s->json, forms); i++) {
    cli_data f = cli_data_nth(&s->json, forms, i);
    const char *file = cli_data_text(&s->json, f, "file", NULL);
    if (!file || strcmp(file, file_name(d)) || cli_data_number(&s->json, f, "count", 1)) continue;
    lsp_run_message m = { .line = (uint32_t)cli_data_number(&s->json, f, "line", 1), .severity = LSP_UNREACHED,
                          .column = (uint32_t)cli_data_number(&s->json, f, "column", 1),
                          .text = "the run after the last save did not reach this form" };
    add_message(d, &m);
  }
}

static void take_times(const lsp_server *s, lsp_document *d, cli_data lines) {
  for (size_t i = 0; i < cli_data_count(&s->json, lines); i++) {
    cli_data l = cli_data_nth(&s->json, lines, i);
    const char *file = cli_data_text(&s->json, l, "file", NULL);
    lsp_line_time t = { .line = (uint32_t)cli_data_number(&s->json, l, "line", 1),
                        .seconds = cli_data_real(&s->json, l, "own", 0) };
    bool much = d->seconds >= LEAST_SECONDS && t.seconds >= LEAST_SHARE * d->seconds;
    if (file && !strcmp(file, file_name(d)) && much && VS_GROW(d->times, d->time_room, d->time_count + 1))
      d->times[d->time_count++] = t;
  }
}

/* Returns the JSON of the profile, which follows all else that the run prints; NULL if there is none. */
static const char *profile_of(const char *said) {
  const char *found = NULL;
  for (const char *at = said; (at = strstr(at, "{\"schema\":1,\"samples\"")) != NULL; at++) found = at;
  return found;
}

static void take_result(lsp_server *s, const lsp_run *r, bool whole) {
  lsp_document *d = lsp_find_uri(s, r->uri);
  if (!d || !d->saved) return; /* closed, or changed since */
  lsp_document_forget(d);
  const char *json = profile_of(r->said), *end = json ? json : r->said + r->count;
  for (const char *at = r->said; at < end;) {
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    size_t n = (size_t)((stop ? stop : end) - at);
    take_line(d, at, n);
    at += n + 1;
  }
  for (size_t i = 0; i < d->message_count; i++)
    if (!d->messages[i].line) d->messages[i].line = d->messages[i].column = 1;
  cli_data profile = json ? cli_data_read(&s->json, json, r->count - (size_t)(json - r->said)) : NULL;
  d->seconds = cli_data_real(&s->json, profile, "seconds", 0);
  d->slow = !whole;
  bool draws = lsp_document_study(d, s->interpreter) && lsp_drawing_of(&d->draft->k) != 0;
  if (s->fades && draws) take_forms(s, d, cli_data_at(&s->json, profile, "forms"));
  take_times(s, d, cli_data_at(&s->json, profile, "lines"));
  cli_data_free(&s->json, profile);
  lsp_publish(s, d, false);
  lsp_message m;
  if (!s->refreshes || !lsp_message_begin(&m)) return;
  fprintf(m.to, "\"id\":\"hints-%u\",\"method\":\"workspace/inlayHint/refresh\"", ++s->refreshed);
  lsp_message_send(&m);
}

/* ---- messages of the editor ---- */

void lsp_did_save(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  if (!d || *d->path != '/') return;
  d->saved = true, d->slow = false;
  if (!s->runs_saved || !know_reads(d->path) || !lsp_document_study(d, s->interpreter)) return;
  char seconds[20], megabytes[20];
  snprintf(seconds, sizeof seconds, "%d", SECONDS);
  snprintf(megabytes, sizeof megabytes, "%d", MEGABYTES);
  const char *words[] = { "vs", "profile", "--coverage", "--json", "-q", "--limit-time", seconds, "--limit-memory",
                          megabytes, "--", file_name(d), NULL };
  lsp_run_stop(s, d, take_result);
  lsp_run r = { .done = take_result };
  lsp_run_start(s, &r, d, words, SECONDS + 5);
}

void lsp_hints(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  long long first = cli_data_number(&s->json, parameters, "range.start.line", 0);
  long long last = cli_data_number(&s->json, parameters, "range.end.line", 0);
  const char *comma = "";
  fputc('[', s->to);
  for (size_t i = 0; d && i < d->time_count; i++) {
    const lsp_line_time *t = &d->times[i];
    if ((long long)t->line - 1 < first || (long long)t->line - 1 > last) continue;
    know_place place = { .line = t->line, .column = UINT32_MAX };
    lsp_position at = lsp_position_of(d->text, d->length, lsp_place(d->text, d->length, &place).from);
    fprintf(s->to, "%s{\"position\":{\"line\":%u,\"character\":%u},\"label\":\"%.0f %%\",\"paddingLeft\":true,"
                   "\"tooltip\":\"%.3g s of %.3g s in this line itself, in the run after the last save\"}",
            comma, (unsigned)at.line, (unsigned)at.character, 100 * t->seconds / d->seconds, t->seconds, d->seconds);
    comma = ",";
  }
  fputc(']', s->to);
}
