/* Implements the arithmetic of instructions without a call: on fixnums and doubles, and on the host's flat records
 * (points and vectors). The procedure that the instruction replaces handles all other cases: a fixnum that overflows, a
 * result that is not finite, other operands. It also reports errors. */
#ifndef VS_VM_COMPILER_INLINE_ARITHMETIC_H
#define VS_VM_COMPILER_INLINE_ARITHMETIC_H

#include "vm/machine/vs.h"
#include "vm/numbers/number.h"

/* Converts the n values at `at` to doubles d, for a flat record. Returns false, without an error, if a value is no
 * finite number. */
static inline bool flat_numbers(const vs_value *at, size_t n, double *d) {
  for (size_t i = 0; i < n; i++) {
    if (vs_is_double(at[i])) d[i] = vs_double(at[i]);
    else if (vs_is_fixnum(at[i])) d[i] = (double)vs_fixnum(at[i]);
    else return false;
    if (!(d[i] - d[i] == 0)) return false;
  }
  return true;
}

static inline bool flat_operand(vs_value v) { return vs_is(v, VS_T_FLAT); }

/* Returns true if the host has a rule for the operation on these two values. */
static inline bool flat_rule(const vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b) {
  bool fa = flat_operand(a), fb = flat_operand(b);
  if (!(fa || fb) || !vm->flat) return false;
  if (!(fa || vs_is_double(a) || vs_is_fixnum(a)) || !(fb || vs_is_double(b) || vs_is_fixnum(b))) return false;
  /* a division by 0 is left to the procedure /, which reports it */
  if (op == VS_OP_DIV && (b == vs_fix(0) || (vs_is_double(b) && vs_double(b) == 0))) return false;
  return vm->flat->at[op][fa ? vs_as_flat(a)->h.flags : 0][fb ? vs_as_flat(b)->h.flags : 0].rule != VS_RULE_NONE;
}

static inline bool to_double(vs_value v, double *d) {
  if (vs_is_double(v)) { *d = vs_double(v); return true; }
  if (vs_is_fixnum(v)) { *d = (double)vs_fixnum(v); return true; }
  return false;
}

/* Applies the host's binary procedure number `row` to x and y. Stores the result, one or three numbers, in d. Returns
 * the tag of the resulting record, 0 for a number, or a negative number if the procedure itself must be called. */
static inline int flat_binary(const vs_flat_rules *rules, uint32_t row, vs_value x, vs_value y, double *d) {
  int kind = rules->binary[row].kind, result = rules->binary[row].result;
  if (!vs_is_flat(x, rules->binary[row].left)) return -1;
  const double *a = vs_as_flat(x)->at, *b = NULL;
  double by = 0;
  if (rules->binary[row].right) {
    if (!vs_is_flat(y, rules->binary[row].right)) return -1;
    b = vs_as_flat(y)->at;
  } else if (!to_double(y, &by) || !(by - by == 0)) {
    return -1;
  }
  switch ((vs_flat_kind)kind) {
    case VS_FLAT_PLUS: d[0] = a[0] + b[0]; d[1] = a[1] + b[1]; d[2] = a[2] + b[2]; break;
    case VS_FLAT_MINUS: d[0] = a[0] - b[0]; d[1] = a[1] - b[1]; d[2] = a[2] - b[2]; break;
    case VS_FLAT_FROM: d[0] = b[0] - a[0]; d[1] = b[1] - a[1]; d[2] = b[2] - a[2]; break;
    case VS_FLAT_TIMES: d[0] = a[0] * by; d[1] = a[1] * by; d[2] = a[2] * by; break;
    case VS_FLAT_OVER:
      if (by == 0) return -1;
      d[0] = a[0] / by; d[1] = a[1] / by; d[2] = a[2] / by;
      break;
    case VS_FLAT_DOT: d[0] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; break;
    case VS_FLAT_CROSS:
      d[0] = a[1] * b[2] - a[2] * b[1]; d[1] = a[2] * b[0] - a[0] * b[2]; d[2] = a[0] * b[1] - a[1] * b[0];
      break;
    case VS_FLAT_APART: d[0] = vs_flat_length(b[0] - a[0], b[1] - a[1], b[2] - a[2]); break;
    case VS_FLAT_LENGTH: return -1;
  }
  if (!(d[0] - d[0] == 0)) return -1;
  return !result || (d[1] - d[1] == 0 && d[2] - d[2] == 0) ? result : -1;
}

static inline bool both_fixnums(vs_value a, vs_value b) {
  return (((a ^ VS_TAG_FIXNUM << 48) | (b ^ VS_TAG_FIXNUM << 48)) >> 48) == 0;
}

/* Computes a op b if at least one is a double and the other a double or fixnum. Returns false for other operands. */
static inline bool quick_double(vs_flat_op op, vs_value a, vs_value b, vs_value *out) {
  double x, y;
  if (vs_is_double(a) && vs_is_double(b)) { x = vs_double(a); y = vs_double(b); }
  else if (!to_double(a, &x) || !to_double(b, &y)) return false;
  switch (op) {
    case VS_OP_ADD: x += y; break;
    case VS_OP_SUB: x -= y; break;
    case VS_OP_MUL:      /* an exact 0 times a double is 0.0, as in the procedure * */
      x *= y; break;
    case VS_OP_DIV: if (b == vs_fix(0)) return false; x /= y; break;
    default: return false;
  }
  *out = vs_flonum_raw(x);
  return true;
}

/* Computes a op b for fixnums and doubles. Returns false for other operands, or if a fixnum overflows. Fixnums are
 * computed in the upper 48 bits of a word, where the processor detects overflow. */
static inline bool quick(vs_flat_op op, vs_value a, vs_value b, vs_value *out) {
  if (!both_fixnums(a, b)) return quick_double(op, a, b, out);
  int64_t i, j, r;
  switch (op) {
    case VS_OP_ADD: if (__builtin_add_overflow((int64_t)(a << 16), (int64_t)(b << 16), &r)) return false; break;
    case VS_OP_SUB: if (__builtin_sub_overflow((int64_t)(a << 16), (int64_t)(b << 16), &r)) return false; break;
    case VS_OP_MUL: if (__builtin_mul_overflow((int64_t)(a << 16), vs_fixnum(b), &r)) return false; break;
    case VS_OP_DIV:
      i = vs_fixnum(a); j = vs_fixnum(b);
      if (j == 0 || i % j || !vs_fits_fixnum(i / j)) return false;
      *out = vs_fix(i / j);
      return true;
    default: return false;
  }
  *out = VS_TAG_FIXNUM << 48 | (uint64_t)r >> 16;
  return true;
}

typedef enum { LT, LE, GT, GE, EQ } relation;
/* Returns the result of the comparison, 0 or 1, or -1 if an operand is neither fixnum nor double. */
static inline int compare(relation rel, vs_value a, vs_value b) {
  if (both_fixnums(a, b)) {
    int64_t i = (int64_t)(a << 16), j = (int64_t)(b << 16);
    switch (rel) {
    case LT: return i < j;
    case LE: return i <= j;
    case GT: return i > j;
    case GE: return i >= j;
    case EQ: return i == j;
    }
  }
  double x, y;
  if (vs_is_double(a) && vs_is_double(b)) { x = vs_double(a); y = vs_double(b); }
  else if (!to_double(a, &x) || !to_double(b, &y)) return -1;
  switch (rel) {
  case LT: return x < y;
  case LE: return x <= y;
  case GT: return x > y;
  case GE: return x >= y;
  case EQ: return x == y;
  }
  return -1;
}

#endif
