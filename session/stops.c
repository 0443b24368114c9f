/* Answers a host's questions about a program that has stopped (vm/stepping/step.h), and continues it. */
#include "session/stops.h"

#include <string.h>

#include "bind/origins.h"
#include "session/names.h"
#include "session/report.h"
#include "session/source_outline.h"
#include "vm/compiler/code.h"
#include "vm/front/environment.h"
#include "vm/machine/fail.h"
#include "vm/machine/run.h"
#include "vm/machine/activation.h"
#include "vm/stepping/step.h"
#include "vm/stepping/resume.h"

void vs_session_arm(vs_session *s, unsigned flags) {
  vs_scheme *vm = s->bind.vm;
  bool step = flags & VS_EVAL_STOP && flags & VS_EVAL_STEP;
  vm->step = (vs_stepping){ .mode = (uint8_t)(step ? VS_STEP_ENTER : VS_STEP_CONTINUE), .stops =
      (flags & VS_EVAL_STOP) != 0, .passes = (flags & VS_EVAL_PASS) != 0,
    .first_file = s->bind.library_files, .target = UINT64_MAX >> 18 };
}

static vs_vector *details(vs_value stop) { return vs_as_vector(vs_as_condition(stop)->payload); }

/* Returns a pointer to the character at a column of the line, or to the end of a shorter line. Columns count characters
 * from 1. */
static const char *at_column(const char *line, uint32_t column) {
  for (uint32_t i = 1; i < column && *line; i++)
    for (line++; ((unsigned char)*line & 0xC0) == 0x80;) line++;
  return line;
}

/* Returns true for a stop at a call that a macro created. The place of such a call is that of the macro's use, where
 * the source contains the macro's name instead of the called procedure's. */
static bool is_hidden(vs_session *s, vs_value stop) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 2);
  r[0] = stop;
  if (details(stop)->at[VS_STOP_KIND] == vs_fix(VS_STOP_BREAK)) return false;
  char line[2048];
  vs_span at;
  vs_pos place = vs_as_condition(stop)->place;
  if (vs_bind_is_library(&s->bind, vs_pos_file(place))) return true;
  if (!vs_session_span(s, place, &at) || !vs_session_source_line(s, at.file, at.line, line, sizeof line)) return false;
  const char *head = at_column(line, at.column);
  if (*head != '(' && *head != '[') return true; /* the datum is quoted, such as 'x or `(x ,y) */
  head++;
  size_t n = vs_outline_word(head, head + strlen(head));
  return n && vs_intern(vm, head, n, &r[1]) && vs_environment_find(vm->at.program, r[1]).kind == VS_MEANS_MACRO;
}

bool vs_session_pass(vs_session *s, bool ok) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 1);
  while (!ok && vs_is_stop(vm, vm->condition)) {
    r[0] = vm->condition;
    if (!is_hidden(s, r[0]) || vm->condition != r[0]) break; /* if memory ran out in is_hidden, it has set
                                                              * vm->condition */
    ok = vs_step_resume(vm, r[0], VS_STEP_SAME, &vm->value);
  }
  return ok;
}

vs_outcome vs_session_stopped(vs_session *s) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 1);
  r[0] = vm->condition;
  if (!vs_is_pair(vm->at.stops)) vm->at.stops = VS_NIL;
  if (!vs_cons(vm, r[0], vm->at.stops, &vm->at.stops)) return vs_session_out_of_memory(s);
  vs_vector *v = details(r[0]);
  vs_gc_store(vm, v, &v->at[VS_STOP_FLAGS], vs_fix(s->flags));
  vm->condition = r[0];
  return VS_OUTCOME_STOPPED;
}

size_t vs_stop_depth(const vs_scheme *vm) {
  size_t n = 0;
  for (vs_value l = vm->at.stops; vs_is_pair(l); l = vs_cdr(l)) n++;
  return n;
}

void vs_stop_drop(vs_scheme *vm) {
  if (!vs_is_pair(vm->at.stops)) return;
  vm->at.stops = vs_cdr(vm->at.stops);
  vm->condition = vs_is_pair(vm->at.stops) ? vs_car(vm->at.stops) : VS_FALSE;
}

bool vs_session_bindings(vs_session *s, vs_value *out) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 3);
  vs_span at;
  r[0] = vs_as_condition(vs_car(vm->at.stops))->calls;
  r[1] = VS_NIL;
  const vs_value *call = vs_session_call(s, r[0], 0, &at);
  size_t first = call ? (size_t)(call - vs_as_vector(r[0])->at) : 0;
  for (size_t k = first + VS_CALL_VARIABLES; call && k < first + VS_CALL_WORDS; k += 2) {
    const vs_value *pair = vs_as_vector(r[0])->at + k;
    if (!vs_is_symbol(pair[0])) break;
    if (!vs_cons(vm, pair[0], pair[1], &r[2]) || !vs_cons(vm, r[2], r[1], &r[1])) return false;
  }
  return *out = r[1], true;
}

/* ---- texts that describe a stop ---- */

static vs_value name_of(vs_value procedure) {
  if (vs_is(procedure, VS_T_CLOSURE)) return vs_as_code(vs_as_closure(procedure)->code)->name;
  if (vs_is(procedure, VS_T_NATIVE)) return vs_as_native(procedure)->name;
  if (vs_is(procedure, VS_T_CASE) && vs_as_case(procedure)->count) return name_of(vs_as_case(procedure)->clause[0]);
  if (vs_is(procedure, VS_T_PARAMETER)) return vs_as_parameter(procedure)->name;
  return VS_FALSE;
}

/* Writes the call at which the program stopped, such as "(area 3 4)", or the value if it stopped after a call. */
static bool put_subject(vs_scheme *vm, vs_value stop, vs_stop_kind kind, vs_text *t) {
  VS_ROOTS(vm, r, 2);
  r[0] = stop;
  if (kind == VS_STOP_VALUE) return vs_session_put_value(vm, t, details(r[0])->at[VS_STOP_SUBJECT], 200);
  if (kind != VS_STOP_CALL) return true;
  vs_value name = name_of(details(r[0])->at[VS_STOP_SUBJECT]);
  const char *shown = vs_is_symbol(name) ? vs_as_symbol(name)->name : "#<procedure>";
  if (*shown == '%' && shown[1]) shown++;
  if (!vs_text_puts(t, "(") || !vs_text_puts(t, shown)) return false;
  r[1] = details(r[0])->at[VS_STOP_ARGUMENTS];
  vs_value keywords = details(r[0])->at[VS_STOP_KEYWORDS];
  uint64_t named = vs_is(keywords, VS_T_KEYWORDS) ? vs_as_keywords(keywords)->count : 0, count =
      (uint64_t)vs_list_length(r[1]);
  for (uint64_t i = 0; vs_is_pair(r[1]); r[1] = vs_cdr(r[1]), i++) {
    enum { MOST = 12 };
    if (i == MOST) return vs_text_puts(t, " ...)");
    if (!vs_text_puts(t, " ")) return false;
    if (i + named >= count) {
      vs_value word = vs_as_keywords(details(r[0])->at[VS_STOP_KEYWORDS])->name[i + named - count];
      if (!vs_text_puts(t, "#:") || !vs_text_puts(t, vs_as_symbol(word)->name) || !vs_text_puts(t, " ")) return false;
    }
    if (!vs_session_put_value(vm, t, vs_car(r[1]), 40)) return false;
  }
  return vs_text_puts(t, ")");
}

/* Returns the column after the datum that begins at `column` of the line. Columns count characters from 1. If the datum
 * ends on a later line, returns the column after the end of the given line. */
static uint32_t end_of(const char *line, uint32_t column) {
  const char *at = at_column(line, column);
  uint32_t lines = 0, end = column;
  const char *stop = vs_outline_datum(at, line + strlen(line), &lines);
  for (; at < stop; at++) end += ((unsigned char)*at & 0xC0) != 0x80;
  return end;
}

bool vs_stop_get(vs_scheme *vm, vs_stop_info *out) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 1);
  *out = (vs_stop_info){ .procedure = "", .text = "" };
  if (!vs_is_pair(vm->at.stops)) return false;
  r[0] = vs_car(vm->at.stops);
  vs_stop_kind kind = (vs_stop_kind)vs_fixnum(details(r[0])->at[VS_STOP_KIND]);
  out->kind = kind == VS_STOP_CALL ? VS_STOPPED_CALL : kind == VS_STOP_VALUE ? VS_STOPPED_VALUE : VS_STOPPED_BREAK;
  const vs_value *call = vs_session_call(s, vs_as_condition(r[0])->calls, 0, &out->at);
  if (call) {
    const vs_code *code = vs_as_code(vs_as_closure(call[VS_CALL_PROCEDURE])->code);
    if (vs_is_symbol(code->name)) out->procedure = vs_as_symbol(code->name)->name;
    char line[2048];
    if (vs_session_source_line(s, out->at.file, out->at.line, line, sizeof line)) {
      out->at.end_line = out->at.line;
      out->at.end_column = end_of(line, out->at.column);
      out->source_line = vs_store_text(s->bind.store, line, strlen(line));
    }
  }
  vs_text t;
  vs_text_open(vm, &t, 1000);
  if (put_subject(vm, r[0], kind, &t) && vs_text_end(&t)) {
    const char *text = vs_store_text(s->bind.store, t.at, t.count);
    if (text) out->text = text;
  }
  vs_text_close(&t);
  return true;
}

/* ---- continuing a stopped program ---- */

bool vs_session_take_stop(vs_session *s, vs_value *stop, unsigned *flags) {
  vs_scheme *vm = s->bind.vm;
  if (!vs_is_pair(vm->at.stops)) return false;
  *stop = vs_car(vm->at.stops);
  vm->at.stops = vs_cdr(vm->at.stops);
  *flags = (unsigned)vs_fixnum(details(*stop)->at[VS_STOP_FLAGS]);
  return true;
}
