/* Reports errors and warnings to the host. Each report has a place, the line of the source text there, and the user's
 * calls that led to the error. */
#include "session/report.h"

#include <inttypes.h>

#include "bind/call/take.h"
#include "bind/origins.h"
#include "session/advice.h"
#include "session/session.h"
#include "vm/front/source.h"

#include "vm/values/printer.h"

enum {
  NOTES = 12,        /* greatest number of callers in a report, innermost first */
  LIMIT_MESSAGE = 96 /* room for a message that names a limit */
};

/* ---- source lines ---- */

const char *vs_session_source_line(const vs_session *s, const char *file, uint32_t line, char *room, size_t size) {
  for (size_t i = 0; file && line && i < s->source_count; i++) {
    const vs_source *source = &s->sources[i];
    if (strcmp(source->name, file) || line < source->first_line) continue;
    const char *at = source->text, *end = source->text + source->length;
    for (uint32_t l = source->first_line; l < line && at; l++) {
      at = memchr(at, '\n', (size_t)(end - at));
      if (at) at++;
    }
    if (!at || (at == end && line > source->first_line)) return NULL;
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    size_t n = (size_t)((stop ? stop : end) - at);
    if (n && at[n - 1] == '\r') n--;
    if (n >= size)
      for (n = size - 1; n && ((unsigned char)at[n] & 0xC0) == 0x80;) n--; /* cuts the line between two characters, not
                                                                            * within the bytes of a character */
    memcpy(room, at, n);
    room[n] = 0;
    return room;
  }
  return NULL;
}

static void print_place(const vs_span *at) {
  if (!at->file) return;
  fprintf(stderr, "%s:", at->file);
  if (at->line) fprintf(stderr, "%" PRIu32 ":", at->line);
  if (at->line && at->column) fprintf(stderr, "%" PRIu32 ":", at->column);
  fputc(' ', stderr);
}

/* Prints the report to standard error if the host has no callback `diagnose`: a line for the message and one for each
 * note. */
static void print(const vs_diagnostic *d) {
  print_place(&d->at);
  fprintf(stderr, "%s%s\n",
          d->severity == VS_SEVERITY_WARNING ? "warning: "
          : d->severity == VS_SEVERITY_NOTE  ? "note: "
                                             : "",
          d->message);
  for (size_t i = 0; i < d->note_count; i++) {
    print_place(&d->notes[i].at);
    fprintf(stderr, "%s\n", d->notes[i].message);
  }
}

/* Passes the report to the host, together with its source line. */
static void tell(vs_session *s, vs_diagnostic d) {
  char line[2048];
  d.source_line = vs_session_source_line(s, d.at.file, d.at.line, line, sizeof line);
  if (s->options.host.diagnose) s->options.host.diagnose(s->options.host.context, &d);
  else print(&d);
}

void vs_session_report_at(vs_session *s, vs_severity severity, vs_outcome outcome, vs_span at, const char *message) {
  tell(s, (vs_diagnostic){ .severity = severity, .outcome = outcome, .at = at, .message = message });
}

void vs_session_report(vs_session *s, vs_severity severity, vs_outcome outcome, const vs_origin *origin,
                       const char *message) {
  vs_diagnostic_note notes[NOTES];
  size_t n = 0;
  vs_span at = { 0 };
  if (origin) {
    at.file = origin->file, at.line = origin->line, at.column = origin->column;
    for (const vs_origin *o = origin->caller; o && n < NOTES; o = o->caller)
      notes[n++] =
          (vs_diagnostic_note){ { .file = o->file, .line = o->line, .column = o->column }, "called from here" };
  }
  tell(s, (vs_diagnostic){ .severity = severity, .outcome = outcome, .at = at, .message = message,
                           .notes = notes, .note_count = n });
}

void vs_session_warn(void *session, const vs_origin *origin, const char *message) {
  vs_session_report(session, VS_SEVERITY_WARNING, VS_OUTCOME_DONE, origin, message);
}

/* Returns the message of an error of memory: `said`, or if the user has set a limit, a text in `room` that names it.
 * The message does not depend on whether the library's count or malloc has refused the request. */
static const char *memory_message(const vs_session *s, const char *said, char *room, size_t size) {
  if (!s->options.limit_memory) return said;
  snprintf(room, size, "out of memory: stopped at %.12g MB, the limit", (double)s->options.limit_memory / 1048576);
  return room;
}

vs_outcome vs_session_report_error(vs_session *s, const vs_error *e) {
  vs_outcome outcome = VS_OUTCOME_MODEL;
  switch (e->kind) {
    case VS_ERROR_NONE: case VS_ERROR_MODEL: break;
    case VS_ERROR_FILE: outcome = VS_OUTCOME_USAGE; break;
    case VS_ERROR_WORKER: outcome = VS_OUTCOME_WORKER; break;
    case VS_ERROR_MEMORY: case VS_ERROR_LIMIT: outcome = VS_OUTCOME_MACHINE; break;
    case VS_ERROR_INTERRUPT: outcome = VS_OUTCOME_INTERRUPTED; break;
  }
  char limit[LIMIT_MESSAGE];
  const char *message = *e->message ? e->message : outcome == VS_OUTCOME_MACHINE ? "out of memory" : "it failed";
  if (e->kind == VS_ERROR_MEMORY) message = memory_message(s, message, limit, sizeof limit);
  vs_session_report(s, VS_SEVERITY_ERROR, outcome, e->origin, message);
  return outcome;
}

/* ---- reporting errors ---- */

bool vs_session_span(vs_session *s, vs_pos place, vs_span *out) {
  *out =
      (vs_span){ .file = vs_bind_file_name(&s->bind, place), .line = vs_pos_line(place), .column = vs_pos_col(place) };
  if (!out->file) *out = (vs_span){ 0 };
  return out->file != NULL;
}

/* Returns true if the time limit for outputs has caused the interrupt, and not the user. */
static bool is_late(const vs_session *s) { return s->writing && s->writing->late; }

static vs_outcome outcome_of(const vs_session *s, vs_value kind, bool usage) {
  const vs_scheme *vm = s->bind.vm;
  if (kind == vm->sym.interrupt && is_late(s)) return VS_OUTCOME_MACHINE;
  if (kind == vm->sym.memory || kind == vm->sym.limit) return VS_OUTCOME_MACHINE;
  if (kind == vm->sym.interrupt) return VS_OUTCOME_INTERRUPTED;
  return usage || s->bind.bad_parameter ? VS_OUTCOME_USAGE : VS_OUTCOME_MODEL;
}

/* Fills notes with the callers, and returns their number. chain: the calls that were active, innermost first; the first
 * is the call that failed. */
static size_t callers(vs_session *s, vs_value chain, vs_span at, vs_diagnostic_note *notes) {
  size_t n = 0;
  const char *before_file = at.file;
  uint32_t before_line = at.line, before_column = at.column;
  bool gap = false;
  for (vs_value l = chain; vs_is_pair(l) && n < NOTES; l = vs_cdr(l)) {
    vs_value link = vs_car(l);
    vs_span span;
    if (vs_is_pair(link) && vs_car(link) == VS_TRUE) gap = true;
    if (!vs_is_pair(link) || !vs_is_fixnum(vs_cdr(link)) || !vs_session_span(s, vs_pos_of(vs_cdr(link)), &span))
      continue;
    if (span.file == before_file && span.line == before_line && span.column == before_column) continue;
    before_file = span.file, before_line = span.line, before_column = span.column;
    char text[160];
    vs_value name = vs_car(link);
    const char *between = gap ? " (calls in between ended with a tail call)" : "";
    vs_pos called = vs_pos_of(vs_cdr(link));
    const char *said = vs_is_symbol(name) ? vs_source_said(s->bind.vm, vs_as_symbol(name)->name, called) : NULL;
    if (said) snprintf(text, sizeof text, "called from %.100s%s", said, between);
    else snprintf(text, sizeof text, "called from here%s", between);
    gap = false;
    const char *kept = vs_store_text(s->bind.store, text, strlen(text));
    notes[n++] = (vs_diagnostic_note){ span, kept ? kept : "called from here" };
  }
  return n;
}

bool vs_session_condition_place(vs_session *s, const vs_condition *c, vs_span *out) {
  bool found = vs_session_span(s, c->place, out);
  for (vs_value l = c->chain; vs_is_pair(l) && !found; l = vs_cdr(l)) {
    vs_value link = vs_car(l);
    found = vs_is_pair(link) && vs_is_fixnum(vs_cdr(link)) && vs_session_span(s, vs_pos_of(vs_cdr(link)), out);
  }
  return found;
}

vs_outcome vs_session_report_condition(vs_session *s, vs_value condition, bool usage) {
  vs_scheme *vm = s->bind.vm;
  vs_diagnostic_note notes[NOTES];
  vs_span at = { 0 };
  size_t count = 0;
  VS_ROOTS(vm, r, 1);
  r[0] = condition;
  vs_outcome outcome = usage ? VS_OUTCOME_USAGE : VS_OUTCOME_MODEL;
  bool is_condition = vs_is(r[0], VS_T_CONDITION);
  vs_text t;
  vs_text_open(vm, &t, 4000);
  char limit[LIMIT_MESSAGE];
  bool no_memory = false, late = false;
  bool printed = vs_print_condition(vm, r[0], &t);
  const char *message = "out of memory";
  if (is_condition) {
    const vs_condition *c = vs_as_condition(r[0]);
    outcome = outcome_of(s, c->kind, usage);
    no_memory = c->kind == vm->sym.memory;
    late = c->kind == vm->sym.interrupt && is_late(s);
    /* an error in a procedure that a macro created is reported at the place where the program uses the macro */
    if (!vs_session_condition_place(s, c, &at)) vs_session_span(s, vm->top_place, &at);
    count = callers(s, vs_as_condition(r[0])->chain, at, notes);
    printed = printed && vs_session_advise(s, r[0], at, &t);
    if (s->bind.bad_parameter) { /* the parameter's value came from outside the program, so the line that defines the
                                  * parameter is not reported as the error's place */
      notes[0] = (vs_diagnostic_note){ at, "the parameter is defined here" };
      count = at.file != NULL;
      at = (vs_span){ 0 };
    }
  }
  if (printed && vs_text_end(&t)) message = t.at;
  /* if there is no memory for the message, the outcome is VS_OUTCOME_MACHINE, unless the user interrupted */
  else if (outcome != VS_OUTCOME_INTERRUPTED) outcome = VS_OUTCOME_MACHINE;
  if (late) {
    snprintf(limit, sizeof limit, "the output: stopped after %g seconds, the limit", s->options.limit_time);
    message = limit;
  }
  if (no_memory) message = memory_message(s, message, limit, sizeof limit);
  tell(s, (vs_diagnostic){ .severity = VS_SEVERITY_ERROR, .outcome = outcome, .at = at, .message = message,
                           .notes = notes, .note_count = count });
  vs_text_close(&t);
  /* a syntax error may contain further errors, as a list of pairs (place . message) */
  if (is_condition && vs_as_condition(r[0])->kind == vm->sym.read)
    for (vs_value l = vs_as_condition(r[0])->payload; vs_is_pair(l); l = vs_cdr(l)) {
      vs_value more = vs_car(l);
      vs_span span;
      char *text;
      size_t bytes;
      if (!vs_is_pair(more) || !vs_is_fixnum(vs_car(more)) || !vs_is_string(vs_cdr(more)) ||
          !vs_session_span(s, vs_pos_of(vs_car(more)), &span))
        continue;
      if (!vs_bind_take_text(vm, vs_cdr(more), &text, &bytes)) break;
      tell(s, (vs_diagnostic){ .severity = VS_SEVERITY_ERROR, .outcome = outcome, .at = span, .message = text });
      vs_mem(vm, text, bytes, 0);
    }
  return outcome;
}

vs_outcome vs_session_out_of_memory(vs_session *s) {
  return vs_session_report_error(s, &(vs_error){ .kind = VS_ERROR_MEMORY });
}
