/* Collects the output of a run (see said.h). A program may print without end, so only the end of the text, the first
 * messages and the first errors are kept. */
#include "live/said.h"

#include <string.h>

enum { MESSAGES = 200, ERRORS = 20 /* MESSAGES: greatest number of kept messages; ERRORS: a message about one of the
                                    * first ERRORS errors is kept even after MESSAGES messages */, NOTES = 40 };

static bool within_character(char c) { return ((unsigned char)c & 0xc0) == 0x80; }

void live_tail_add(live_tail *t, const char *text, size_t length) {
  live_add(&t->text, text, length);
  if (t->text.failed || t->text.length < 2 * (size_t)LIVE_KEPT) return; /* drops text only in large pieces, so that each
                                                                         * byte is moved about once */
  size_t from = t->text.length - LIVE_KEPT;
  while (from > 0 && within_character(t->text.at[from])) from--;
  for (size_t i = 0; i < from; i++) t->missing += !within_character(t->text.at[i]);
  memmove(t->text.at, t->text.at + from, t->text.length - from + 1);
  t->text.length -= from;
}

static void tail_clear(live_tail *t) {
  t->text.length = t->missing = 0;
  t->text.failed = false;
}

void live_said_begin(live_said *s) {
  tail_clear(&s->printed);
  tail_clear(&s->values);
  s->messages.length = s->shown = s->more = s->errors = 0;
  if (s->messages.at != NULL) s->messages.at[0] = 0;
}

void live_said_value(live_said *s, const char *text, size_t length) {
  live_tail_add(&s->values, text, length);
  live_tail_add(&s->values, "\n", 1);
}

void live_json_place(live_text *t, const vs_span *at) {
  live_puts(t, "{\"file\":");
  live_json(t, at->file);
  live_putf(t, ",\"line\":%u,\"column\":%u,\"endLine\":%u,\"endColumn\":%u}", at->line, at->column, at->end_line,
            at->end_column);
}

void live_said_diagnose(live_said *s, const vs_diagnostic *d) {
  static const char *const words[] = { "error", "warning", "note" };
  live_text *t = &s->messages;
  bool error = d->severity == VS_SEVERITY_ERROR;
  s->errors += error;
  if (s->shown >= MESSAGES && !(error && s->errors <= ERRORS)) {
    s->more++;
    return;
  }
  if (s->shown++ > 0) live_puts(t, ",");
  live_putf(t, "{\"severity\":\"%s\",\"message\":", words[d->severity]);
  live_json(t, d->message);
  live_puts(t, ",\"source\":");
  live_json(t, d->source_line);
  live_puts(t, ",\"at\":");
  live_json_place(t, &d->at);
  live_puts(t, ",\"notes\":[");
  for (size_t i = 0; i < d->note_count && i < NOTES; i++) {
    live_puts(t, i > 0 ? ",{\"message\":" : "{\"message\":");
    live_json(t, d->notes[i].message);
    live_puts(t, ",\"at\":");
    live_json_place(t, &d->notes[i].at);
    live_puts(t, "}");
  }
  live_puts(t, "]}");
}

static void write_tail(const live_tail *t, live_text *to) {
  live_json_bytes(to, t->text.at != NULL ? t->text.at : "", t->text.length);
}

void live_said_write(const live_said *s, live_text *to) {
  live_puts(to, "\"messages\":[");
  live_puts(to, s->messages.at != NULL ? s->messages.at : "");
  live_putf(to, "],\"more\":%zu,\"printed\":", s->more);
  write_tail(&s->printed, to);
  live_puts(to, ",\"values\":");
  write_tail(&s->values, to);
  live_putf(to, ",\"missing\":%zu", s->printed.missing + s->values.missing);
}

void live_said_free(live_said *s) {
  live_text_free(&s->printed.text);
  live_text_free(&s->values.text);
  live_text_free(&s->messages);
}
