/* Implements the general arithmetic of numbers (number.h) for fixnums, bignums, ratios, doubles and flat records.
 *
 * Every operation tests the types of its operands in this order: doubles (one double makes the result a double), flat
 * records, exact numbers. If one of two exact numbers is a ratio, the operation computes with numerators and
 * denominators. */
#include "vm/numbers/number.h"

#include <math.h>

#include "vm/machine/fail.h"
#include "vm/numbers/dual.h"
#include "vm/numbers/integer.h"
#include "vm/values/heap.h"

static const char *const op_name[] = {[VS_OP_ADD] = "+", [VS_OP_SUB] = "-", [VS_OP_MUL] = "*", [VS_OP_DIV] = "/"};

/* Sets the error "NAME: expected EXPECTED, got V". NAME is the name of the running native, or `who` if an instruction
 * replaced the native's call. */
static bool number_bad(vs_scheme *vm, const char *who, const char *expected, vs_value v) {
  VS_ROOTS(vm, r, 1);
  if (!vs_cons(vm, v, VS_NIL, &r[0])) return false;
  return vs_fail_with(vm, vm->sym.type, r[0], "%s%sexpected %s, got", vm->native ? "" : who, vm->native ? "" : ": ",
                      expected);
}

static bool number_divide_by_zero(vs_scheme *vm, const char *who) {
  return vs_fail(vm, vm->sym.divide, "%s%sdivision by zero", vm->native ? "" : who, vm->native ? "" : ": ");
}

/* ---- conversions between types ---- */

bool vs_number_ratio(vs_scheme *vm, vs_value num, vs_value den, vs_value *out) {
  VS_ROOTS(vm, r, 3);
  VS_ASSERT(vs_is_exact_integer(num) && vs_is_exact_integer(den) && den != vs_fix(0));
  r[0] = num;
  r[1] = den;
  if (!vs_int_gcd(vm, r[0], r[1], &r[2])) return false;
  if (r[2] != vs_fix(1) && !(vs_int_divide(vm, r[0], r[2], &r[0], NULL) && vs_int_divide(vm, r[1], r[2], &r[1], NULL)))
    return false;
  return vs_number_lowest(vm, r[0], r[1], out);
}

bool vs_number_lowest(vs_scheme *vm, vs_value num, vs_value den, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  VS_ASSERT(vs_is_exact_integer(num) && vs_is_exact_integer(den) && den != vs_fix(0));
  r[0] = num;
  r[1] = den;
  if (vs_int_sign(den) < 0 && !(vs_int_negate(vm, r[0], &r[0]) && vs_int_negate(vm, r[1], &r[1]))) return false;
  if (r[1] == vs_fix(1)) return *out = r[0], true;
  vs_ratio *q = (vs_ratio *)(void *)vs_gc_alloc(vm, VS_T_RATIO, VS_WORDS(vs_ratio));
  if (!q) return false;
  q->num = r[0];
  q->den = r[1];
  *out = vs_from_object(q);
  return true;
}

bool vs_number_double(vs_scheme *vm, vs_value v, double *out) {
  VS_ASSERT(vs_is_number(v));
  if (vs_is_double(v)) return *out = vs_double(v), true;
  if (!vs_is_ratio(v)) return *out = vs_int_double(v), true;
  VS_ROOTS(vm, r, 2);
  r[0] = vs_as_ratio(v)->num;
  r[1] = vs_as_ratio(v)->den;
  bool negative = vs_int_sign(r[0]) < 0;
  if ((negative && !vs_int_negate(vm, r[0], &r[0])) || !vs_int_ratio_double(vm, r[0], r[1], out)) return false;
  if (negative) *out = -*out;
  return true;
}

bool vs_number_exact(vs_scheme *vm, vs_value v, vs_value *out) {
  VS_ASSERT(vs_is_number(v));
  if (!vs_is_double(v)) return *out = v, true;
  double d = vs_double(v);
  if (!isfinite(d)) return number_bad(vm, "exact", "a finite number", v);
  if (d == floor(d)) return vs_int_from_double(vm, d, out);
  int e;
  double m = frexp(d, &e);                       /* d has a fractional part, since its exponent is small or negative */
  VS_ROOTS(vm, r, 2);
  return vs_int_from_int64(vm, (int64_t)ldexp(m, 53), &r[0]) && vs_int_shift(vm, vs_fix(1), 53 - e, &r[1]) &&
         vs_number_ratio(vm, r[0], r[1], out);
}

/* ---- + - * / ---- */

static bool ratio_part(vs_value v, bool den, vs_value *out) {
  if (vs_is_ratio(v)) *out = den ? vs_as_ratio(v)->den : vs_as_ratio(v)->num;
  else *out = den ? vs_fix(1) : v;
  return true;
}

/* Computes a op b exactly, where a or b is a ratio, or op is a division. */
static bool ratio_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out) {
  VS_ROOTS(vm, r, 6);
  VS_ASSERT(vs_is_exact(a) && vs_is_exact(b));
  ratio_part(a, false, &r[0]), ratio_part(a, true, &r[1]);
  ratio_part(b, false, &r[2]), ratio_part(b, true, &r[3]);
  switch (op) {
    case VS_OP_ADD:
    case VS_OP_SUB:
      return vs_int_mul(vm, r[0], r[3], &r[4]) && vs_int_mul(vm, r[2], r[1], &r[5]) &&
             (op == VS_OP_ADD ? vs_int_add(vm, r[4], r[5], &r[4]) : vs_int_sub(vm, r[4], r[5], &r[4])) &&
             vs_int_mul(vm, r[1], r[3], &r[5]) && vs_number_ratio(vm, r[4], r[5], out);
    case VS_OP_MUL:
      return vs_int_mul(vm, r[0], r[2], &r[4]) && vs_int_mul(vm, r[1], r[3], &r[5]) &&
             vs_number_ratio(vm, r[4], r[5], out);
    case VS_OP_DIV:
      return vs_int_mul(vm, r[0], r[3], &r[4]) && vs_int_mul(vm, r[1], r[2], &r[5]) &&
             vs_number_ratio(vm, r[4], r[5], out);
    case VS_OP_COUNT: break;
  }
  return vs_fail(vm, vm->sym.internal, "no such operator");
}

bool vs_flat_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out) {
  double x[VS_FLAT_FIELDS], y[VS_FLAT_FIELDS];
  uint32_t ta = vs_is(a, VS_T_FLAT) ? vs_as_flat(a)->h.flags : 0, tb = vs_is(b, VS_T_FLAT) ? vs_as_flat(b)->h.flags : 0;
  const char *word[] = {"add", "subtract", "multiply", "divide"};
  const char *joint[] = {"and", "from", "and", "by"};
  VS_ASSERT(ta || tb);
  if (vm->flat && vm->flat->at[op][ta][tb].rule == VS_RULE_CALL) {
    const vs_value both[2] = {a, b};
    return vm->flat->call(vm, (const char *const[]){"+", "-", "*", "/"}[op], both, 2, out);
  }
  double number = 0;   /* value of the operand that is a number and no record; it may be a ratio or bignum */
  vs_value other = ta ? b : a;
  bool numbers = (ta && tb) || (vs_is_number(other) && vs_number_double(vm, other, &number));
  int rule = vm->flat && numbers ? vm->flat->at[op][ta][tb].rule : VS_RULE_NONE;
  if (op == VS_OP_SUB && !ta && a != vs_fix(0)) rule = VS_RULE_NONE;   /* a number minus a record is permitted only as
                                                                        * (- x), which is 0 - x */
  if (rule == VS_RULE_NONE) {
    if (op == VS_OP_SUB) return vs_fail(vm, vm->sym.type, "cannot subtract %s from %s", vs_noun(vm, b), vs_noun(vm, a));
    return vs_fail(vm, vm->sym.type, "cannot %s %s %s %s", word[op], vs_noun(vm, a), joint[op], vs_noun(vm, b));
  }
  if (rule == VS_RULE_DIV && !tb && number == 0) return vs_fail(vm, vm->sym.divide, "division by zero");
  size_t n = ta ? vs_flat_count(vs_as_flat(a)) : vs_flat_count(vs_as_flat(b));
  for (size_t i = 0; i < n; i++) {
    x[i] = ta ? vs_as_flat(a)->at[i] : number;
    y[i] = tb ? vs_as_flat(b)->at[i] : number;
    x[i] = rule == VS_RULE_ADD   ? x[i] + y[i]
           : rule == VS_RULE_SUB ? x[i] - y[i]
           : rule == VS_RULE_MUL ? x[i] * y[i]
                                 : x[i] / y[i];
  }
  return vs_make_flat(vm, vm->flat->at[op][ta][tb].tag, x, n, out);
}

static bool number_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out) {
  bool exact_a = vs_is_exact(a), exact_b = vs_is_exact(b);
  if (exact_a && exact_b) {
    if (op == VS_OP_DIV && b == vs_fix(0)) return number_divide_by_zero(vm, "/");
    if (op == VS_OP_DIV || vs_is_ratio(a) || vs_is_ratio(b)) return ratio_arith(vm, op, a, b, out);
    return op == VS_OP_ADD   ? vs_int_add(vm, a, b, out)
           : op == VS_OP_SUB ? vs_int_sub(vm, a, b, out)
                             : vs_int_mul(vm, a, b, out);
  }
  if (vs_is_dual(a) || vs_is_dual(b)) {
    if (!vs_is_scalar(a) && !vs_is(vs_dual_base(a), VS_T_FLAT)) return number_bad(vm, op_name[op], "a number", a);
    if (!vs_is_scalar(b) && !vs_is(vs_dual_base(b), VS_T_FLAT)) return number_bad(vm, op_name[op], "a number", b);
    return vs_dual_arith(vm, op, a, b, out);
  }
  if (vs_is(a, VS_T_FLAT) || vs_is(b, VS_T_FLAT)) {
    if (!vs_is_number(a) && !vs_is(a, VS_T_FLAT)) return number_bad(vm, op_name[op], "a number", a);
    if (!vs_is_number(b) && !vs_is(b, VS_T_FLAT)) return number_bad(vm, op_name[op], "a number", b);
    return vs_flat_arith(vm, op, a, b, out);
  }
  if (!exact_a && !vs_is_double(a)) return number_bad(vm, op_name[op], "a number", a);
  if (!exact_b && !vs_is_double(b)) return number_bad(vm, op_name[op], "a number", b);
  if (op == VS_OP_DIV && b == vs_fix(0)) return number_divide_by_zero(vm, "/");
  /* The product of anything with an exact 0 is the exact 0. */
  if (op == VS_OP_MUL && (a == vs_fix(0) || b == vs_fix(0))) return *out = vs_fix(0), true;
  VS_ROOTS(vm, r, 2);
  r[0] = a;
  r[1] = b;
  double x, y;
  if (!vs_number_double(vm, a, &x) || !vs_number_double(vm, r[1], &y)) return false;
  *out = vs_flonum(op == VS_OP_ADD ? x + y : op == VS_OP_SUB ? x - y : op == VS_OP_MUL ? x * y : x / y);
  return true;
}

bool vs_number_add(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  return number_arith(vm, VS_OP_ADD, a, b, out);
}
bool vs_number_sub(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  return number_arith(vm, VS_OP_SUB, a, b, out);
}
bool vs_number_mul(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  return number_arith(vm, VS_OP_MUL, a, b, out);
}
bool vs_number_div(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  return number_arith(vm, VS_OP_DIV, a, b, out);
}

/* ---- comparison ---- */

/* Compares the numbers a and b. Sets *order to -1, 0 or 1, or to 2 if a or b is NaN. */
static bool number_compare(vs_scheme *vm, vs_value a, vs_value b, int *order) {
  bool da = vs_is_double(a), db = vs_is_double(b);
  VS_ASSERT(vs_is_number(a) && vs_is_number(b));
  if ((da || vs_is_fixnum(a)) && (db || vs_is_fixnum(b))) {          /* doubles and fixnums are compared as doubles,
                                                                      * which represent all fixnums exactly */
    double x = da ? vs_double(a) : (double)vs_fixnum(a), y = db ? vs_double(b) : (double)vs_fixnum(b);
    *order = x < y ? -1 : x > y ? 1 : x == y ? 0 : 2;
    return true;
  }
  if (da || db) {
    double d = vs_double(da ? a : b);
    if (!isfinite(d)) {
      *order = d != d ? 2 : (d > 0) == da ? 1 : -1;
      return true;
    }
  }
  VS_ROOTS(vm, r, 4);
  r[0] = a;
  r[1] = b;
  if (!vs_number_exact(vm, r[0], &r[0]) || !vs_number_exact(vm, r[1], &r[1])) return false;
  if (vs_is_ratio(r[0]) || vs_is_ratio(r[1])) {
    vs_value n0, d0, n1, d1;
    ratio_part(r[0], false, &n0), ratio_part(r[1], true, &d1);
    if (!vs_int_mul(vm, n0, d1, &r[2])) return false;
    ratio_part(r[1], false, &n1), ratio_part(r[0], true, &d0);
    if (!vs_int_mul(vm, n1, d0, &r[3])) return false;
    *order = vs_int_compare(r[2], r[3]);
  } else {
    *order = vs_int_compare(r[0], r[1]);
  }
  return true;
}

bool vs_number_test(vs_scheme *vm, vs_relation relation, vs_value a, vs_value b, bool *out) {
  static const char *const name[] = {[VS_LT] = "<", [VS_LE] = "<=", [VS_EQ] = "=", [VS_GE] = ">=", [VS_GT] = ">"};
  if (vs_is_dual(a) || vs_is_dual(b)) return vs_number_test(vm, relation, vs_dual_base(a), vs_dual_base(b), out);
  if ((!vs_is_number(a) || !vs_is_number(b)) && vs_flat_callable(vm, (const vs_value[]){a, b}, 2)) {
    bool turned = relation == VS_GT || relation == VS_GE;
    const vs_value both[2] = {turned ? b : a, turned ? a : b};
    vs_value truth;
    const char *test = relation == VS_EQ ? "=" : relation == VS_LT || relation == VS_GT ? "<" : "<=";
    return vm->flat->call(vm, test, both, 2, &truth) && (*out = truth != VS_FALSE, true);
  }
  if (!vs_is_number(a)) return number_bad(vm, name[relation], "a number", a);
  if (!vs_is_number(b)) return number_bad(vm, name[relation], "a number", b);
  int order;
  if (!number_compare(vm, a, b, &order)) return false;
  switch (relation) {
    case VS_LT: *out = order == -1; break;
    case VS_LE: *out = order == -1 || order == 0; break;
    case VS_EQ: *out = order == 0; break;
    case VS_GE: *out = order == 1 || order == 0; break;
    case VS_GT: *out = order == 1; break;
  }
  return true;
}

bool vs_number_eqv(vs_value a, vs_value b) {
  if (a == b) return true;
  if (vs_is_bignum(a) && vs_is_bignum(b)) return vs_int_compare(a, b) == 0;
  if (vs_is_ratio(a) && vs_is_ratio(b))
    return vs_int_compare(vs_as_ratio(a)->num, vs_as_ratio(b)->num) == 0 &&
           vs_int_compare(vs_as_ratio(a)->den, vs_as_ratio(b)->den) == 0;
  return false;
}

static uint64_t mix(uint64_t h, uint64_t v) {
  h = (h ^ v) * UINT64_C(0x9E3779B97F4A7C15);
  return h ^ h >> 29;
}

uint64_t vs_number_hash(vs_value v) {
  if (vs_is_ratio(v)) return mix(vs_number_hash(vs_as_ratio(v)->num), vs_number_hash(vs_as_ratio(v)->den));
  if (!vs_is_bignum(v)) return mix(1, v);
  const vs_bignum *b = vs_as_bignum(v);
  uint64_t h = b->h.flags & VS_F_NEGATIVE ? 3 : 2;
  for (uint64_t i = 0; i < b->count; i++) h = mix(h, b->limb[i]);
  return h;
}

/* ---- integer division, exact or not ---- */

typedef enum { DIVIDE_QUOTIENT, DIVIDE_REMAINDER, DIVIDE_MODULO } divide_kind;

static bool is_integer(vs_value v) {
  return vs_is_exact_integer(v) || (vs_is_double(v) && isfinite(vs_double(v)) && vs_double(v) == floor(vs_double(v)));
}

static bool number_divide(vs_scheme *vm, divide_kind kind, const char *who, vs_value a, vs_value b, vs_value *out) {
  if (!is_integer(a)) return number_bad(vm, who, "an integer", a);
  if (!is_integer(b)) return number_bad(vm, who, "an integer", b);
  if (b == vs_fix(0) || (vs_is_double(b) && vs_double(b) == 0)) return number_divide_by_zero(vm, who);
  if (vs_is_double(a) || vs_is_double(b)) {
    double x, y, rest;
    /* If an operand is a double, both are integral doubles or fixnums, and nothing is allocated. */
    if (!vs_number_double(vm, a, &x) || !vs_number_double(vm, b, &y)) return false;
    rest = fmod(x, y);
    if (kind == DIVIDE_QUOTIENT) return *out = vs_flonum((x - rest) / y), true;
    if (kind == DIVIDE_MODULO && rest != 0 && (rest < 0) != (y < 0)) rest += y;
    return *out = vs_flonum(rest), true;
  }
  if (kind == DIVIDE_QUOTIENT) return vs_int_divide(vm, a, b, out, NULL);
  VS_ROOTS(vm, r, 2);
  r[0] = b;
  if (!vs_int_divide(vm, a, b, NULL, &r[1])) return false;
  if (kind == DIVIDE_MODULO && vs_int_sign(r[1]) * vs_int_sign(r[0]) < 0) return vs_int_add(vm, r[1], r[0], out);
  *out = r[1];
  return true;
}

bool vs_number_quotient(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  return number_divide(vm, DIVIDE_QUOTIENT, "quotient", a, b, out);
}
bool vs_number_remainder(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  return number_divide(vm, DIVIDE_REMAINDER, "remainder", a, b, out);
}
bool vs_number_modulo(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  return number_divide(vm, DIVIDE_MODULO, "modulo", a, b, out);
}

bool vs_number_abs(vs_scheme *vm, vs_value a, vs_value *out) {
  if (vs_is_double(a)) return *out = vs_flonum_raw(fabs(vs_double(a))), true;
  if (vs_is_dual(a)) { /* the absolute value has no derivative at 0; the derivative for positive numbers is used */
    bool below;
    if (!vs_number_test(vm, VS_LT, a, vs_fix(0), &below)) return false;
    return below ? vs_number_sub(vm, vs_fix(0), a, out) : (*out = a, true);
  }
  if (!vs_is_exact(a)) return number_bad(vm, "abs", "a number", a);
  vs_value n = vs_is_ratio(a) ? vs_as_ratio(a)->num : a;
  return vs_int_sign(n) < 0 ? vs_number_sub(vm, vs_fix(0), a, out) : (*out = a, true);
}

bool vs_number_is_zero(vs_scheme *vm, vs_value a, bool *out) {
  a = vs_dual_base(a);
  if (!vs_is_number(a)) return number_bad(vm, "zero?", "a number", a);
  *out = a == vs_fix(0) || (vs_is_double(a) && vs_double(a) == 0);
  return true;
}

/* Sets *out to the square root of an exact integer n >= 0 if this root is an integer, otherwise to #f. */
static bool int_exact_sqrt(vs_scheme *vm, vs_value n, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  VS_ASSERT(vs_is_exact_integer(n) && vs_int_sign(n) >= 0);
  if (!vs_int_sqrt(vm, n, &r[0], &r[1])) return false;
  *out = r[1] == vs_fix(0) ? r[0] : VS_FALSE;
  return true;
}

bool vs_number_sqrt(vs_scheme *vm, vs_value a, vs_value *out) {
  if (vs_is_dual(a)) return vs_dual_function(vm, sqrt, a, out);
  if (!vs_is_number(a)) return number_bad(vm, "sqrt", "a number", a);
  if (vs_is_double(a)) {
    if (vs_double(a) < 0) return number_bad(vm, "sqrt", "a number that is not negative", a);
    return *out = vs_flonum(sqrt(vs_double(a))), true;
  }
  VS_ROOTS(vm, r, 4);
  r[0] = a;
  ratio_part(a, false, &r[1]), ratio_part(a, true, &r[2]);
  if (vs_int_sign(r[1]) < 0) return number_bad(vm, "sqrt", "a number that is not negative", a);
  if (!int_exact_sqrt(vm, r[1], &r[3])) return false;
  if (r[3] != VS_FALSE) {
    if (r[2] == vs_fix(1)) return *out = r[3], true;
    if (!int_exact_sqrt(vm, r[2], &r[2])) return false;
    if (r[2] != VS_FALSE) return vs_number_ratio(vm, r[3], r[2], out);
  }
  double d;
  if (!vs_number_double(vm, r[0], &d)) return false;
  /* The number is outside the range of doubles, but its square root is not: computes at least 64 bits of the root with
   * integers. */
  if (isinf(d) || d == 0) {
    ratio_part(r[0], false, &r[1]), ratio_part(r[0], true, &r[2]);
    int64_t up = ((int64_t)vs_int_bits(r[2]) - (int64_t)vs_int_bits(r[1]) + 256) & ~INT64_C(1);
    if (up > 0 ? !vs_int_shift(vm, r[1], up, &r[1]) : !vs_int_shift(vm, r[2], -up, &r[2])) return false;
    if (!vs_int_divide(vm, r[1], r[2], &r[1], NULL) || !vs_int_sqrt(vm, r[1], &r[1], &r[3])) return false;
    return *out = vs_flonum(ldexp(vs_int_double(r[1]), (int)(-up / 2))), true;
  }
  *out = vs_flonum(sqrt(d));
  return true;
}

double vs_cube_root(double x) {
  double c = cbrt(x);
  return c == 0 || !isfinite(c) ? c : c - (c - x / (c * c)) / 3;
}
