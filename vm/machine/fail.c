/* Implements the errors of natives: creates error objects, and contains the texts of common errors. */
#include "vm/machine/fail.h"

#include <stdarg.h>
#include <stdio.h>

#include "vm/machine/native.h"
#include "vm/machine/signature.h"
#include "vm/values/heap.h"

const char *vs_noun(vs_scheme *vm, vs_value v) {
  static const char *const nouns[VS_T_COUNT] = {
#define VS_OBJECT(name, noun, first, count) noun,
#include "vm/values/object.def"
#undef VS_OBJECT
  };
  if (vs_is_double(v) || vs_is_fixnum(v)) return "a number";
  if (vs_is_char(v)) return "a character";
  if (vs_is_object(v)) {
    vs_object *o = vs_object_of(v);
    if (o->type == VS_T_FLAT && vm->flat && o->flags < vm->flat->tags) return vm->flat->type[o->flags].noun;
    if (o->type == VS_T_FOREIGN) return vs_as_foreign(v)->type->name;
    return nouns[o->type];
  }
  if (v == VS_TRUE) return "#t";
  if (v == VS_FALSE) return "#f";
  if (v == VS_NIL) return "the empty list";
  if (v == VS_EOF) return "the end of a file";
  return "nothing";
}

vs_status vs_fail_memory(vs_scheme *vm) {
  vm->condition = vm->at.no_memory;
  vm->over_limit = false;
  return VS_ERROR;
}

vs_status vs_fail_object(vs_scheme *vm, vs_value object) {
  vm->condition = object;
  return VS_ERROR;
}

static vs_status fail(vs_scheme *vm, vs_value kind, const vs_pos *place, vs_value irritants, const char *format,
                      va_list list) {
  VS_ROOTS(vm, r, 5);
  r[0] = kind; r[1] = irritants; r[4] = VS_FALSE;
  char text[1024];
  int used = 0;
  if (vm->native && !place) {
    vs_value name = vm->native->name;
    const char *shown = vs_is_symbol(name) ? vs_as_symbol(name)->name : "procedure";
    /* The message omits the % of an internal procedure's name: an error of %subtract shows subtract. */
    used = snprintf(text, sizeof text / 2, "%s: ", shown + (*shown == '%'));
    if (used > (int)sizeof text / 2 - 1) used = (int)sizeof text / 2 - 1;
  }
  va_list again;
  va_copy(again, list);
  int length = vsnprintf(text + used, sizeof text - (size_t)used, format, list);
  bool ok;
  if (length >= 0 && (size_t)(used + length) >= sizeof text) {        /* the text is too long for the array: writes it
                                                                       * again into allocated memory */
    size_t bytes = (size_t)used + (size_t)length + 1;
    char *more = vs_mem(vm, NULL, 0, bytes);
    ok = more != NULL;
    if (ok) {
      memcpy(more, text, (size_t)used);
      vsnprintf(more + used, bytes - (size_t)used, format, again);
      ok = vs_string_from_utf8(vm, more, bytes - 1, &r[2]);
      vs_mem(vm, more, bytes, 0);
    }
  } else {
    ok = vs_string_from_utf8(vm, text, strlen(text), &r[2]);
  }
  va_end(again);
  r[3] = VS_NIL;
  if (!ok || (!place && !vm->traceback->chain(vm, 64, &r[3]))) return VS_ERROR;
  if (!place && vm->config.keep_calls && !vm->traceback->variables(vm, &r[4])) return VS_ERROR;
  vs_condition *c = (vs_condition *)(void *)vs_gc_alloc(vm, VS_T_CONDITION, VS_WORDS(vs_condition));
  if (!c) return VS_ERROR;
  c->calls = r[4];
  c->kind = r[0]; c->irritants = r[1]; c->message = r[2]; c->chain = r[3];
  c->payload = VS_FALSE;
  c->place = place ? *place : vm->traceback->place(vm);
  vm->condition = vs_from_object(c);
  return VS_ERROR;
}

vs_status vs_fail(vs_scheme *vm, vs_value kind, const char *format, ...) {
  va_list list;
  va_start(list, format);
  vs_status s = fail(vm, kind, NULL, VS_NIL, format, list);
  va_end(list);
  return s;
}

vs_status vs_fail_with(vs_scheme *vm, vs_value kind, vs_value irritants, const char *format, ...) {
  va_list list;
  va_start(list, format);
  vs_status s = fail(vm, kind, NULL, irritants, format, list);
  va_end(list);
  return s;
}

vs_status vs_fail_at(vs_scheme *vm, vs_value kind, vs_pos place, vs_value irritants, const char *format, ...) {
  va_list list;
  va_start(list, format);
  vs_status s = fail(vm, kind, &place, irritants, format, list);
  va_end(list);
  return s;
}

vs_status vs_fail_type(vs_scheme *vm, int arg, const char *expected, vs_value got) {
  VS_ROOTS(vm, r, 1);
  char name[64];
  vs_signature_parameter(vm->native && vm->native->def ? vm->native->def->signature : "", arg, name, sizeof name);
  if (got == VS_ABSENT) return vs_fail(vm, vm->sym.type, "%s must be given: %s", name, expected);
  if (!vs_cons(vm, got, VS_NIL, &r[0])) return VS_ERROR;
  const char *noun = strncmp(expected, "a ", 2) == 0    ? expected + 2
                     : strncmp(expected, "an ", 3) == 0 ? expected + 3
                                                        : "";
  /* Avoids a message such as "pair must be a pair", where the parameter's name equals the noun. */
  if (strcmp(name, noun) == 0) return vs_fail_with(vm, vm->sym.type, r[0], "expected %s, got", expected);
  return vs_fail_with(vm, vm->sym.type, r[0], "%s must be %s, got", name, expected);
}

vs_status vs_fail_range(vs_scheme *vm, int arg, vs_value got, int64_t low, int64_t high) {
  VS_ROOTS(vm, r, 1);
  char name[64];
  vs_signature_parameter(vm->native && vm->native->def ? vm->native->def->signature : "", arg, name, sizeof name);
  if (!vs_cons(vm, got, VS_NIL, &r[0])) return VS_ERROR;
  if (high < low)
    return vs_fail_with(vm, vm->sym.range, r[0], "%s is out of range, there is nothing to choose from, got", name);
  if (high == VS_FIXNUM_MAX)
    return vs_fail_with(vm, vm->sym.range, r[0], "%s must be %lld or more, got", name, (long long)low);
  return vs_fail_with(vm, vm->sym.range, r[0], "%s must be from %lld to %lld, got", name, (long long)low,
                      (long long)high);
}

bool vs_arg_index(vs_scheme *vm, const vs_value *a, int arg, int64_t low, int64_t high, int64_t *out) {
  vs_value v = a[arg];
  if (!vs_is_fixnum(v)) return vs_fail_type(vm, arg, "an exact integer", v);
  if (vs_fixnum(v) < low || vs_fixnum(v) > high) return vs_fail_range(vm, arg, v, low, high);
  *out = vs_fixnum(v);
  return true;
}

bool vs_arg_type(vs_scheme *vm, const vs_value *a, int arg, int type) {
  VS_ASSERT(type >= 0 && type < VS_T_COUNT);
  if (vs_is(a[arg], type)) return true;
  static const char *const nouns[VS_T_COUNT] = {
#define VS_OBJECT(name, noun, first, count) noun,
#include "vm/values/object.def"
#undef VS_OBJECT
  };
  return vs_fail_type(vm, arg, nouns[type], a[arg]);
}

/* ---- lists ---- */
int64_t vs_list_length(vs_value list) {
  vs_value mark = list;                 /* Brent's cycle detection: one pointer advances, the other follows at powers of
                                         * two */
  int64_t n = 0, jump = 2;
  while (vs_is_pair(list)) {
    list = vs_cdr(list);
    if (list == mark) return -1;
    if (n++ == jump) { mark = list; jump *= 2; }
  }
  return list == VS_NIL ? n : -1;
}

