/* Implements the arithmetic of exact integers (integer.h).
 *
 * An operation puts the operands into roots of the garbage collector, computes the greatest size of the result, and
 * creates a bignum of that capacity. It then gets views of the operands; after this nothing allocates. It computes the
 * limbs (64-bit digits) in place. int_settle removes leading zeros, and returns a fixnum if the result fits. A bignum
 * may therefore have a word or two of unused capacity after its limbs. GMP itself allocates temporary memory in
 * mpn_mul, mpn_tdiv_qr and mpn_gcd, at most a small multiple of the operands. */
#include "vm/numbers/integer.h"

#include <float.h>
#include <math.h>

#include "vm/machine/native.h"

_Static_assert(GMP_LIMB_BITS == 64 && GMP_NAIL_BITS == 0, "limbs are the bignum's 64-bit words");

static bool int_too_large(vs_scheme *vm) {
  return vs_fail(vm, vm->sym.range, "the number would have more than %d million digits",
                 VS_INT_MAX_LIMBS / 1000000 * 20);
}

void vs_int_look(vs_value v, vs_int_view *w) {
  VS_ASSERT(vs_is_fixnum(v) || vs_is(v, VS_T_BIGNUM));
  if (vs_is_fixnum(v)) {
    int64_t n = vs_fixnum(v);
    w->negative = n < 0;
    w->small = n < 0 ? (mp_limb_t)-n : (mp_limb_t)n;
    w->at = &w->small;
    w->n = n != 0;
  } else {
    const vs_bignum *b = vs_as_bignum(v);
    w->negative = b->h.flags & VS_F_NEGATIVE;
    w->at = b->limb;
    w->n = (mp_size_t)b->count;
  }
}

/* Creates a bignum with room for n limbs (64-bit digits), all zero. */
static bool int_new(vs_scheme *vm, mp_size_t n, vs_value *out) {
  if (n > VS_INT_MAX_LIMBS) return int_too_large(vm);
  if (n < 1) n = 1;
  vs_bignum *b = (vs_bignum *)(void *)vs_gc_alloc(vm, VS_T_BIGNUM, sizeof(vs_bignum) / 8 + (size_t)n);
  if (!b) return false;
  b->count = (uint64_t)n;
  *out = vs_from_object(b);
  return true;
}

static mp_limb_t *int_limbs(vs_value v) { return vs_as_bignum(v)->limb; }

/* Polls for an interrupt before a multiplication whose operands have n limbs together. Large operands take about 100 ns
 * per limb, small operands less. */
static bool int_poll(vs_scheme *vm, mp_size_t n) { return n < 64 || vs_poll(vm, (uint64_t)n * (n < 1024 ? 4 : 32)); }

/* Shortens the bignum v to its lowest n limbs (64-bit digits) without leading zeros, and sets its sign. Returns v, or a
 * fixnum if the integer fits. */
static vs_value int_settle(vs_value v, mp_size_t n, bool negative) {
  vs_bignum *b = vs_as_bignum(v);
  VS_ASSERT(n >= 0 && (uint64_t)n <= b->count);
  while (n > 0 && b->limb[n - 1] == 0) n--;
  if (n == 0) return vs_fix(0);
  if (n == 1 && b->limb[0] <= (mp_limb_t)VS_FIXNUM_MAX + negative)
    return vs_fix(negative ? -(int64_t)b->limb[0] : (int64_t)b->limb[0]);
  b->count = (uint64_t)n;
  b->h.flags = (uint16_t)(negative ? b->h.flags | VS_F_NEGATIVE : b->h.flags & ~VS_F_NEGATIVE);
  return v;
}

/* Gets the views of the integers of[0] and of[1]. Call it again after each allocation, since the garbage collector may
 * move the integers. */
static void int_look_two(const vs_value of[2], vs_int_view *x, vs_int_view *y) {
  vs_int_look(of[0], x);
  vs_int_look(of[1], y);
}

bool vs_int_from_uint64(vs_scheme *vm, uint64_t n, vs_value *out) {
  if (n <= (uint64_t)VS_FIXNUM_MAX) return *out = vs_fix((int64_t)n), true;
  vs_value v;
  if (!int_new(vm, 1, &v)) return false;
  int_limbs(v)[0] = n;
  *out = int_settle(v, 1, false);
  return true;
}

bool vs_int_from_int64(vs_scheme *vm, int64_t n, vs_value *out) {
  if (vs_fits_fixnum(n)) return *out = vs_fix(n), true;
  vs_value v;
  if (!int_new(vm, 1, &v)) return false;
  int_limbs(v)[0] = n < 0 ? 0 - (uint64_t)n : (uint64_t)n;
  *out = int_settle(v, 1, n < 0);
  return true;
}

/* Computes a + b, or a - b if flip is true. */
static bool int_sum(vs_scheme *vm, vs_value a, vs_value b, bool flip, vs_value *out) {
  if (vs_is_fixnum(a) && vs_is_fixnum(b))
    return vs_int_from_int64(vm, flip ? vs_fixnum(a) - vs_fixnum(b) : vs_fixnum(a) + vs_fixnum(b), out);
  VS_ROOTS(vm, r, 3);
  r[0] = a;
  r[1] = b;
  vs_int_view x, y;
  int_look_two(r, &x, &y);
  if (!int_new(vm, (x.n > y.n ? x.n : y.n) + 1, &r[2])) return false;
  int_look_two(r, &x, &y);
  y.negative ^= flip;
  mp_limb_t *to = int_limbs(r[2]);
  const vs_int_view *big = &x, *small = &y;
  if (x.n < y.n || (x.n == y.n && mpn_cmp(x.at, y.at, x.n) < 0)) big = &y, small = &x;
  mp_size_t n = big->n;
  if (small->n == 0) {
    if (n) mpn_copyi(to, big->at, n);
  } else if (x.negative == y.negative) {
    to[n] = mpn_add(to, big->at, n, small->at, small->n);
    n++;
  } else {
    mpn_sub(to, big->at, n, small->at, small->n);
  }
  *out = int_settle(r[2], n, big->negative);
  return true;
}

bool vs_int_add(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) { return int_sum(vm, a, b, false, out); }
bool vs_int_sub(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) { return int_sum(vm, a, b, true, out); }
bool vs_int_negate(vs_scheme *vm, vs_value a, vs_value *out) { return int_sum(vm, vs_fix(0), a, true, out); }

bool vs_int_mul(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  if (vs_is_fixnum(a) && vs_is_fixnum(b)) {
    int64_t product;
    if (!__builtin_mul_overflow(vs_fixnum(a), vs_fixnum(b), &product)) return vs_int_from_int64(vm, product, out);
  }
  VS_ROOTS(vm, r, 3);
  r[0] = a;
  r[1] = b;
  vs_int_view x, y;
  int_look_two(r, &x, &y);
  if (x.n == 0 || y.n == 0) return *out = vs_fix(0), true;
  if (!int_poll(vm, x.n + y.n)) return false;
  if (!int_new(vm, x.n + y.n, &r[2])) return false;
  int_look_two(r, &x, &y);
  mp_limb_t *to = int_limbs(r[2]);
  if (x.at == y.at && x.n == y.n) mpn_sqr(to, x.at, x.n);
  else if (x.n >= y.n) mpn_mul(to, x.at, x.n, y.at, y.n);
  else mpn_mul(to, y.at, y.n, x.at, x.n);
  *out = int_settle(r[2], x.n + y.n, x.negative != y.negative);
  return true;
}

bool vs_int_divide(vs_scheme *vm, vs_value a, vs_value b, vs_value *quotient, vs_value *remainder) {
  VS_ASSERT(b != vs_fix(0));
  if (vs_is_fixnum(a) && vs_is_fixnum(b)) {
    int64_t n = vs_fixnum(a), d = vs_fixnum(b);
    if (remainder) *remainder = vs_fix(n % d);
    return !quotient || vs_int_from_int64(vm, n / d, quotient);       /* the quotient of the least fixnum and -1 is no
                                                                       * fixnum */
  }
  VS_ROOTS(vm, r, 4);
  r[0] = a;
  r[1] = b;
  vs_int_view x, y;
  int_look_two(r, &x, &y);
  if (x.n < y.n) {
    if (quotient) *quotient = vs_fix(0);
    if (remainder) *remainder = r[0];
    return true;
  }
  mp_size_t qn = x.n - y.n + 1, rn = y.n;
  if (!int_poll(vm, x.n) || !int_poll(vm, x.n)) return false;
  if (!int_new(vm, qn, &r[2]) || !int_new(vm, rn, &r[3])) return false;
  int_look_two(r, &x, &y);
  mpn_tdiv_qr(int_limbs(r[2]), int_limbs(r[3]), 0, x.at, x.n, y.at, y.n);
  if (quotient) *quotient = int_settle(r[2], qn, x.negative != y.negative);
  if (remainder) *remainder = int_settle(r[3], rn, x.negative);
  return true;
}

int vs_int_sign(vs_value a) {
  if (vs_is_fixnum(a)) return (vs_fixnum(a) > 0) - (vs_fixnum(a) < 0);
  return vs_object_of(a)->flags & VS_F_NEGATIVE ? -1 : 1;
}

bool vs_int_to_int64(vs_value a, int64_t *out) {
  if (vs_is_fixnum(a)) return *out = vs_fixnum(a), true;
  const vs_bignum *big = vs_as_bignum(a);
  VS_ASSERT(big->count > 0);
  bool negative = vs_int_sign(a) < 0;
  if (big->count > 1 || big->limb[0] > (uint64_t)INT64_MAX + negative) return false;
  *out = negative ? (int64_t)-big->limb[0] : (int64_t)big->limb[0];
  return true;
}

bool vs_int_is_odd(vs_value a) { return vs_is_fixnum(a) ? vs_fixnum(a) & 1 : (int)(vs_as_bignum(a)->limb[0] & 1); }

int vs_int_compare(vs_value a, vs_value b) {
  vs_int_view x, y;
  int_look_two((const vs_value[]){ a, b }, &x, &y);
  if (x.negative != y.negative) return x.negative ? -1 : 1;
  int order = x.n != y.n ? (x.n > y.n ? 1 : -1) : x.n ? mpn_cmp(x.at, y.at, x.n) : 0;
  order = (order > 0) - (order < 0);
  return x.negative ? -order : order;
}

/* Returns the number of bits of n limbs; the last limb is not 0. */
static uint64_t limbs_bits(const mp_limb_t *at, mp_size_t n) {
  VS_ASSERT(n == 0 || at[n - 1] != 0);
  return n ? (uint64_t)n * 64 - (uint64_t)__builtin_clzll(at[n - 1]) : 0;
}

uint64_t vs_int_bits(vs_value a) {
  vs_int_view x;
  vs_int_look(a, &x);
  return limbs_bits(x.at, x.n);
}

static uint64_t gcd_words(uint64_t a, uint64_t b) {
  while (b) {
    uint64_t t = a % b;
    a = b;
    b = t;
  }
  return a;
}

/* Copies the positive number `from` to `to` without its trailing zero bits, and returns the number of these bits. Sets
 * *n to the number of limbs of the copy. */
static uint64_t int_copy_odd(mp_limb_t *to, const mp_limb_t *from, mp_size_t *n) {
  uint64_t zeros = mpn_scan1(from, 0);
  mp_size_t limbs = (mp_size_t)(zeros / 64);
  VS_ASSERT(*n > 0 && from[*n - 1] != 0);
  *n -= limbs;
  if (zeros % 64) mpn_rshift(to, from + limbs, *n, (unsigned)(zeros % 64));
  else mpn_copyi(to, from + limbs, *n);
  while (to[*n - 1] == 0) --*n;
  return zeros;
}

bool vs_int_gcd(vs_scheme *vm, vs_value a, vs_value b, vs_value *out) {
  VS_ROOTS(vm, r, 3);
  r[0] = a;
  r[1] = b;
  vs_int_view x, y;
  int_look_two(r, &x, &y);
  if (x.n == 0) return y.negative ? vs_int_negate(vm, b, out) : (*out = b, true);
  if (y.n == 0) return x.negative ? vs_int_negate(vm, a, out) : (*out = a, true);
  if (x.n == 1 && y.n == 1) return vs_int_from_uint64(vm, gcd_words(x.at[0], y.at[0]), out);
  if (x.n == 1 || y.n == 1) {      /* one operand has one limb, as usual when a fraction is reduced */
    mp_limb_t one = x.n == 1 ? x.at[0] : y.at[0];
    mp_limb_t rest = x.n == 1 ? mpn_mod_1(y.at, y.n, one) : mpn_mod_1(x.at, x.n, one);
    return vs_int_from_uint64(vm, gcd_words(one, rest), out);
  }
  for (int i = 0; i < 8; i++)
    if (!int_poll(vm, x.n + y.n)) return false;
  mp_size_t nx = x.n, ny = y.n, least = nx < ny ? nx : ny;
  size_t bytes = (size_t)(nx + ny) * sizeof(mp_limb_t);
  mp_limb_t *scratch = vs_mem(vm, NULL, 0, bytes);
  if (!scratch) return vs_fail_memory(vm);
  bool ok = int_new(vm, least + 2, &r[2]);
  if (ok) {
    int_look_two(r, &x, &y);
    mp_limb_t *p = scratch, *q = scratch + nx;
    uint64_t zp = int_copy_odd(p, x.at, &nx), zq = int_copy_odd(q, y.at, &ny);
    uint64_t bp = limbs_bits(p, nx), bq = limbs_bits(q, ny);
    mp_limb_t *to = int_limbs(r[2]);
    mp_size_t n = bp >= bq ? mpn_gcd(to, p, nx, q, ny) : mpn_gcd(to, q, ny, p, nx);
    uint64_t shift = zp < zq ? zp : zq;
    mp_size_t limbs = (mp_size_t)(shift / 64);
    if (shift % 64) {
      mp_limb_t high = mpn_lshift(to, to, n, (unsigned)(shift % 64));
      if (high) to[n++] = high;
    }
    if (limbs) {
      mpn_copyd(to + limbs, to, n);
      mpn_zero(to, limbs);
      n += limbs;
    }
    *out = int_settle(r[2], n, false);
  }
  vs_mem(vm, scratch, bytes, 0);
  return ok;
}

bool vs_int_shift(vs_scheme *vm, vs_value a, int64_t left, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = a;
  vs_int_view x;
  vs_int_look(a, &x);
  if (x.n == 0 || left == 0) return *out = a, true;
  if (left > 0) {
    if (left > (int64_t)VS_INT_MAX_LIMBS * 64) return int_too_large(vm);
    mp_size_t limbs = (mp_size_t)(left / 64), n = x.n;
    if (!int_new(vm, n + limbs + 1, &r[1])) return false;
    vs_int_look(r[0], &x);
    mp_limb_t *to = int_limbs(r[1]);
    if (left % 64) to[n + limbs] = mpn_lshift(to + limbs, x.at, n, (unsigned)(left % 64));
    else mpn_copyi(to + limbs, x.at, n);
    *out = int_settle(r[1], n + limbs + 1, x.negative);
    return true;
  }
  uint64_t right = 0 - (uint64_t)left;
  if (right / 64 >= (uint64_t)x.n) return *out = vs_fix(x.negative ? -1 : 0), true;
  mp_size_t limbs = (mp_size_t)(right / 64), n = x.n - limbs;
  if (!int_new(vm, n + 1, &r[1])) return false;
  vs_int_look(r[0], &x);
  mp_limb_t *to = int_limbs(r[1]);
  bool lost = mpn_scan1(x.at, 0) < right;
  if (right % 64) mpn_rshift(to, x.at + limbs, n, (unsigned)(right % 64));
  else mpn_copyi(to, x.at + limbs, n);
  to[n] = 0;
  if (x.negative && lost) mpn_add_1(to, to, n + 1, 1);
  *out = int_settle(r[1], n + 1, x.negative);
  return true;
}

bool vs_int_power(vs_scheme *vm, vs_value a, uint64_t n, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = a;
  r[1] = vs_fix(1);
  uint64_t bits = vs_int_bits(a);
  if (bits > 1 && n > (uint64_t)VS_INT_MAX_LIMBS * 64 / (bits - 1)) return int_too_large(vm);
  if (bits <= 1 && n > 1) n = 2 + (n & 1);           /* for the bases 0, 1 and -1 only the parity of the exponent
                                                      * matters */
  for (;; n >>= 1) {
    if ((n & 1) && !vs_int_mul(vm, r[1], r[0], &r[1])) return false;
    if (n <= 1) break;
    if (!vs_int_mul(vm, r[0], r[0], &r[0])) return false;
  }
  *out = r[1];
  return true;
}

bool vs_int_sqrt(vs_scheme *vm, vs_value a, vs_value *root, vs_value *rest) {
  VS_ROOTS(vm, r, 3);
  VS_ASSERT(vs_int_sign(a) >= 0);
  r[0] = a;
  vs_int_view x;
  vs_int_look(a, &x);
  mp_size_t n = x.n, half = (n + 1) / 2;
  if (n == 0) {
    *root = *rest = vs_fix(0);
    return true;
  }
  if (!int_poll(vm, 2 * n)) return false;
  if (!int_new(vm, half, &r[1]) || !int_new(vm, n, &r[2])) return false;
  vs_int_look(r[0], &x);
  mp_size_t left = mpn_sqrtrem(int_limbs(r[1]), int_limbs(r[2]), x.at, n);
  *root = int_settle(r[1], half, false);
  *rest = int_settle(r[2], left, false);
  return true;
}

/* Writes the integer w in two's complement to n limbs. |w| must not have more than n limbs. */
static void int_complement(const vs_int_view *w, mp_limb_t *to, mp_size_t n) {
  VS_ASSERT(n >= w->n);
  if (w->n) mpn_copyi(to, w->at, w->n);
  if (n > w->n) mpn_zero(to + w->n, n - w->n);
  if (w->negative) mpn_neg(to, to, n);
}

bool vs_int_bitwise(vs_scheme *vm, char op, vs_value a, vs_value b, vs_value *out) {
  VS_ASSERT(op == '&' || op == '|' || op == '^');
  if (vs_is_fixnum(a) && vs_is_fixnum(b)) {
    int64_t x = vs_fixnum(a), y = vs_fixnum(b);
    *out = vs_fix(op == '&' ? x & y : op == '|' ? x | y : x ^ y);
    return true;
  }
  VS_ROOTS(vm, r, 4);
  r[0] = a;
  r[1] = b;
  vs_int_view x, y;
  int_look_two(r, &x, &y);
  mp_size_t n = (x.n > y.n ? x.n : y.n) + 1;
  if (!int_new(vm, n, &r[2]) || !int_new(vm, n, &r[3])) return false;
  int_look_two(r, &x, &y);
  mp_limb_t *p = int_limbs(r[2]), *q = int_limbs(r[3]);
  int_complement(&x, p, n);
  int_complement(&y, q, n);
  for (mp_size_t i = 0; i < n; i++) p[i] = op == '&' ? p[i] & q[i] : op == '|' ? p[i] | q[i] : p[i] ^ q[i];
  bool negative = p[n - 1] >> 63;
  if (negative) mpn_neg(p, p, n);
  *out = int_settle(r[2], n, negative);
  return true;
}

/* ---- integers as texts: GMP converts at most PIECE digits at once; a longer number is divided into pieces, or
 * composed of pieces ---- */

enum { PIECE = 20000, SQUARINGS = 14 /* PIECE * 2^14 digits exceed the largest number */ };

/* Sets p[k] = radix^(PIECE * 2^k) for all k for which this power has fewer than `digits` digits. Sets *count to the
 * number of these powers. */
static bool piece_powers(vs_scheme *vm, int radix, double digits, vs_value *p, int *count) {
  int k = 0;
  for (double of_one = PIECE; of_one < digits && k < SQUARINGS; of_one *= 2, k++)
    if (!(k ? vs_int_mul(vm, p[k - 1], p[k - 1], &p[k]) : vs_int_power(vm, vs_fix(radix), PIECE, &p[0]))) return false;
  *count = k;
  return true;
}

/* Writes the digits of |a|, at most about PIECE digits, with leading zeros up to `width` digits. The radix is 2 to
 * 36. */
static bool print_piece(vs_scheme *vm, vs_value a, int radix, size_t width, vs_text *t) {
  static const char digit[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  vs_int_view x;
  VS_ASSERT(radix >= 2 && radix <= 36);
  vs_int_look(a, &x);
  if (!int_poll(vm, x.n)) return false;
  size_t limb_bytes = (size_t)(x.n + 1) * sizeof(mp_limb_t);
  size_t room = (x.n ? mpn_sizeinbase(x.at, x.n, radix) : 1) + 2, n = 0, skip = 0;
  mp_limb_t *copy = vs_mem(vm, NULL, 0, limb_bytes);
  unsigned char *s = vs_mem(vm, NULL, 0, room);
  bool ok = copy && s;
  if (!ok) {
    vs_fail_memory(vm);
  } else {
    if (x.n) {
      mpn_copyi(copy, x.at, x.n);                                  /* mpn_get_str overwrites its input */
      n = mpn_get_str(s, radix, copy, x.n);
    }
    while (skip < n && s[skip] == 0) skip++;
    for (size_t i = skip; i < n; i++) s[i] = (unsigned char)digit[s[i]];
    for (size_t i = n - skip; ok && i < width; i++) ok = vs_text_put(t, "0", 1);
    ok = ok && vs_text_put(t, (const char *)s + skip, n - skip);
  }
  if (s) vs_mem(vm, s, room, 0);
  if (copy) vs_mem(vm, copy, limb_bytes, 0);
  return ok;
}

bool vs_int_print(vs_scheme *vm, vs_value a, int radix, vs_text *t) {
  static const char digit[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  vs_int_view x;
  VS_ASSERT(radix >= 2 && radix <= 36);
  vs_int_look(a, &x);
  if (x.negative && !vs_text_put(t, "-", 1)) return false;
  if (x.n <= 1) {
    char s[64];
    size_t i = sizeof s;
    uint64_t n = x.n ? x.at[0] : 0;
    do s[--i] = digit[n % (unsigned)radix];
    while (n /= (unsigned)radix);
    return vs_text_put(t, s + i, sizeof s - i);
  }
  VS_ROOTS(vm, p, SQUARINGS);
  VS_ROOTS(vm, r, SQUARINGS + 2);            /* roots of the garbage collector: the parts not yet written, the highest
                                              * digits last */
  struct { int level; bool first; } todo[SQUARINGS + 2];
  int count, top = 0;
  r[0] = a;
  if (!piece_powers(vm, radix, (double)vs_int_bits(a) / log2(radix), p, &count)) return false;
  todo[0].level = count;
  todo[0].first = true;
  while (top >= 0) {                         /* a part of level k is less than p[k - 1]^2; a part of level 0 is less
                                              * than p[0] */
    int level = todo[top].level;
    bool first = todo[top].first;
    if (level == 0) {
      if (!print_piece(vm, r[top], radix, first ? 0 : PIECE, t)) return false;
      top--;
      continue;
    }
    vs_value whole = r[top];
    if (!vs_int_divide(vm, whole, p[level - 1], &r[top + 1], &r[top])) return false;
    todo[top].level = todo[top + 1].level = level - 1;
    todo[top + 1].first = first;
    todo[top].first = first && r[top + 1] == vs_fix(0);
    if (!todo[top].first) top++;             /* the part with the highest digits is written without leading zeros */
  }
  return true;
}

static bool piece_from_digits(vs_scheme *vm, const unsigned char *digits, size_t n, int radix, vs_value *out) {
  while (n && *digits == 0) digits++, n--;
  if (n <= 12) {                     /* 12 digits fit 63 bits in every radix: 36^12 < 2^63 */
    int64_t v = 0;
    for (size_t i = 0; i < n; i++) v = v * radix + digits[i];
    return vs_int_from_int64(vm, v, out);
  }
  mp_size_t limbs = (mp_size_t)((double)n * log2(radix) / 64.0) + 2;
  vs_value v;
  if (!int_poll(vm, limbs) || !int_new(vm, limbs, &v)) return false;
  mp_size_t used = mpn_set_str(int_limbs(v), digits, n, radix);
  *out = int_settle(v, used, false);
  return true;
}

bool vs_int_from_digits(vs_scheme *vm, const unsigned char *digits, size_t n, int radix, bool negative, vs_value *out) {
  VS_ROOTS(vm, p, SQUARINGS);
  VS_ROOTS(vm, r, 3);                        /* roots of the garbage collector: the pieces of digits, the lowest first,
                                              * and two pieces that are being joined */
  int count;
  VS_ASSERT(radix >= 2 && radix <= 36);
  while (n && *digits == 0) digits++, n--;
  if ((double)n * log2(radix) / 64 > VS_INT_MAX_LIMBS) return int_too_large(vm);
  if (n <= PIECE)
    return piece_from_digits(vm, digits, n, radix, &r[1]) &&
           (negative ? vs_int_negate(vm, r[1], out) : (*out = r[1], true));
  size_t pieces = (n + PIECE - 1) / PIECE, end = n;
  if (!piece_powers(vm, radix, (double)n, p, &count) || !vs_make_vector(vm, pieces, VS_FALSE, &r[0])) return false;
  for (size_t i = 0; i < pieces; i++, end -= PIECE) {
    size_t width = end < PIECE ? end : PIECE;
    if (!piece_from_digits(vm, digits + end - width, width, radix, &r[1])) return false;
    vs_gc_store(vm, vs_as_vector(r[0]), &vs_as_vector(r[0])->at[i], r[1]);
  }
  for (int k = 0; pieces > 1; k++, pieces = (pieces + 1) / 2)      /* joins pairs of neighbouring pieces to pieces of
                                                                    * the next level */
    for (size_t i = 0; i < (pieces + 1) / 2; i++) {
      r[1] = vs_as_vector(r[0])->at[2 * i];
      if (2 * i + 1 < pieces &&
          (!vs_int_mul(vm, vs_as_vector(r[0])->at[2 * i + 1], p[k], &r[2]) || !vs_int_add(vm, r[2], r[1], &r[1])))
        return false;
      vs_gc_store(vm, vs_as_vector(r[0]), &vs_as_vector(r[0])->at[i], r[1]);
    }
  *out = vs_as_vector(r[0])->at[0];
  return !negative || vs_int_negate(vm, *out, out);
}

/* ---- integers as doubles ---- */

/* Returns the double nearest to top * 2^e, even if it is subnormal. Bit 63 of top is set. sticky: whether the exact
 * number has nonzero bits below those in top, which matters for rounding. */
static double round_top(uint64_t top, bool sticky, int64_t e) {
  int64_t high = e + 63;                         /* exponent of the leading bit of the result */
  VS_ASSERT(top >> 63 == 1);
  if (high > DBL_MAX_EXP) return HUGE_VAL;
  int64_t precision = high >= DBL_MIN_EXP - 1 ? DBL_MANT_DIG : DBL_MANT_DIG + high - (DBL_MIN_EXP - 1);
  if (precision < 0) return 0.0;
  unsigned shift = (unsigned)(64 - precision);
  uint64_t kept = shift == 64 ? 0 : top >> shift;
  uint64_t rest = shift == 64 ? top : top & ((UINT64_C(1) << shift) - 1), half = UINT64_C(1) << (shift - 1);
  if (rest > half || (rest == half && (sticky || (kept & 1)))) kept++;
  return ldexp((double)kept, (int)(e + shift));
}

/* Returns the double nearest to the number in n limbs, times 2^e. sticky: whether the exact number has nonzero bits
 * below the limbs. */
static double limbs_double(const mp_limb_t *at, mp_size_t n, bool sticky, int64_t e) {
  while (n && at[n - 1] == 0) n--;
  if (n == 0) return 0.0;
  int zeros = __builtin_clzll(at[n - 1]);
  uint64_t top = at[n - 1] << zeros;
  mp_size_t rest = n - 1;
  if (zeros && n > 1) {
    top |= at[n - 2] >> (64 - zeros);
    sticky |= (at[n - 2] << zeros) != 0;
    rest = n - 2;
  }
  for (mp_size_t i = rest; i-- > 0 && !sticky;) sticky = at[i] != 0;
  return round_top(top, sticky, e + (int64_t)(n - 1) * 64 - zeros);
}

double vs_int_double(vs_value a) {
  if (vs_is_fixnum(a)) return (double)vs_fixnum(a);
  vs_int_view x;
  vs_int_look(a, &x);
  double d = limbs_double(x.at, x.n, false, 0);
  return x.negative ? -d : d;
}

bool vs_int_ratio_double(vs_scheme *vm, vs_value num, vs_value den, double *out) {
  VS_ASSERT(vs_int_sign(num) > 0 && vs_int_sign(den) > 0);
  if (vs_is_fixnum(num) && vs_is_fixnum(den)) {      /* numerator and denominator are exact as doubles, so that the
                                                      * division rounds only once */
    *out = (double)vs_fixnum(num) / (double)vs_fixnum(den);
    return true;
  }
  /* Scales numerator and denominator so that the quotient has 66 or 67 bits. The quotient fits into two limbs; whether
   * the remainder is 0 determines the rounding. */
  VS_ROOTS(vm, r, 4);
  r[0] = num;
  r[1] = den;
  int64_t shift = 66 - ((int64_t)vs_int_bits(num) - (int64_t)vs_int_bits(den));
  if (!(shift >= 0 ? vs_int_shift(vm, r[0], shift, &r[0]) : vs_int_shift(vm, r[1], -shift, &r[1])) ||
      !vs_int_divide(vm, r[0], r[1], &r[2], &r[3]))
    return false;
  vs_int_view q;
  vs_int_look(r[2], &q);
  *out = limbs_double(q.at, q.n, vs_int_sign(r[3]) != 0, -shift);
  return true;
}

bool vs_int_from_double(vs_scheme *vm, double d, vs_value *out) {
  VS_ASSERT(isfinite(d) && d == floor(d));
  if (fabs(d) <= (double)VS_FIXNUM_MAX) return *out = vs_fix((int64_t)d), true;
  int e;
  double m = frexp(fabs(d), &e);
  VS_ROOTS(vm, r, 1);
  return vs_int_from_int64(vm, (d < 0 ? -1 : 1) * (int64_t)ldexp(m, 53), &r[0]) &&
         vs_int_shift(vm, r[0], e - 53, out);
}
