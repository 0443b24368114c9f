/* Implements random numbers, clocks, and procedures that return facts about the program's environment.
 *
 * The random generator is xoshiro256** (Blackman and Vigna), seeded by splitmix64. Its state is a bytevector in
 * vm->at.lib. It is therefore part of the heap image, and the same at every start of the program. */
#include "vm/library/system.h"

#include <math.h>

#include "vm/machine/fail.h"
#include "vm/numbers/integer.h"
#include "vm/library/kept.h"
#include "vm/library/port.h"
#include "vm/numbers/number.h"
#include "vm/numbers/number_text.h"
#include "vm/values/heap.h"

enum { FIRST_SEED = 1, RANDOM_BYTES = 40 /* RANDOM_BYTES: size of the generator's state in bytes: four words and the
                                          * seed, of 8 bytes each */ };

/* ---- random numbers ---- */

static void seed_state(uint64_t s[4], uint64_t seed) {
  for (int i = 0; i < 4; i++) {
    seed += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t z = seed;
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    s[i] = z ^ z >> 31;
  }
}

/* Returns the four words of the generator's state, followed by the seed that the program has set. The address is valid
 * until the next allocation. Returns NULL when memory is out. */
static uint64_t *random_state(vs_scheme *vm) {
  if (vs_lib_get(vm, VS_LIB_RANDOM) == VS_FALSE) {
    VS_ROOTS(vm, r, 1);
    if (!vs_lib_open(vm) || !vs_make_bytes(vm, RANDOM_BYTES, &r[0])) return NULL;
    uint64_t *s = (uint64_t *)(void *)vs_as_bytes(r[0])->at;
    seed_state(s, FIRST_SEED);
    s[4] = FIRST_SEED;
    vs_lib_set(vm, VS_LIB_RANDOM, r[0]);
  }
  return (uint64_t *)(void *)vs_as_bytes(vs_lib_get(vm, VS_LIB_RANDOM))->at;
}

static uint64_t rotate(uint64_t x, int k) { return x << k | x >> (64 - k); }

static uint64_t random_next(uint64_t s[4]) {
  uint64_t result = rotate(s[1] * 5, 7) * 9, t = s[1] << 17;
  s[2] ^= s[0], s[3] ^= s[1], s[1] ^= s[2], s[0] ^= s[3];
  s[2] ^= t;
  s[3] = rotate(s[3], 45);
  return result;
}

static double random_unit(uint64_t s[4]) { return (double)(random_next(s) >> 11) * 0x1p-53; }        /* returns a number
                                                                                                      * in [0, 1) */

bool vs_random_keep(vs_scheme *vm, uint64_t state[4]) {
  const uint64_t *s = random_state(vm);
  if (s) memcpy(state, s, 4 * sizeof *s);
  return s != NULL;
}
bool vs_random_restore(vs_scheme *vm, const uint64_t state[4]) {
  uint64_t *s = random_state(vm);
  if (s) memcpy(s, state, 4 * sizeof *s);
  return s != NULL;
}
bool vs_random_branch(vs_scheme *vm, uint64_t key) {
  uint64_t *s = random_state(vm);
  if (s) seed_state(s, key ^ s[4] * UINT64_C(0x9E3779B97F4A7C15));
  return s != NULL;
}
bool vs_random_unit(vs_scheme *vm, double *out) {
  uint64_t *s = random_state(vm);
  if (s) *out = random_unit(s);
  return s != NULL;
}

/* Sets *out to a random integer from 0 to n - 1, uniformly distributed, for an exact integer n > 0. */
static bool random_below(vs_scheme *vm, vs_value n, vs_value *out) {
  uint64_t *s = random_state(vm);
  VS_ASSERT(vs_is_exact_integer(n) && vs_int_sign(n) > 0);
  if (!s) return false;
  if (vs_is_fixnum(n)) {                          /* rejects random numbers that would make some remainders modulo n
                                                   * more likely than others */
    uint64_t bound = (uint64_t)vs_fixnum(n), least = (0 - bound) % bound, x;
    do x = random_next(s);
    while (x < least);
    return *out = vs_fix((int64_t)(x % bound)), true;
  }
  /* n is a bignum: the result is a random number 64 bits longer than n, modulo n. Its deviation from equal probability
   * is below 2^-64. */
  VS_ROOTS(vm, r, 3);
  r[0] = n;
  r[1] = vs_fix(0);
  for (uint64_t bits = vs_int_bits(n) + 64, done = 0; done < bits; done += 64) {
    if (!(s = random_state(vm)) || !vs_int_from_uint64(vm, random_next(s), &r[2]) ||
        !vs_int_shift(vm, r[1], 64, &r[1]) || !vs_int_add(vm, r[1], r[2], &r[1]))
      return false;
  }
  return vs_int_divide(vm, r[1], r[0], NULL, out);
}

static vs_status random_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  uint64_t *s;
  if (n == 0) return (s = random_state(vm)) ? (*out = vs_flonum(random_unit(s)), VS_OK) : VS_ERROR;
  if (vs_is_exact_integer(a[0]))
    return vs_int_sign(a[0]) > 0 ? random_below(vm, a[0], out) : vs_fail_type(vm, 0, "positive", a[0]);
  double d;
  if (!vs_is_number(a[0])) return vs_fail_type(vm, 0, "a number", a[0]);
  if (!vs_number_double(vm, a[0], &d)) return VS_ERROR;
  if (!(d > 0) || isinf(d)) return vs_fail_type(vm, 0, "positive", a[0]);
  if (!(s = random_state(vm))) return VS_ERROR;
  double x = random_unit(s) * d;
  return *out = vs_flonum(x < d ? x : 0), VS_OK;
}

/* Sets *out to a random number. For exact integers a and b, it is an integer from a to b, including both; otherwise it
 * is a number from a to b, excluding b. */
static vs_status random_range(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  for (int i = 0; i < 2; i++)
    if (!vs_is_number(a[i])) return vs_fail_type(vm, i, "a number", a[i]);
  VS_ROOTS(vm, r, 1);
  if (vs_is_exact_integer(a[0]) && vs_is_exact_integer(a[1])) {
    if (vs_int_compare(a[0], a[1]) > 0) return vs_fail_type(vm, 1, "at least a", a[1]);
    return vs_int_sub(vm, a[1], a[0], &r[0]) && vs_int_add(vm, r[0], vs_fix(1), &r[0]) &&
           random_below(vm, r[0], &r[0]) && vs_int_add(vm, a[0], r[0], out);
  }
  double x, y;
  if (!vs_number_double(vm, a[0], &x) || !vs_number_double(vm, a[1], &y)) return VS_ERROR;
  uint64_t *s = random_state(vm);
  return s ? (*out = vs_flonum(x + random_unit(s) * (y - x)), VS_OK) : VS_ERROR;
}

static vs_status random_seed(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  if (!vs_is_number(a[0])) return vs_fail_type(vm, 0, "a number", a[0]);
  uint64_t *s = random_state(vm);
  if (!s) return VS_ERROR;
  s[4] = vs_is_fixnum(a[0]) ? (uint64_t)vs_fixnum(a[0]) : vs_number_hash(a[0]);
  seed_state(s, s[4]);
  return VS_OK;
}

/* (%random-state): returns a copy of the generator's state. (%random-state! copy) restores it, and refuses a state of
 * zeros, from which the generator would never leave. */
static vs_status random_copy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  VS_ROOTS(vm, r, 1);
  if (!random_state(vm) || !vs_make_bytes(vm, RANDOM_BYTES, &r[0])) return VS_ERROR;
  const uint64_t *s = random_state(vm);
  if (!s) return VS_ERROR;
  memcpy(vs_as_bytes(r[0])->at, s, RANDOM_BYTES);
  return *out = r[0], VS_OK;
}
static vs_status random_set(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  uint64_t *s = random_state(vm), state[RANDOM_BYTES / sizeof(uint64_t)];
  if (!s) return VS_ERROR;
  if (!vs_is(a[0], VS_T_BYTES) || vs_as_bytes(a[0])->length != RANDOM_BYTES)
    return vs_fail_type(vm, 0, "the state of a random source", a[0]);
  memcpy(state, vs_as_bytes(a[0])->at, RANDOM_BYTES);
  if (!(state[0] | state[1] | state[2] | state[3])) return vs_fail_type(vm, 0, "the state of a random source", a[0]);
  memcpy(s, state, RANDOM_BYTES);
  return VS_OK;
}

/* ---- clocks ---- */

static double seconds_now(const vs_scheme *vm) {
  return vm->config.io && vm->config.io->now ? vm->config.io->now(vm->config.user) : 0;
}
static double seconds_running(const vs_scheme *vm) {
  return vm->config.clock ? vm->config.clock(vm->config.user) : seconds_now(vm);
}

static vs_status current_second(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)a, (void)n, *out = vs_flonum(seconds_now(vm)), VS_OK;
}
static vs_status current_seconds(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)a, (void)n, vs_int_from_double(vm, floor(seconds_now(vm)), out);
}
static vs_status current_milliseconds(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)a, (void)n, vs_int_from_double(vm, floor(seconds_now(vm) * 1000), out);
}
static vs_status current_inexact_milliseconds(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)a, (void)n, *out = vs_flonum(seconds_now(vm) * 1000), VS_OK;
}
static vs_status current_jiffy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)a, (void)n, vs_int_from_double(vm, floor(seconds_running(vm) * 1e6), out);
}
static vs_status jiffies_per_second(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)a, (void)n, *out = vs_fix(1000000), VS_OK;
}
static vs_status runtime(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)a, (void)n, *out = vs_flonum(seconds_running(vm)), VS_OK;
}

/* ---- environment of the program ---- */

static vs_status command_line(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  static const char *const alone[] = {"vs"};
  size_t count = vm->config.command_line_count;
  const char *const *words = count ? vm->config.command_line : alone;
  VS_ROOTS(vm, r, 1);
  *out = VS_NIL;
  for (size_t i = count ? count : 1; i-- > 0;)
    if (!vs_string_from_utf8(vm, words[i], strlen(words[i]), &r[0]) || !vs_cons(vm, r[0], *out, out)) return VS_ERROR;
  return VS_OK;
}

static vs_status get_environment_variable(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_arg_type(vm, a, 0, VS_T_STRING)) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_string(&t, a[0]) && vs_text_end(&t);
  const char *value =
      ok && vm->config.io && vm->config.io->getenv ? vm->config.io->getenv(vm->config.user, t.at) : NULL;
  *out = VS_FALSE;
  ok = ok && (!value || vs_string_from_utf8(vm, value, strlen(value), out));
  vs_text_close(&t);
  return ok;
}

static vs_status get_environment_variables(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  const vs_io *io = vm->config.io;
  VS_ROOTS(vm, r, 3);
  r[0] = VS_NIL;
  const char *text;
  for (size_t i = 0; io && io->variable && (text = io->variable(vm->config.user, i)); i++) {
    const char *sign = strchr(text, '=');
    if (!sign) continue;
    if (!vs_string_from_utf8(vm, text, (size_t)(sign - text), &r[1]) ||
        !vs_string_from_utf8(vm, sign + 1, strlen(sign + 1), &r[2]) || !vs_cons(vm, r[1], r[2], &r[1]) ||
        !vs_cons(vm, r[1], r[0], &r[0]))
      return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

static vs_status gc(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n, (void)out;
  vs_gc_major(vm);
  return VS_OK;
}

/* Returns a new symbol. It is not interned, and therefore different from all other symbols; its name need not be
 * unique. */
static vs_status generate_symbol(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n && !vs_is_symbol(a[0]) && !vs_is_string(a[0])) return vs_fail_type(vm, 0, "a symbol or a string", a[0]);
  if (!vs_lib_open(vm)) return VS_ERROR;
  vs_value last = vs_lib_get(vm, VS_LIB_SYMBOLS);
  int64_t count = vs_is_fixnum(last) ? vs_fixnum(last) + 1 : 1;
  vs_lib_set(vm, VS_LIB_SYMBOLS, vs_fix(count));
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = (n == 0                ? vs_text_put(&t, "g", 1)
             : vs_is_symbol(a[0]) ? vs_text_put(&t, vs_as_symbol(a[0])->name, vs_as_symbol(a[0])->length)
                                  : vs_text_string(&t, a[0])) &&
            vs_number_print(vm, vs_fix(count), 10, &t);
  vs_symbol *symbol =
      ok ? (vs_symbol *)(void *)vs_gc_alloc(vm, VS_T_SYMBOL, VS_WORDS(vs_symbol) + t.count / 8 + 1) : NULL;
  if (symbol) {
    symbol->h.flags |= VS_F_UNINTERNED;
    symbol->length = (uint32_t)t.count;
    symbol->hash = (uint32_t)count * 2654435761u;
    memcpy(symbol->name, t.at, t.count);
    *out = vs_from_object(symbol);
  }
  vs_text_close(&t);
  return symbol != NULL;
}

static const vs_native_def defs[] = {
    {"random", "[n]", random_, 0, "an exact integer below n, or a number below the inexact n (1.0 by default)"},
    {"random-range", "a b", random_range, 0, "a random integer from a to b, or number between them"},
    {"%random-state", "", random_copy, 0, ""},
    {"%random-state!", "state", random_set, 0, ""},
    {"random-seed! random-seed", "n", random_seed, 0, "start the random numbers anew from n"},
    {"current-second", "", current_second, 0, NULL},
    {"current-seconds", "", current_seconds, 0, NULL},
    {"current-milliseconds", "", current_milliseconds, 0, NULL},
    {"current-inexact-milliseconds", "", current_inexact_milliseconds, 0, NULL},
    {"current-jiffy", "", current_jiffy, 0, NULL},
    {"jiffies-per-second", "", jiffies_per_second, 0, NULL},
    {"runtime", "", runtime, 0, "seconds on a clock that only goes forward"},
    {"command-line", "", command_line, 0, "the program's name and its arguments, which follow -- in the command"},
    {"get-environment-variable getenv", "name", get_environment_variable, 0, NULL},
    {"get-environment-variables", "", get_environment_variables, 0, NULL},
    {"collect-garbage gc", "", gc, 0, NULL},
    {"gensym generate-uninterned-symbol", "[prefix]", generate_symbol, 0, "a symbol that nothing else is"},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_system_natives = {"system", defs};
