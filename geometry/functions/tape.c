/* Builds tapes, numerical expressions as lists of operations (tape.h). */
#include "geometry/functions/tape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

static const struct {
  const char *name;
  int operands;
} operators[VS_TAPE_OPERATORS] = {
  [VS_TAPE_CONSTANT] = { "", 0 },
  [VS_TAPE_INPUT] = { "", 0 },
#define VS_OPERATOR(id, name, operands, binds, pov, scad, js) [VS_TAPE_##id] = { name, operands },
#include "geometry/functions/operators.def"
};

int vs_tape_operands(vs_tape_operator op) { return operators[op].operands; }

vs_tape_operator vs_tape_named(const char *name, int n) {
  if (!strcmp(name, "-") && n == 1) return VS_TAPE_NEG;
  if (!strcmp(name, "atan") && n == 1) return VS_TAPE_ATAN;
  for (int i = VS_TAPE_INPUT + 1; i < VS_TAPE_OPERATORS; i++)
    if (operators[i].operands == n && !strcmp(name, operators[i].name)) return (vs_tape_operator)i;
  return VS_TAPE_CONSTANT;
}

vs_tape *vs_tape_new(uint32_t inputs) {
  vs_tape *t = NULL;
  size_t room = 0;
  VS_ASSERT(inputs <= VS_TAPE_INPUTS);
  if (VS_GROW(t, room, 1)) *t = (vs_tape){ .inputs = inputs };
  return t;
}

void vs_tape_field_release(vs_tape_field *f) {
  if (f && --f->refs == 0) f->release(f);
}

void vs_tape_free(vs_tape *t) {
  if (!t) return;
  for (size_t i = 0; i < t->field_count; i++) vs_tape_field_release(t->field[i]);
  free(t->field);
  free(t->step);
  free(t->index);
  free(t);
}

double vs_tape_apply(vs_tape_operator op, double a, double b, double c) {
  switch (op) {
  case VS_TAPE_ADD: return a + b;
  case VS_TAPE_SUB: return a - b;
  case VS_TAPE_MUL: return a * b;
  case VS_TAPE_DIV: return a / b;
  case VS_TAPE_NEG: return -a;
  case VS_TAPE_SQUARE: return a * a;
  case VS_TAPE_ABS: return fabs(a);
  case VS_TAPE_SQRT: return sqrt(a);
  case VS_TAPE_CBRT: return cbrt(a);
  case VS_TAPE_EXP: return exp(a);
  case VS_TAPE_LOG: return log(a);
  case VS_TAPE_SIN: return sin(a);
  case VS_TAPE_COS: return cos(a);
  case VS_TAPE_TAN: return tan(a);
  case VS_TAPE_ASIN: return asin(a);
  case VS_TAPE_ACOS: return acos(a);
  case VS_TAPE_ATAN: return atan(a);
  case VS_TAPE_ATAN2: return atan2(a, b);
  case VS_TAPE_SINH: return sinh(a);
  case VS_TAPE_COSH: return cosh(a);
  case VS_TAPE_TANH: return tanh(a);
  case VS_TAPE_POW: return pow(a, b);
  case VS_TAPE_MIN: return a < b || a != a ? a : b;
  case VS_TAPE_MAX: return a > b || a != a ? a : b;
  case VS_TAPE_FLOOR: return floor(a);
  case VS_TAPE_CEIL: return ceil(a);
  case VS_TAPE_LESS: return a < b;
  case VS_TAPE_ATMOST: return a <= b;
  case VS_TAPE_EQUAL: return a == b;
  case VS_TAPE_CHOOSE: return a != 0 ? b : c;
  case VS_TAPE_CONSTANT:
  case VS_TAPE_INPUT:
  case VS_TAPE_FIELD: /* cannot occur, because fields are not computed from numbers alone */
  case VS_TAPE_OPERATORS: break;
  }
  return NAN;
}

/* ---- steps; equal steps are stored once ---- */

static uint64_t step_hash(const vs_tape_step *s) {
  uint64_t h = s->op * UINT64_C(0x9E3779B97F4A7C15), v;
  memcpy(&v, &s->value, sizeof v);
  h = (h ^ v) * UINT64_C(0xBF58476D1CE4E5B9);
  for (int i = 0; i < 3; i++) h = (h ^ h >> 29 ^ s->of[i]) * UINT64_C(0x94D049BB133111EB);
  return h ^ h >> 31;
}

static bool same_step(const vs_tape_step *a, const vs_tape_step *b) {
  return a->op == b->op && !memcmp(a->of, b->of, sizeof a->of) && !memcmp(&a->value, &b->value, sizeof a->value);
}

static bool index_grow(vs_tape *t) {
  size_t slots = t->slots ? 2 * t->slots : 64;
  uint32_t *index = NULL;
  size_t room = 0;
  if (!VS_GROW(index, room, slots)) return false;
  memset(index, 0, slots * sizeof *index);
  for (size_t i = 0; i < t->count; i++) {
    size_t k = step_hash(&t->step[i]) & (slots - 1);
    while (index[k]) k = (k + 1) & (slots - 1);
    index[k] = (uint32_t)i + 1;
  }
  free(t->index);
  t->index = index, t->slots = slots;
  return true;
}

static uint32_t step_number(vs_tape *t, const vs_tape_step *s) {
  if (2 * t->count >= t->slots && !index_grow(t)) return UINT32_MAX;
  size_t k = step_hash(s) & (t->slots - 1);
  for (; t->index[k]; k = (k + 1) & (t->slots - 1))
    if (same_step(&t->step[t->index[k] - 1], s)) return t->index[k] - 1;
  if (t->count == VS_TAPE_STEPS) return UINT32_MAX;
  if (t->count == t->room) {
    if (!VS_GROW(t->step, t->room, t->count + 1)) return UINT32_MAX;
  }
  t->step[t->count++] = *s;
  t->index[k] = (uint32_t)t->count;
  return (uint32_t)t->count - 1;
}

uint32_t vs_tape_constant(vs_tape *t, double value) {
  vs_tape_step s = { VS_TAPE_CONSTANT, { 0, 0, 0 }, value };
  return step_number(t, &s);
}
uint32_t vs_tape_input(vs_tape *t, uint32_t number) {
  vs_tape_step s = { VS_TAPE_INPUT, { number, 0, 0 }, 0 };
  VS_ASSERT(number < t->inputs);
  return step_number(t, &s);
}

/* Returns true if step i of the tape is the constant `value`. */
static bool is_constant(const vs_tape *t, uint32_t i, double value) {
  VS_ASSERT(i < t->count);
  return t->step[i].op == VS_TAPE_CONSTANT && t->step[i].value == value;
}

uint32_t vs_tape_add(vs_tape *t, vs_tape_operator op, uint32_t a, uint32_t b, uint32_t c) {
  vs_tape_step s = { (uint32_t)op, { a, b, c }, 0 };
  int n = operators[op].operands;
  bool constant = true;
  double v[3] = { 0, 0, 0 };
  VS_ASSERT(op > VS_TAPE_INPUT && op < VS_TAPE_OPERATORS);
  for (int i = 0; i < n; i++)
    if (s.of[i] >= t->count)
      return UINT32_MAX; /* an operand is UINT32_MAX, because memory was out when the operand was added */
    else if (t->step[s.of[i]].op != VS_TAPE_CONSTANT)
      constant = false;
    else
      v[i] = t->step[s.of[i]].value;
  if (constant) return vs_tape_constant(t, vs_tape_apply(op, v[0], v[1], v[2]));
  /* These simplifications never change a result. x * 0 is not replaced by 0, because x may be NaN. */
  if (op == VS_TAPE_ADD && is_constant(t, a, 0)) return b;
  if ((op == VS_TAPE_ADD || op == VS_TAPE_SUB) && is_constant(t, b, 0)) return a;
  if (op == VS_TAPE_MUL && is_constant(t, a, 1)) return b;
  if ((op == VS_TAPE_MUL || op == VS_TAPE_DIV) && is_constant(t, b, 1)) return a;
  if (op == VS_TAPE_CHOOSE && t->step[a].op == VS_TAPE_CONSTANT) return t->step[a].value != 0 ? b : c;
  /* The bounds of a square are tighter than those of x * x or a power. Therefore x * x and x ^ 2 become squares. */
  if (op == VS_TAPE_MUL && a == b) return vs_tape_add(t, VS_TAPE_SQUARE, a, 0, 0);
  if (op == VS_TAPE_POW && is_constant(t, b, 2)) return vs_tape_add(t, VS_TAPE_SQUARE, a, 0, 0);
  if (op == VS_TAPE_POW && is_constant(t, b, 1)) return a;
  if (op == VS_TAPE_POW && is_constant(t, b, 4)) {
    uint32_t square = vs_tape_add(t, VS_TAPE_SQUARE, a, 0, 0);
    return vs_tape_add(t, VS_TAPE_SQUARE, square, 0, 0);
  }
  if (op == VS_TAPE_POW && is_constant(t, b, 3)) {
    uint32_t square = vs_tape_add(t, VS_TAPE_SQUARE, a, 0, 0);
    return vs_tape_add(t, VS_TAPE_MUL, square, a, 0);
  }
  if ((op == VS_TAPE_ADD || op == VS_TAPE_MUL) && a > b) s.of[0] = b, s.of[1] = a; /* orders the operands of sums and
                                                                                    * products, so that a + b and b + a
                                                                                    * become one step of the tape */
  return step_number(t, &s);
}

/* Returns the index of field f in the tape's list of fields. Adds f to the list if necessary. Returns UINT32_MAX when
 * memory is out. */
static uint32_t field_number(vs_tape *t, vs_tape_field *f) {
  for (size_t i = 0; i < t->field_count; i++)
    if (t->field[i] == f) return (uint32_t)i;
  if (!VS_GROW(t->field, t->field_room, t->field_count + 1)) return UINT32_MAX;
  f->refs++;
  t->field[t->field_count] = f;
  return (uint32_t)t->field_count++;
}

uint32_t vs_tape_add_field(vs_tape *t, vs_tape_field *f, uint32_t x, uint32_t y, uint32_t z) {
  uint32_t number = field_number(t, f);
  if (number == UINT32_MAX || x >= t->count || y >= t->count || z >= t->count) return UINT32_MAX;
  vs_tape_step s = { VS_TAPE_FIELD, { x, y, z }, number };
  return step_number(t, &s);
}

vs_tape *vs_tape_compact(const vs_tape *t) {
  vs_tape *c = vs_tape_new(t->inputs);
  uint32_t *to = NULL;
  size_t to_room = 0;
  bool ok = c && VS_GROW(to, to_room, t->count + 1);
  if (ok) memset(to, 0, (t->count + 1) * sizeof *to);
  for (uint32_t i = 0; ok && i < t->outputs; i++) to[t->output[i]] = 1;
  for (size_t i = t->count; ok && i-- > 0;)
    for (int k = 0; to[i] && k < operators[t->step[i].op].operands; k++) to[t->step[i].of[k]] = 1;
  for (size_t i = 0; ok && i < t->count; i++) {
    if (!to[i]) continue;
    vs_tape_step s = t->step[i];
    for (int k = 0; k < operators[s.op].operands; k++) s.of[k] = to[s.of[k]];
    to[i] = s.op == VS_TAPE_FIELD ? vs_tape_add_field(c, t->field[(size_t)s.value], s.of[0], s.of[1], s.of[2])
                                  : step_number(c, &s);
    ok = to[i] != UINT32_MAX;
  }
  if (ok) {
    c->outputs = t->outputs;
    for (uint32_t i = 0; i < t->outputs; i++) c->output[i] = to[t->output[i]];
  } else {
    vs_tape_free(c);
    c = NULL;
  }
  free(to);
  return c;
}
