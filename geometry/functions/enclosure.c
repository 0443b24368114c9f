/* Implements interval arithmetic (enclosure.h). The processor rounds to nearest. Therefore every bound is moved
 * outwards by the largest error of the operation. This error is half a unit in the last place for + - * / and roots,
 * and up to some units for functions of the C library. */
#include "geometry/functions/enclosure.h"
#include "model/assert.h"

#include <float.h>
#include <math.h>

static double below(double d, double units) {
  return isinf(d) ? d : d - (fabs(d) * units * DBL_EPSILON + DBL_TRUE_MIN);
}
static double above(double d, double units) {
  return isinf(d) ? d : d + (fabs(d) * units * DBL_EPSILON + DBL_TRUE_MIN);
}

static const vs_enclosure all = { -INFINITY, INFINITY, true }, none = { NAN, NAN, true };

static vs_enclosure bounds(double low, double high, double units, bool partial) {
  if (low != low || high != high) return all; /* an operation such as inf - inf has no result, so any number is
                                               * possible */
  return (vs_enclosure){ below(low, units), above(high, units), partial };
}

static double least(double a, double b) { return a < b ? a : b; }
static double most(double a, double b) { return a > b ? a : b; }
/* 0 * inf is 0 here, because an infinite bound means arbitrarily large numbers, not infinity */
static double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

static vs_enclosure times(vs_enclosure a, vs_enclosure b, bool partial) {
  double p = product(a.low, b.low), q = product(a.low, b.high), r = product(a.high, b.low), s = product(a.high, b.high);
  return bounds(least(least(p, q), least(r, s)), most(most(p, q), most(r, s)), 1, partial);
}

static vs_enclosure over(vs_enclosure a, vs_enclosure b, bool partial) {
  if (b.low == 0 && b.high == 0) return none;
  if (b.low <= 0 && b.high >= 0) return all;
  double p = a.low / b.low, q = a.low / b.high, r = a.high / b.low, s = a.high / b.high;
  return bounds(least(least(p, q), least(r, s)), most(most(p, q), most(r, s)), 1, partial);
}

static vs_enclosure squared(vs_enclosure a) {
  double p = a.low * a.low, q = a.high * a.high;
  vs_enclosure r = bounds(a.low <= 0 && a.high >= 0 ? 0 : least(p, q), most(p, q), 1, a.partial);
  if (r.low < 0) r.low = 0;
  return r;
}

/* Returns the bounds of f over the interval a; f is an increasing function. */
static vs_enclosure rising(double (*f)(double), vs_enclosure a, bool partial) {
  return bounds(f(a.low), f(a.high), 4, partial);
}

/* Returns true if the interval a contains an angle phase + k * 2 pi for some integer k. The margin exceeds any rounding
 * error of the angle. */
static bool holds_turn(vs_enclosure a, double phase) {
  const double turn = 6.283185307179586;
  double margin = 1e-9 + 1e-15 * most(fabs(a.low), fabs(a.high));
  return floor((a.high + margin - phase) / turn) >= ceil((a.low - margin - phase) / turn);
}

static vs_enclosure wave(double (*f)(double), vs_enclosure a, double top) {
  if (!(fabs(a.low) < 1e15 && fabs(a.high) < 1e15)) return (vs_enclosure){ -1, 1, a.partial };
  double p = f(a.low), q = f(a.high);
  vs_enclosure r = bounds(least(p, q), most(p, q), 4, a.partial);
  if (holds_turn(a, top) || r.high > 1) r.high = 1;
  if (holds_turn(a, top + 3.141592653589793) || r.low < -1) r.low = -1;
  return r;
}

static vs_enclosure clipped(vs_enclosure a, double low, double high) { /* returns the part of the interval a within the
                                                                        * domain of a function, which is low to high */
  if (a.high < low || a.low > high) return none;
  return (vs_enclosure){ most(a.low, low), least(a.high, high), a.partial || a.low < low || a.high > high };
}

static vs_enclosure power(vs_enclosure a, vs_enclosure b, bool partial) {
  if (b.low == b.high && b.low == floor(b.low) && fabs(b.low) < 1e6) { /* a power with an integer exponent is computed
                                                                        * as a product */
    double n = fabs(b.low), p = pow(a.low, n), q = pow(a.high, n);
    bool even = fmod(n, 2) == 0;
    vs_enclosure r = bounds(even && a.low <= 0 && a.high >= 0 ? 0 : least(p, q), most(p, q), 4, partial);
    if (even && r.low < 0) r.low = 0;
    return b.low < 0 ? over((vs_enclosure){ 1, 1, false }, r, partial) : r;
  }
  vs_enclosure base = clipped(a, 0, INFINITY);
  if (base.low != base.low) return base;
  if (base.low == 0 && b.low <= 0) return (vs_enclosure){ 0, INFINITY, true };
  double p = pow(base.low, b.low), q = pow(base.low, b.high), r = pow(base.high, b.low), s = pow(base.high, b.high);
  return bounds(least(least(p, q), least(r, s)), most(most(p, q), most(r, s)), 4, partial || base.partial);
}

static vs_enclosure angle(vs_enclosure y, vs_enclosure x, bool partial) { /* returns the bounds of atan2(y, x) for y and
                                                                           * x in the given intervals */
  if (x.low <= 0 && y.low <= 0 && y.high >= 0) /* the box of x and y contains the origin, or a part of the negative x
                                                * axis, where the angle jumps */
    return (vs_enclosure){ -3.1415926535897936, 3.1415926535897936, partial || (x.high >= 0) };
  double p = atan2(y.low, x.low), q = atan2(y.low, x.high), r = atan2(y.high, x.low), s = atan2(y.high, x.high);
  return bounds(least(least(p, q), least(r, s)), most(most(p, q), most(r, s)), 4, partial);
}

vs_enclosure vs_enclose(vs_tape_operator op, vs_enclosure a, vs_enclosure b, vs_enclosure c) {
  int n = vs_tape_operands(op);
  bool partial = a.partial || (n > 1 && b.partial);
  VS_ASSERT(op > VS_TAPE_INPUT && op < VS_TAPE_OPERATORS);
  if (a.low != a.low || (n > 1 && op != VS_TAPE_CHOOSE && b.low != b.low)) return none;
  switch (op) {
  case VS_TAPE_ADD: return bounds(a.low + b.low, a.high + b.high, 1, partial);
  case VS_TAPE_SUB: return bounds(a.low - b.high, a.high - b.low, 1, partial);
  case VS_TAPE_MUL: return times(a, b, partial);
  case VS_TAPE_DIV: return over(a, b, partial);
  case VS_TAPE_NEG: return (vs_enclosure){ -a.high, -a.low, partial };
  case VS_TAPE_SQUARE: return squared(a);
  case VS_TAPE_ABS:
    if (a.low >= 0) return a;
    if (a.high <= 0) return (vs_enclosure){ -a.high, -a.low, partial };
    return (vs_enclosure){ 0, most(-a.low, a.high), partial };
  case VS_TAPE_SQRT: {
    vs_enclosure r = clipped(a, 0, INFINITY);
    if (r.low != r.low) return r;
    r = bounds(sqrt(r.low), sqrt(r.high), 1, r.partial);
    return r.low = most(r.low, 0), r;
  }
  case VS_TAPE_CBRT: return rising(cbrt, a, partial);
  case VS_TAPE_EXP: {
    vs_enclosure r = rising(exp, a, partial);
    return r.low = most(r.low, 0), r;
  }
  case VS_TAPE_LOG: {
    vs_enclosure r = clipped(a, 0, INFINITY);
    return r.low != r.low || r.high == 0
               ? none
               : bounds(r.low == 0 ? -INFINITY : log(r.low), log(r.high), 4, r.partial || r.low == 0);
  }
  case VS_TAPE_SIN: return wave(sin, a, 1.5707963267948966);
  case VS_TAPE_COS: return wave(cos, a, 0);
  case VS_TAPE_TAN:
    if (!(fabs(a.low) < 1e15 && fabs(a.high) < 1e15)) return all;
    return holds_turn((vs_enclosure){ 2 * a.low, 2 * a.high, false }, 3.141592653589793) ? all
                                                                                         : rising(tan, a, partial);
  case VS_TAPE_ASIN: {
    vs_enclosure r = clipped(a, -1, 1);
    return r.low != r.low ? r : rising(asin, r, r.partial);
  }
  case VS_TAPE_ACOS: {
    vs_enclosure r = clipped(a, -1, 1);
    return r.low != r.low ? r : bounds(acos(r.high), acos(r.low), 4, r.partial);
  }
  case VS_TAPE_ATAN: return rising(atan, a, partial);
  case VS_TAPE_ATAN2: return angle(a, b, partial);
  case VS_TAPE_SINH: return rising(sinh, a, partial);
  case VS_TAPE_COSH: {
    vs_enclosure r = bounds(a.low <= 0 && a.high >= 0 ? 1 : least(cosh(a.low), cosh(a.high)),
                            most(cosh(a.low), cosh(a.high)), 4, partial);
    return r.low = most(r.low, 1), r;
  }
  case VS_TAPE_TANH: return rising(tanh, a, partial);
  case VS_TAPE_POW: return power(a, b, partial);
  case VS_TAPE_MIN: return (vs_enclosure){ least(a.low, b.low), least(a.high, b.high), partial };
  case VS_TAPE_MAX: return (vs_enclosure){ most(a.low, b.low), most(a.high, b.high), partial };
  case VS_TAPE_FLOOR: return (vs_enclosure){ floor(a.low), floor(a.high), partial };
  case VS_TAPE_CEIL: return (vs_enclosure){ ceil(a.low), ceil(a.high), partial };
  case VS_TAPE_LESS: return (vs_enclosure){ a.high < b.low, a.low < b.high, partial };
  case VS_TAPE_ATMOST: return (vs_enclosure){ a.high <= b.low, a.low <= b.high, partial };
  case VS_TAPE_EQUAL:
    return (vs_enclosure){ a.low == a.high && b.low == b.high && a.low == b.low, a.low <= b.high && b.low <= a.high,
                           partial };
  case VS_TAPE_CHOOSE:
    if (a.low > 0 || a.high < 0) return b.partial = b.partial || a.partial, b;
    if (a.low == 0 && a.high == 0) return c.partial = c.partial || a.partial, c;
    if (b.low != b.low) return c.partial = true, c;
    if (c.low != c.low) return b.partial = true, b;
    return (vs_enclosure){ least(b.low, c.low), most(b.high, c.high), a.partial || b.partial || c.partial };
  case VS_TAPE_FIELD: /* not reached, because vs_enclose_tape handles fields */
  case VS_TAPE_CONSTANT:
  case VS_TAPE_INPUT:
  case VS_TAPE_OPERATORS: break;
  }
  return all;
}

/* Returns the bounds of a field over the box x, y, z: its value at the centre, plus and minus the distance from the
 * centre to a corner. A field changes by at most the distance between two points. */
static vs_enclosure enclose_field(const vs_tape_field *f, vs_enclosure x, vs_enclosure y, vs_enclosure z) {
  bool partial = x.partial || y.partial || z.partial;
  if (x.low != x.low || y.low != y.low || z.low != z.low) return none;
  const double middle[3] = { (x.low + x.high) / 2, (y.low + y.high) / 2, (z.low + z.high) / 2 };
  double a = x.high - x.low, b = y.high - y.low, c = z.high - z.low, reach = sqrt(a * a + b * b + c * c) / 2;
  double d = f->value(f, middle, NULL);
  return bounds(d - reach, d + reach, 8, partial);
}

vs_enclosure vs_enclose_tape(const vs_tape *t, const vs_enclosure *in, vs_enclosure *work) {
  for (size_t k = 0; k < t->count; k++) {
    const vs_tape_step *s = &t->step[k];
    if (s->op == VS_TAPE_CONSTANT)
      work[k] = (vs_enclosure){ s->value, s->value, s->value != s->value };
    else if (s->op == VS_TAPE_INPUT)
      work[k] = in[s->of[0]];
    else if (s->op == VS_TAPE_FIELD)
      work[k] = enclose_field(t->field[(size_t)s->value], work[s->of[0]], work[s->of[1]], work[s->of[2]]);
    else
      work[k] = vs_enclose((vs_tape_operator)s->op, work[s->of[0]], work[s->of[1]], work[s->of[2]]);
  }
  return work[t->output[0]];
}
