/* Implements the natives of functions.scm: levels of nested differentiations, dual numbers (numbers with a derivative),
 * procedures that keep their expression, and tapes (compiled expressions) as Scheme objects. */
#include "bind/functions/function_values.h"

#include <math.h>
#include <stdlib.h>

#include "bind/records.h"
#include "geometry/functions/enclosure.h"
#include "geometry/functions/formula_text.h"
#include "geometry/functions/sampling.h"
#include "model/store/array.h"
#include "vm/library/kept.h"
#include "vm/machine/fail.h"
#include "vm/numbers/dual.h"
#include "vm/values/heap.h"

/* ---- dual numbers ---- */

/* (%dual-level): returns the level of a new differentiation, which is higher than all earlier levels. */
static vs_status dual_level(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  if (!vs_lib_open(vm)) return VS_ERROR;
  vs_value last = vs_lib_get(vm, VS_LIB_DUALS);
  *out = vs_fix(vs_is_fixnum(last) ? vs_fixnum(last) + 1 : 1);
  vs_lib_set(vm, VS_LIB_DUALS, *out);
  return VS_OK;
}

/* (%dual level value slope): returns a dual number with this level, value and derivative. */
static vs_status dual(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_scalar(a[1]) && !vs_is(vs_dual_base(a[1]), VS_T_FLAT))
    return vs_fail_type(vm, 1, "a number or a point", a[1]);
  return vs_make_dual(vm, vs_fixnum(a[0]), a[1], a[2], out);
}

/* (%dual-slope level v): returns the derivative of v in the variable of the differentiation `level`; 0 if v does not
 * depend on this variable. Returns #f if v is no number, point or gvector. */
static vs_status dual_slope(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t level = vs_fixnum(a[0]);
  vs_value base = vs_dual_base(a[1]);
  bool flat = vs_is_flat(base, VS_FLAT_POINT) || vs_is_flat(base, VS_FLAT_VECTOR);
  if (!flat && !vs_is_number(base)) return *out = VS_FALSE, VS_OK;
  *out = vs_dual_slope(a[1], level);
  if (!flat || vs_is(vs_dual_base(*out), VS_T_FLAT)) return VS_OK;
  static const double zero[3] = { 0, 0, 0 };
  return vs_make_flat(vm, VS_FLAT_VECTOR, zero, 3, out);
}

/* ---- procedures that keep their expression ---- */

/* (%function closure note): returns a procedure that behaves like the closure and contains the note, its expression. */
static vs_status function(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is(a[0], VS_T_CLOSURE)) return vs_fail_type(vm, 0, "a procedure in Scheme", a[0]);
  vs_case *c = (vs_case *)(void *)vs_gc_alloc(vm, VS_T_CASE, VS_WORDS(vs_case) + 2);
  if (!c) return VS_ERROR;
  c->count = 1;
  c->clause[0] = a[0];
  c->clause[1] = a[1];
  *out = vs_from_object(c);
  return VS_OK;
}

static vs_status function_note(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_is(a[0], VS_T_CASE) ? vs_case_note(vs_as_case(a[0])) : VS_FALSE;
  return VS_OK;
}

/* ---- tapes: compiled expressions ---- */

static void release_tape(void *t) { vs_tape_free(t); }
const vs_foreign_type vs_tape_type = { .name = "a tape", .release = release_tape };

static void release_field(void *f) { vs_tape_field_release(f); }
const vs_foreign_type vs_tape_field_type = { .name = "a field", .release = release_field };

static vs_status tape_new(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_tape *t = vs_tape_new((uint32_t)vs_fixnum(a[0]));
  return t ? vs_make_foreign(vm, &vs_tape_type, t, 0, out) : vs_fail_memory(vm);
}

static vs_status step(vs_scheme *vm, const vs_tape *t, uint32_t number, vs_value *out) {
  if (number != UINT32_MAX) return *out = vs_fix(number), VS_OK;
  if (t->count >= VS_TAPE_STEPS)
    return vs_fail(vm, vm->sym.range, "the expression has more than %d operations", VS_TAPE_STEPS);
  return vs_fail_memory(vm);
}

static vs_status tape_constant(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  double d;
  if (vs_is_dual(a[1]))
    return vs_fail(vm, vm->sym.type,
                   "the expression holds a number that is being differentiated; kept expressions hold plain numbers");
  if (!vs_is_number(a[1])) return vs_fail_type(vm, 1, "a number", a[1]);
  return vs_number_double(vm, a[1], &d) ? step(vm, t, vs_tape_constant(t, d), out) : VS_ERROR;
}

static vs_status tape_input(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  return step(vm, t, vs_tape_input(t, (uint32_t)vs_fixnum(a[1])), out);
}

/* (%tape-op t name a b c): appends a step (an operation) to the tape, and returns the step's number. Returns #f if no
 * operation of this name has that many operands. */
static vs_status tape_op(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  uint32_t of[3] = { 0, 0, 0 };
  for (int i = 0; i < n - 2; i++) of[i] = (uint32_t)vs_fixnum(a[2 + i]);
  vs_tape_operator op = vs_tape_named(vs_as_symbol(a[1])->name, n - 2);
  if (op == VS_TAPE_CONSTANT) return *out = VS_FALSE, VS_OK;
  return step(vm, t, vs_tape_add(t, op, of[0], of[1], of[2]), out);
}

/* (%tape-field t field x y z): appends a step that computes the value of a field at a point, and returns the step's
 * number. */
static vs_status tape_field(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  vs_tape_field *f = vs_foreign_get(a[1], &vs_tape_field_type);
  uint32_t at[3];
  for (int i = 0; i < 3; i++) at[i] = (uint32_t)vs_fixnum(a[2 + i]);
  return step(vm, t, vs_tape_add_field(t, f, at[0], at[1], at[2]), out);
}

/* (%tape-done t step ...): returns a tape whose outputs are the results of these steps of t. It contains only the steps
 * that these outputs need. */
static vs_status tape_done(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  t->outputs = (uint32_t)(n - 1);
  for (int i = 1; i < n; i++) t->output[i - 1] = (uint32_t)vs_fixnum(a[i]);
  vs_tape *c = vs_tape_compact(t);
  return c ? vs_make_foreign(vm, &vs_tape_type, c, 0, out) : vs_fail_memory(vm);
}

/* (%tape-level t level): returns a tape that computes the value of t minus `level`. */
static vs_status tape_level(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  double level;
  if (!vs_number_double(vm, a[1], &level)) return VS_ERROR;
  vs_tape *c = vs_tape_compact(vs_foreign_get(a[0], &vs_tape_type));
  uint32_t less = c ? vs_tape_add(c, VS_TAPE_SUB, c->output[0], vs_tape_constant(c, level), 0) : UINT32_MAX;
  if (less == UINT32_MAX) return vs_tape_free(c), vs_fail_memory(vm);
  c->output[0] = less;
  return vs_make_foreign(vm, &vs_tape_type, c, 0, out);
}

static vs_status tape_outputs(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  return *out = vs_fix(((const vs_tape *)vs_foreign_get(a[0], &vs_tape_type))->outputs), VS_OK;
}

/* (%tape-text t output language names): returns the formula for one output of t as text, or #f if the language cannot
 * express it. */
static vs_status tape_text(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  const vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  const char *names[VS_TAPE_INPUTS] = { NULL };
  if (t->field_count)
    return vs_fail(vm, vm->sym.type, "the function holds the distance from a solid, which has no formula");
  vs_value l = a[3];
  for (uint32_t i = 0; i < t->inputs && vs_is_pair(l); i++, l = vs_cdr(l)) names[i] = vs_as_symbol(vs_car(l))->name;
  bool too_long;
  char *text = vs_formula_text(t, (uint32_t)vs_fixnum(a[1]), (vs_formula_language)vs_fixnum(a[2]), names, &too_long);
  if (!text) return too_long ? (*out = VS_FALSE, VS_OK) : vs_fail_memory(vm);
  vs_text s;
  vs_text_open(vm, &s, 0);
  bool ok = vs_text_puts(&s, text) && vs_text_to_string(&s, out);
  vs_text_close(&s);
  free(text);
  return ok;
}

/* ---- values at the points of a grid ---- */

/* (%tape-samples t ranges): returns a vector of the values of t at all points of a grid; the last coordinate varies
 * fastest. The values of a tape with three outputs are points. ranges: for each coordinate #(a b n), meaning n numbers
 * from a to b, including both. */
static vs_status tape_samples(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  const vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  vs_sample_range r[VS_TAPE_INPUTS];
  int64_t total = 1;
  for (uint32_t i = 0; i < t->inputs; i++) {
    const vs_vector *v = vs_as_vector(vs_as_vector(a[1])->at[i]);
    if (!vs_number_double(vm, v->at[0], &r[i].a) || !vs_number_double(vm, v->at[1], &r[i].b)) return VS_ERROR;
    r[i].n = vs_fixnum(v->at[2]);
    vs_sample_begin(&r[i]);
    total *= r[i].n; /* functions.scm has checked that the number of points is not too large */
  }
  enum { BATCH = VS_SAMPLE_BATCH };
  double in[VS_TAPE_INPUTS][BATCH], results[VS_TAPE_OUTPUTS][BATCH];
  const double *from[VS_TAPE_INPUTS];
  double *to[VS_TAPE_OUTPUTS];
  for (int i = 0; i < VS_TAPE_INPUTS; i++) from[i] = in[i];
  for (int i = 0; i < VS_TAPE_OUTPUTS; i++) to[i] = results[i];
  VS_ROOTS(vm, root, 1);
  vs_vector *made = (vs_vector *)(void *)vs_gc_alloc(vm, VS_T_VECTOR, 2 + (size_t)total); /* the new vector contains
                                                                                           * zeros */
  if (!made) return VS_ERROR;
  made->length = (size_t)total;
  a[1] = vs_from_object(made);
  vs_sampler *s = vs_sampler_new(t, 0);
  if (!s) return vs_fail_memory(vm);
  bool ok = true;
  for (int64_t at = 0; ok && at < total; at += BATCH) {
    int count = total - at < BATCH ? (int)(total - at) : BATCH;
    vs_sample_points(r, t->inputs, in, count);
    vs_sample(s, from, (size_t)count, to);
    if (t->outputs == 1) { /* doubles contain no addresses, so no write barrier is needed */
      vs_value *values = vs_as_vector(a[1])->at + at;
      memcpy(values, results[0], (size_t)count * sizeof *values);
      if (vs_sample_nan(results[0], count))
        for (int k = 0; k < count; k++) values[k] = vs_flonum(results[0][k]);
    }
    for (int k = 0; ok && t->outputs > 1 && k < count; k++) {
      ok = vs_make_flat(vm, VS_FLAT_POINT, (double[]){ results[0][k], results[1][k], results[2][k] }, 3, &root[0]);
      if (ok) vs_gc_store(vm, vs_as_vector(a[1]), &vs_as_vector(a[1])->at[at + k], root[0]);
    }
    ok = ok && vs_poll(vm, (uint64_t)count * t->count / 8 + 1);
  }
  vs_sampler_free(s);
  if (t->outputs == 1) vs_gc_forget(vs_object_of(a[1]));
  *out = a[1];
  return ok;
}

/* ---- intervals of values ---- */

static bool enclosure_of(vs_scheme *vm, vs_value v, vs_enclosure *out) {
  *out = (vs_enclosure){ 0, 0, false };
  if (vs_is_flat(v, VS_FLAT_INTERVAL)) return out->low = vs_as_flat(v)->at[0], out->high = vs_as_flat(v)->at[1], true;
  double d;
  if (!vs_is_number(v))
    return vs_fail(vm, vm->sym.type, "an interval is combined with numbers and intervals, not with %s", vs_noun(vm, v));
  if (!vs_number_double(vm, v, &d)) return false;
  out->low = out->high = d;
  if (!vs_is_fixnum(v) && !vs_is_double(v)) /* an interval around x, the nearest double of v: v, a bignum or ratio, may
                                             * differ from x */
    out->low = nextafter(d, -INFINITY), out->high = nextafter(d, INFINITY);
  return true;
}

bool vs_interval_call(vs_scheme *vm, const char *name, const vs_value *a, int n, vs_value *out) {
  vs_enclosure of[3] = { { 0, 0, false } };
  for (int i = 0; i < n && i < 2; i++)
    if (!enclosure_of(vm, a[i], &of[i])) return false;
  vs_enclosure r;
  vs_tape_operator op = vs_tape_named(name, n);
  if (!strcmp(name, "log") && n == 2)
    r = vs_enclose(VS_TAPE_DIV, vs_enclose(VS_TAPE_LOG, of[0], of[0], of[0]),
                   vs_enclose(VS_TAPE_LOG, of[1], of[1], of[1]), of[2]);
  else if (op == VS_TAPE_CONSTANT)
    return vs_fail(vm, vm->sym.type, "an interval is no argument of this operation");
  else
    r = vs_enclose(op, of[0], of[1], of[2]);
  if (r.low != r.low) {
    VS_ROOTS(vm, list, 1);
    if (!vs_cons(vm, a[vs_is(a[0], VS_T_FLAT) ? 0 : 1], VS_NIL, &list[0])) return false;
    return vs_fail_with(vm, vm->sym.range, list[0], "the operation has no value anywhere in the interval");
  }
  if (op == VS_TAPE_LESS || op == VS_TAPE_ATMOST || op == VS_TAPE_EQUAL) {
    if (r.low == r.high) return *out = vs_bool(r.low != 0), true;
    return vs_fail(vm, vm->sym.range,
                   "%s is true for only a part of the intervals; compare interval-low or interval-high instead", name);
  }
  return vs_make_flat(vm, VS_FLAT_INTERVAL, (double[]){ r.low, r.high }, 2, out);
}

static vs_status interval(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  double d[2];
  for (int i = 0; i < 2; i++) {
    if (!vs_is_number(a[i])) return vs_fail_type(vm, i, "a number", a[i]);
    if (!vs_number_double(vm, a[i], &d[i])) return VS_ERROR;
    if (d[i] != d[i]) return vs_fail_type(vm, i, "a number", a[i]);
    if (!vs_is_fixnum(a[i]) && !vs_is_double(a[i])) d[i] = nextafter(d[i], i ? INFINITY : -INFINITY);
  }
  if (d[0] > d[1]) return vs_fail_type(vm, 1, "no smaller than low", a[1]);
  return vs_make_flat(vm, VS_FLAT_INTERVAL, d, 2, out);
}
static vs_status is_interval(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  return *out = vs_bool(vs_is_flat(a[0], VS_FLAT_INTERVAL)), VS_OK;
}
static vs_status interval_end(vs_scheme *vm, const vs_value *a, int i, vs_value *out) {
  if (!vs_is_flat(a[0], VS_FLAT_INTERVAL)) return vs_fail_type(vm, 0, "an interval", a[0]);
  return *out = vs_flonum(vs_as_flat(a[0])->at[i]), VS_OK;
}
static vs_status interval_low(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, interval_end(vm, a, 0, out);
}
static vs_status interval_high(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, interval_end(vm, a, 1, out);
}

/* (%tape-bounds t vector): returns an interval that contains all values of t's output for inputs in the intervals of
 * the vector. */
static vs_status tape_bounds(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  const vs_tape *t = vs_foreign_get(a[0], &vs_tape_type);
  vs_enclosure in[VS_TAPE_INPUTS], *work = NULL;
  size_t room = 0;
  for (uint32_t i = 0; i < t->inputs; i++)
    if (!enclosure_of(vm, vs_as_vector(a[1])->at[i], &in[i])) return VS_ERROR;
  if (!VS_GROW(work, room, t->count + 1)) return vs_fail_memory(vm);
  vs_enclosure r = vs_enclose_tape(t, in, work);
  free(work);
  if (r.low != r.low) return vs_fail(vm, vm->sym.range, "the function has no value anywhere in these intervals");
  return vs_make_flat(vm, VS_FLAT_INTERVAL, (double[]){ r.low, r.high }, 2, out);
}

static const vs_native_def defs[] = {
  { "interval", "low high", interval, 0, "all numbers from low to high" },
  { "interval?", "x", is_interval, 0, NULL },
  { "interval-low", "interval", interval_low, 0, NULL },
  { "interval-high", "interval", interval_high, 0, NULL },
  { "%tape-bounds %function-bounds", "tape intervals", tape_bounds, 0, NULL },
  { "%dual-level", "", dual_level, 0, NULL },
  { "%dual", "level value slope", dual, 0, NULL },
  { "%dual-slope", "level v", dual_slope, 0, NULL },
  { "%function", "procedure note", function, 0, NULL },
  { "%function-note", "f", function_note, 0, NULL },
  { "%tape-new", "inputs", tape_new, 0, NULL },
  { "%tape-constant", "tape number", tape_constant, 0, NULL },
  { "%tape-input", "tape number", tape_input, 0, NULL },
  { "%tape-op", "tape name [a b c]", tape_op, 0, NULL },
  { "%tape-field", "tape field x y z", tape_field, 0, NULL },
  { "%tape-done", "tape . steps", tape_done, 0, NULL },
  { "%tape-level", "tape level", tape_level, 0, NULL },
  { "%tape-outputs", "tape", tape_outputs, 0, NULL },
  { "%tape-text %function-text", "tape output language names", tape_text, 0, NULL },
  { "%tape-samples", "tape ranges", tape_samples, 0, NULL },
  { 0 },
};
const vs_native_table vs_function_table = { "functions", defs };
