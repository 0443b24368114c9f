/* Implements define-parameter and report. define-parameter declares values that the command line, a slider or a host
 * may set before the program runs. report stores numbers that the host may read after the program has run. */
#include "bind/parameters.h"

#include <math.h>
#include <stdio.h>

#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/procedure.h"
#include "bind/call/refuse.h"
#include "bind/call/take.h"
#include "bind/print.h"
#include "bind/records.h"
#include "bind/solids/design_rules.h"
#include "bind/state.h"
#include "vm/front/reader.h"
#include "vm/machine/activation.h"
#include "vm/machine/fail.h"
#include "vm/numbers/number.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"

enum { KEY_MIN, KEY_MAX, KEY_STEP, KEY_CHOICES, KEY_LABEL, KEY_GROUP, KEY_UNIT };

static void unset(vs_bind *b, const char *name) {
  for (size_t i = 0; i < b->setting_count; i++)
    if (strcmp(b->settings[i].name, name) == 0) {
      b->settings[i] = b->settings[--b->setting_count];
      return;
    }
}

bool vs_bind_set_parameter(vs_bind *b, const char *name, const char *datum) {
  if (!datum) return unset(b, name), true;
  const char *n = vs_store_text(b->store, name, strlen(name)), *d = vs_store_text(b->store, datum, strlen(datum));
  if (!n || !d) return false;
  for (size_t i = 0; i < b->setting_count; i++)
    if (b->settings[i].name == n) return b->settings[i].datum = d, b->settings[i].used = false, true;
  if (b->setting_count == b->setting_room) {
    size_t room = b->setting_room ? b->setting_room * 2 : 8;
    vs_bind_setting *more =
        vs_store_realloc(b->store, b->settings, b->setting_room * sizeof *more, room * sizeof *more);
    if (!more) return false;
    b->settings = more, b->setting_room = room;
  }
  b->settings[b->setting_count++] = (vs_bind_setting){ n, d, false };
  return true;
}

/* Returns the value as text for the host. If memory is out, sets the error and returns NULL. */
static const char *written(vs_args *f, vs_value v) {
  vs_text t;
  const char *text = NULL;
  vs_text_open(f->vm, &t, 0);
  if (vs_print(f->vm, v, vs_is_string(v) ? VS_PRINT_DISPLAY : VS_PRINT_WRITE, &t)) {
    text = vs_store_text(f->store, t.at ? t.at : "", t.count);
    if (!text) vs_fail_memory(f->vm);
  }
  vs_text_close(&t);
  return text;
}

static vs_bind_parameter_type type_of(vs_value v) {
  if (v == VS_TRUE || v == VS_FALSE) return VS_P_BOOLEAN;
  if (vs_is_exact_integer(v)) return VS_P_INTEGER;
  if (vs_is_number(v)) return VS_P_REAL;
  return vs_is_string(v) ? VS_P_STRING : VS_P_DATUM;
}
static const char *type_name(vs_bind_parameter_type t) {
  switch (t) {
    case VS_P_BOOLEAN: return "#t or #f";
    case VS_P_INTEGER: return "an exact integer";
    case VS_P_REAL: return "a number";
    case VS_P_STRING: return "a string";
    case VS_P_DATUM: break;
  }
  return "one datum";
}

/* Refuses a parameter's value. set: whether the value came from the command line. If it did, the exit status is 2, and
 * a note shows the place of the parameter's definition. */
static vs_status wrong(vs_args *f, bool set, const char *name, const char *must, const char *got) {
  f->bind->bad_parameter = set;
  return vs_fail_at(f->vm, f->vm->sym.range, vs_call_place(f->vm), VS_NIL, "parameter %s must be %s, got %s", name,
                    must, got);
}

/* Sets xyz to the coordinates in `list`, the form (xyz x y z) or (xy x y) that the reader has read from `datum`.
 * Returns false if the form is no point. */
static bool point_setting(const vs_args *f, const char *datum, vs_value list, double xyz[3]) {
  const char *name = datum + strspn(datum, " (");
  size_t length = strcspn(name, " ()"), count = 0;
  xyz[2] = 0;
  if (!vs_is_pair(list) || (length != 2 && length != 3) || strncmp(name, "xyz", length) != 0) return false;
  for (list = vs_cdr(list); vs_is_pair(list) && count < length; list = vs_cdr(list))
    if (!vs_is_number(vs_car(list)) || !vs_number_double(f->vm, vs_car(list), &xyz[count++])) return false;
  return list == VS_NIL && count == length && isfinite(xyz[0]) && isfinite(xyz[1]) && isfinite(xyz[2]);
}

/* Sets *out to the user's setting of a parameter, converted to the type of the default value `like`. An exact
 * default requires an exact number; an inexact default accepts any number. If the default is a string, `datum` needs
 * no quotes. */
static vs_status read_setting(vs_args *f, const char *name, const char *datum, vs_value like, vs_value *out) {
  vs_bind_parameter_type t = type_of(like);
  if (t == VS_P_STRING) return vs_string_from_utf8(f->vm, datum, strlen(datum), out);
  size_t bytes = strlen(datum), used = 0;
  bool point = vs_is_flat(like, VS_FLAT_POINT);
  VS_ROOTS(f->vm, kept, 1); /* a root of the garbage collector: keeps the default, since the reader may move it */
  kept[0] = like;
  if (!vs_read_datum(f->vm, datum, bytes, out, &used)) {
    VS_ROOTS(f->vm, r, 1);
    r[0] = vs_is(f->vm->condition, VS_T_CONDITION) ? vs_as_condition(f->vm->condition)->message : VS_FALSE;
    char *text;
    size_t length;
    if (!vs_is_string(r[0]) || vs_as_condition(f->vm->condition)->kind != f->vm->sym.read ||
        !vs_bind_take_text(f->vm, r[0], &text, &length))
      return VS_ERROR;
    f->bind->bad_parameter = true;
    vs_fail_at(f->vm, f->vm->sym.range, vs_call_place(f->vm), VS_NIL, "parameter %s cannot be %s: %s", name, datum,
               text);
    vs_mem(f->vm, text, length, 0);
    return VS_ERROR;
  }
  while (used < bytes && (datum[used] == ' ' || datum[used] == '\t')) used++;
  if (*out == VS_EOF || used < bytes) return wrong(f, true, name, type_name(t), datum);
  if (point) {
    double xyz[3];
    if (!point_setting(f, datum, *out, xyz)) return wrong(f, true, name, "a point, (xyz x y z)", datum);
    return vs_bind_give_point(f, vs_v3(xyz[0], xyz[1], xyz[2]), out);
  }
  bool fits = t == VS_P_DATUM || type_of(*out) == t || (t == VS_P_REAL && vs_is_number(*out));
  if (!fits && t == VS_P_INTEGER && vs_is_number(*out)) {
    char must[200], whole[32];
    double d;
    if (!vs_number_double(f->vm, kept[0], &d)) return VS_ERROR;
    vs_bind_number_text(whole, d);
    snprintf(must, sizeof must,
        "an exact integer, because its default %s is one (with the default %s.0 it takes any number), got", whole,
            whole);
    f->bind->bad_parameter = true;
    return vs_fail_at(f->vm, f->vm->sym.range, vs_call_place(f->vm), VS_NIL, "parameter %s must be %s %s", name,
        must, datum);
  }
  return fits ? VS_OK : wrong(f, true, name, type_name(t), datum);
}

static vs_status in_range(vs_args *f, const vs_bind_parameter *p, vs_value v, bool set) {
  double d;
  char low[32], high[32], must[96];
  if (f->key[KEY_CHOICES].given) {
    size_t at = 0;
    char list[400] = "one of";
    at = strlen(list);
    for (size_t i = 0; i < p->choice_count; i++) {
      if (!strcmp(p->choices[i], p->value)) return VS_OK;
      int n = snprintf(list + at, sizeof list - at, " %s", p->choices[i]);
      if (n > 0 && at + (size_t)n < sizeof list) at += (size_t)n;
    }
    return wrong(f, set, p->name, list, p->value);
  }
  if ((!f->key[KEY_MIN].given && !f->key[KEY_MAX].given) || !vs_is_number(v)) return VS_OK;
  if (!vs_number_double(f->vm, v, &d)) return VS_ERROR;
  bool low_ok = !f->key[KEY_MIN].given || d >= p->min, high_ok = !f->key[KEY_MAX].given || d <= p->max;
  if (low_ok && high_ok) return VS_OK;
  vs_bind_number_text(low, p->min), vs_bind_number_text(high, p->max);
  if (f->key[KEY_MIN].given && f->key[KEY_MAX].given) snprintf(must, sizeof must, "from %s to %s", low, high);
  else
    snprintf(must, sizeof must, "%s %s", f->key[KEY_MIN].given ? "at least" : "at most",
             f->key[KEY_MIN].given ? low : high);
  return wrong(f, set, p->name, must, p->value);
}

static vs_status read_choices(vs_args *f, vs_bind_parameter *p) {
  vs_value list = f->key[KEY_CHOICES].value;
  int64_t n = vs_list_length(list);
  if (n < 1) return vs_bind_refuse(f, "#:choices", "a list of values", list);
  p->choices = vs_store_realloc(f->store, NULL, 0, (size_t)n * sizeof *p->choices);
  if (!p->choices) return vs_fail_memory(f->vm);
  p->choice_count = (size_t)n;
  VS_ROOTS(f->vm, r, 1);
  r[0] = list;
  for (size_t i = 0; i < p->choice_count; i++, r[0] = vs_cdr(r[0]))
    if (!(p->choices[i] = written(f, vs_car(r[0])))) return VS_ERROR;
  return VS_OK;
}

static void set_range(vs_args *f, vs_bind_parameter *p, double d) {
  const vs_arg *k = f->key;
  p->has_range = true;
  p->least = k[KEY_MIN].given, p->most = k[KEY_MAX].given;
  p->min = k[KEY_MIN].given                           ? k[KEY_MIN].real
           : k[KEY_MAX].given && k[KEY_MAX].real <= 0 ? 2 * fmin(d, k[KEY_MAX].real)
                                                      : fmin(0, 2 * d);
  p->max = k[KEY_MAX].given ? k[KEY_MAX].real : fmax(fmax(0, 2 * d), p->min);
  /* Without #:min and #:max, a range cannot be computed from a default of 0, so the range is 0 to 1. */
  if (p->max == p->min && !k[KEY_MIN].given && !k[KEY_MAX].given) p->max = p->min + 1;
  p->step = k[KEY_STEP].given ? k[KEY_STEP].real : p->type == VS_P_INTEGER ? 1 : 0;
}

/* Stores the parameter p for the host. A second definition of the same name (at the prompt) replaces the first. */
static vs_status keep(vs_args *f, const vs_bind_parameter *p) {
  vs_bind *b = f->bind;
  for (size_t i = 0; i < b->parameter_count; i++)
    if (b->parameters[i].name == p->name) {
      vs_store_realloc(b->store, b->parameters[i].choices, b->parameters[i].choice_count * sizeof *p->choices, 0);
      return b->parameters[i] = *p, VS_OK;
    }
  if (b->parameter_count == b->parameter_room) {
    size_t room = b->parameter_room ? b->parameter_room * 2 : 8;
    vs_bind_parameter *more =
        vs_store_realloc(b->store, b->parameters, b->parameter_room * sizeof *more, room * sizeof *more);
    if (!more) return vs_fail_memory(f->vm);
    b->parameters = more, b->parameter_room = room;
  }
  b->parameters[b->parameter_count++] = *p;
  return VS_OK;
}

static vs_status define(vs_args *f, vs_bind_parameter *p, vs_value *value, vs_value first) {
  const vs_arg *k = f->key;
  vs_store *s = f->store;
  if (!(p->name = vs_store_text(s, f->arg[0].text.at, f->arg[0].text.length))) return vs_fail_memory(f->vm);
  p->label = k[KEY_LABEL].given ? vs_store_text(s, k[KEY_LABEL].text.at, k[KEY_LABEL].text.length) : p->name;
  p->group = k[KEY_GROUP].given ? vs_store_text(s, k[KEY_GROUP].text.at, k[KEY_GROUP].text.length) : "";
  p->unit = k[KEY_UNIT].given ? vs_store_text(s, k[KEY_UNIT].text.at, k[KEY_UNIT].text.length) : "";
  if (!p->label || !p->group || !p->unit) return vs_fail_memory(f->vm);
  if (vs_is_procedure(first))
    return vs_bind_refuse(f, "default", "a number, a text between double quotes, a point, #t or #f", first);
  p->type = type_of(first);
  p->at = vs_call_place(f->vm);
  double d;
  if (p->type == VS_P_INTEGER || p->type == VS_P_REAL) {
    if (!vs_number_double(f->vm, first, &d)) return VS_ERROR;
    set_range(f, p, d);
    if (p->min > p->max) return vs_fail(f->vm, f->vm->sym.range, "#:min must not be more than #:max");
  } else if (k[KEY_MIN].given || k[KEY_MAX].given || k[KEY_STEP].given)
    return vs_fail(f->vm, f->vm->sym.range, "#:min, #:max and #:step are for numbers; %s is %s", p->name,
                   vs_noun(f->vm, first));
  if (k[KEY_CHOICES].given && !read_choices(f, p)) return VS_ERROR;
  if (k[KEY_CHOICES].given) p->has_range = false;
  if (!(p->value = p->default_value = written(f, first)) || !in_range(f, p, first, false)) return VS_ERROR;
  for (size_t i = 0; i < f->bind->setting_count; i++) {
    vs_bind_setting *set = &f->bind->settings[i];
    if (set->name != p->name) continue;
    set->used = true;
    if (!read_setting(f, p->name, set->datum, first, value)) return VS_ERROR;
    if (!(p->value = written(f, *value)) || !in_range(f, p, *value, true)) return VS_ERROR;
  }
  return keep(f, p);
}

/* (%define-parameter 'name default #:min ...): returns the value of the parameter. */
vs_status vs_p_parameter(vs_args *f, vs_value *out) {
  vs_bind_parameter p = { 0 };
  VS_ROOTS(f->vm, r, 2);
  r[0] = r[1] = f->arg[1].value;
  vs_status s = define(f, &p, &r[0], r[1]);
  if (!s) vs_store_realloc(f->store, p.choices, p.choice_count * sizeof *p.choices, 0);
  *out = r[0];
  return s;
}

/* ---- numbers of the model ---- */

/* (report name value): stores the number for the host, and returns it. A later number with the same name replaces
 * it. */
vs_status vs_p_report(vs_args *f, vs_value *out) {
  vs_bind *b = f->bind;
  const char *name = vs_store_text(f->store, f->arg[0].text.at, f->arg[0].text.length);
  size_t i = 0;
  if (!name) return vs_fail_memory(f->vm);
  while (i < b->report_count && b->reports[i].name != name) i++;
  if (i == b->report_room) {
    size_t room = b->report_room ? b->report_room * 2 : 8;
    vs_bind_report *more = vs_store_realloc(b->store, b->reports, b->report_room * sizeof *more, room * sizeof *more);
    if (!more) return vs_fail_memory(f->vm);
    b->reports = more, b->report_room = room;
  }
  if (i == b->report_count) b->report_count++;
  b->reports[i] = (vs_bind_report){ name, f->arg[1].real };
  return *out = f->arg[1].value, VS_OK;
}

bool vs_bind_keep_rule(vs_bind *b, const vs_design_rule *rule) {
  if (!vs_store_grow(b->store, &b->design_rules, &b->design_rule_room, b->design_rule_count + 1, sizeof *rule))
    return false;
  b->design_rules[b->design_rule_count++] = *rule;
  return true;
}
