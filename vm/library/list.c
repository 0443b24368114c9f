/* Implements the procedures of pairs and lists that have no procedure arguments. Procedures with such arguments are
 * written in Scheme (prelude.scm and library/srfi.scm).
 *
 * New lists grow at their end by means of a list_maker, an array of roots of the garbage collector. Procedures
 * determine the length of a user's list before they read it (vs_list_length). An improper or circular list is therefore
 * an error, and never an endless loop. */
#include "vm/machine/fail.h"
#include "vm/values/equal.h"
#include "vm/machine/native.h"
#include "vm/numbers/number.h"
#include "vm/values/pairs.h"

enum { POLL_STEP = 1024, POLL_COST = 4 * POLL_STEP /* POLL_STEP: number of pairs read or created between two polls for
                                                    * an interrupt */ };

/* ---- building lists ---- */

enum { HEAD, TAIL, NEW, MAKER_ROOTS }; /* number of garbage-collector roots in a list_maker */
#define LIST_MAKER(vm, r) VS_ROOTS(vm, r, MAKER_ROOTS); r[HEAD] = r[TAIL] = VS_NIL

/* Appends an element to the list of a list_maker r. x need not be a root of the garbage collector: vs_cons protects
 * it. */
static bool maker_add(vs_scheme *vm, vs_value *r, vs_value x) {
  if (!vs_cons(vm, x, VS_NIL, &r[NEW])) return false;
  if (r[HEAD] == VS_NIL) r[HEAD] = r[NEW];
  else vs_gc_store(vm, vs_object_of(r[TAIL]), &vs_as_pair(r[TAIL])->cdr, r[NEW]);
  r[TAIL] = r[NEW];
  return true;
}

static void maker_end(vs_scheme *vm, vs_value *r, vs_value last) {
  if (r[HEAD] == VS_NIL) r[HEAD] = last;
  else vs_gc_store(vm, vs_object_of(r[TAIL]), &vs_as_pair(r[TAIL])->cdr, last);
}

/* Appends the first n elements of *list to the list of a list_maker r, and advances *list past them. *list is a root of
 * the garbage collector. */
static bool maker_copy(vs_scheme *vm, vs_value *r, vs_value *list, int64_t n) {
  VS_ASSERT(n >= 0);
  for (int64_t i = 0; i < n; i++) {
    if (!maker_add(vm, r, vs_car(*list)) || (i % POLL_STEP == POLL_STEP - 1 && !vs_poll(vm, POLL_COST))) return false;
    *list = vs_cdr(*list);
  }
  return true;
}

static bool arg_list(vs_scheme *vm, const vs_value *a, int arg, int64_t *length) {
  *length = vs_list_length(a[arg]);
  return *length >= 0 || vs_fail_type(vm, arg, "a list", a[arg]);
}

/* Returns the last cdr of a list: () for a proper list, another value for a dotted list, VS_ABSENT for a circular
 * list. */
static vs_value last_cdr(vs_value list) {
  vs_value mark = list;                 /* Brent's cycle detection: one pointer advances, the other follows at powers of
                                         * two */
  for (uint64_t n = 0, jump = 2; vs_is_pair(list); n++) {
    list = vs_cdr(list);
    if (list == mark && vs_is_pair(list)) return VS_ABSENT;
    if (n == jump) { mark = list; jump *= 2; }
  }
  return list;
}

static bool arg_ends(vs_scheme *vm, const vs_value *a, int arg) {
  return last_cdr(a[arg]) != VS_ABSENT || vs_fail_type(vm, arg, "a list that ends", a[arg]);
}

/* Checks that a[arg] begins with at least n pairs. Sets *at to the cdr of the last of them. */
static bool arg_pairs(vs_scheme *vm, const vs_value *a, int arg, int64_t n, vs_value *at) {
  vs_value l = a[arg];
  for (int64_t i = 0; i < n; i++, l = vs_cdr(l)) {
    if (!vs_is_pair(l) && l != VS_NIL) return vs_fail_type(vm, arg, "a list", a[arg]);
    if (!vs_is_pair(l))
      return vs_fail(vm, vm->sym.range, "the list is too short: it has %lld elements, and needs %lld", (long long)i,
                     (long long)n);
    if (i % POLL_STEP == POLL_STEP - 1 && !vs_poll(vm, POLL_COST)) return false;
  }
  *at = l;
  return true;
}

/* ---- pairs ---- */

static vs_status list_cons(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_cons(vm, a[0], a[1], out);
}

static vs_status list_set_car(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  if (!vs_arg_type(vm, a, 0, VS_T_PAIR)) return VS_ERROR;
  if (vs_object_of(a[0])->flags & VS_F_IMMUTABLE)
    return vs_fail_type(vm, 0, "a pair that may change, not a literal", a[0]);
  vs_gc_store(vm, vs_object_of(a[0]), &vs_as_pair(a[0])->car, a[1]);
  return VS_OK;
}

static vs_status list_set_cdr(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  if (!vs_arg_type(vm, a, 0, VS_T_PAIR)) return VS_ERROR;
  if (vs_object_of(a[0])->flags & VS_F_IMMUTABLE)
    return vs_fail_type(vm, 0, "a pair that may change, not a literal", a[0]);
  vs_gc_store(vm, vs_object_of(a[0]), &vs_as_pair(a[0])->cdr, a[1]);
  return VS_OK;
}

/* Applies car and cdr as the letters between c and r in a procedure's name such as cadr say, from right to left. path:
 * the name; length: its length. */
static vs_status list_path(vs_scheme *vm, vs_value *a, const char *path, size_t length, vs_value *out) {
  vs_value v = a[0];
  for (size_t i = length; i-- > 0;) {
    if (!vs_is_pair(v)) {
      if (v == a[0]) return vs_fail_type(vm, 0, "a pair", v);
      size_t tails = strspn(path + 1, "d");        /* tails: number of d letters after the first letter. Errors of cddr,
                                                    * cadr, caddr and so on state how many elements the list needs */
      static const char *const lists[] = { "a list of two elements or more", "a list of three elements or more",
                                           "a list of four elements or more" };
      return vs_fail_type(vm, 0,
                          tails == length - 1 ? lists[length - 2]
                          : length - i == 2   ? "a pair whose part is a pair"
                                              : "a pair deep enough",
                          a[0]);
    }
    v = path[i] == 'a' ? vs_car(v) : vs_cdr(v);
  }
  *out = v;
  return VS_OK;
}

#define PATHS(P)                                                                                                       \
  P(a) P(d) P(aa) P(ad) P(da) P(dd) P(aaa) P(aad) P(ada) P(add) P(daa) P(dad) P(dda) P(ddd) P(aaaa) \
  P(aaad) P(aada) P(aadd) P(adaa) \
  P(adad) P(adda) P(addd) P(daaa) P(daad) P(dada) P(dadd) P(ddaa) P(ddad) P(ddda) P(dddd)
#define P(path)                                                                     \
  static vs_status list_c##path##r(vs_scheme *vm, vs_value *a, int n, vs_value *out) {     \
    (void)n;                                                                        \
    return list_path(vm, a, #path, sizeof #path - 1, out);                          \
  }
PATHS(P)
#undef P

static vs_status list_null_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(a[0] == VS_NIL);
  return VS_OK;
}

static vs_status list_pair_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_is_pair(a[0]));
  return VS_OK;
}

static vs_status list_list_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_list_length(a[0]) >= 0);
  return VS_OK;
}

/* ---- creating lists ---- */

static vs_status list_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  *out = VS_NIL;
  for (int i = n; i-- > 0;)
    if (!vs_cons(vm, a[i], *out, out)) return VS_ERROR;
  return VS_OK;
}

static vs_status list_cons_star(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  *out = a[n - 1];
  for (int i = n - 1; i-- > 0;)
    if (!vs_cons(vm, a[i], *out, out)) return VS_ERROR;
  return VS_OK;
}

static vs_status list_make_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t count;
  if (!vs_arg_index(vm, a, 0, 0, VS_FIXNUM_MAX, &count)) return VS_ERROR;
  *out = VS_NIL;
  for (int64_t i = 0; i < count; i++)
    if (!vs_cons(vm, n > 1 ? a[1] : VS_UNSPECIFIC, *out, out) ||
        (i % POLL_STEP == POLL_STEP - 1 && !vs_poll(vm, POLL_COST)))
      return VS_ERROR;
  return VS_OK;
}

/* Sets *out to a list of `count` numbers, from + i*step for i = 0, 1, .... Each number is computed from `from`, so that
 * rounding errors do not accumulate. */
static vs_status list_numbers(vs_scheme *vm, int64_t count, const vs_value *from, const vs_value *step, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  VS_ASSERT(count >= 0);
  *out = VS_NIL;
  for (int64_t i = count; i-- > 0;) {
    if (!vs_number_mul(vm, vs_fix(i), *step, &r[0]) || !vs_number_add(vm, *from, r[0], &r[0]) ||
        !vs_cons(vm, r[0], *out, out))
      return VS_ERROR;
    if (i % POLL_STEP == 0 && !vs_poll(vm, POLL_COST)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status list_iota(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t count;
  VS_ROOTS(vm, r, 2);
  if (!vs_arg_index(vm, a, 0, 0, VS_FIXNUM_MAX, &count)) return VS_ERROR;
  for (int i = 1; i < n; i++)
    if (!vs_is_number(a[i])) return vs_fail_type(vm, i, "a number", a[i]);
  r[0] = n > 1 ? a[1] : vs_fix(0);
  r[1] = n > 2 ? a[2] : vs_fix(1);
  return list_numbers(vm, count, &r[0], &r[1], out);
}

/* (range end), (range start end [step]): returns the list of numbers from start (0 by default) up to `end`, excluding
 * `end`. */
static vs_status list_range(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 4); /* roots of the garbage collector: start, end, step, temporary value */
  for (int i = 0; i < n; i++) {
    double d;
    if (!vs_is_number(a[i])) return vs_fail_type(vm, i, "a number", a[i]);
    if (!vs_number_double(vm, a[i], &d)) return VS_ERROR;
    if (d != d || d - d != 0) return vs_fail_type(vm, i, "a finite number", a[i]);
  }
  r[0] = n > 1 ? a[0] : vs_fix(0);
  r[1] = n > 1 ? a[1] : a[0];
  r[2] = n > 2 ? a[2] : vs_fix(1);
  bool zero, down, more;
  if (!vs_number_test(vm, VS_EQ, r[2], vs_fix(0), &zero) || !vs_number_test(vm, VS_LT, r[2], vs_fix(0), &down))
    return VS_ERROR;
  if (zero) return vs_fail_type(vm, 2, "a number other than 0", a[2]);
  double from, end, step;
  if (!vs_number_double(vm, r[0], &from) || !vs_number_double(vm, r[1], &end) || !vs_number_double(vm, r[2], &step))
    return VS_ERROR;
  double guess = (end - from) / step;
  int64_t count = guess > 0 ? guess < 1e15 ? (int64_t)guess : INT64_C(1000000000000000) : 0;
  if (count > 0) count--; /* the estimated count may be 1 too large; exact arithmetic determines the right one */
  for (;; count++) {
    if (!vs_number_mul(vm, vs_fix(count), r[2], &r[3]) || !vs_number_add(vm, r[0], r[3], &r[3]) ||
        !vs_number_test(vm, down ? VS_GT : VS_LT, r[3], r[1], &more))
      return VS_ERROR;
    if (!more) break;
  }
  return list_numbers(vm, count, &r[0], &r[2], out);
}

/* ---- lengths and selection ---- */

static vs_status list_length(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t length;
  if (!arg_list(vm, a, 0, &length)) return VS_ERROR;
  *out = vs_fix(length);
  return VS_OK;
}

static vs_status list_tail(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k;
  return vs_arg_index(vm, a, 1, 0, VS_FIXNUM_MAX, &k) && arg_pairs(vm, a, 0, k, out);
}

static vs_status list_ref(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k;
  vs_value l = a[0];
  if (!vs_arg_index(vm, a, 1, 0, VS_FIXNUM_MAX, &k)) return VS_ERROR;
  if (!vs_is_pair(l) && l != VS_NIL) return vs_fail_type(vm, 0, "a list", l);
  for (int64_t i = 0; i < k && vs_is_pair(l); i++, l = vs_cdr(l))
    if (i % POLL_STEP == POLL_STEP - 1 && !vs_poll(vm, POLL_COST)) return VS_ERROR;
  if (!vs_is_pair(l)) {
    int64_t length = vs_list_length(a[0]);
    if (length < 0) return vs_fail_type(vm, 0, "a list", a[0]);
    if (length == 0) return vs_fail_type(vm, 0, "a list with an element", a[0]);
    return vs_fail_range(vm, 1, a[1], 0, length - 1);
  }
  *out = vs_car(l);
  return VS_OK;
}

static vs_status list_set(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  int64_t k;
  vs_value l;
  if (!vs_arg_index(vm, a, 1, 0, VS_FIXNUM_MAX, &k) || !arg_pairs(vm, a, 0, k, &l)) return VS_ERROR;
  if (!vs_is_pair(l)) return vs_fail_range(vm, 1, a[1], 0, k - 1);
  if (vs_object_of(l)->flags & VS_F_IMMUTABLE)
    return vs_fail_type(vm, 0, "a list that may change, not a literal", a[0]);
  vs_gc_store(vm, vs_object_of(l), &vs_as_pair(l)->car, a[2]);
  return VS_OK;
}

static vs_status list_nth(vs_scheme *vm, vs_value *a, int64_t k, vs_value *out) {
  vs_value l = a[0];
  for (int64_t i = 0; i < k && vs_is_pair(l); i++) l = vs_cdr(l);
  if (!vs_is_pair(l)) {
    char expected[64] = "a list of ";
    static const char *const counts[] = { "one element",   "two elements", "three elements", "four elements",
                                          "five elements", "six elements", "seven elements", "eight elements",
                                          "nine elements", "ten elements" };
    strcat(strcat(expected, counts[k]), " or more");
    return vs_fail_type(vm, 0, expected, a[0]);
  }
  *out = vs_car(l);
  return VS_OK;
}

#define NTHS(N)                                                                                                        \
  N(0, first)                                                                                                          \
  N(1, second) N(2, third) N(3, fourth) N(4, fifth) N(5, sixth) N(6, seventh) N(7, eighth) N(8, ninth) N(9, tenth)
#define N(k, name)                                                             \
  static vs_status list_##name(vs_scheme *vm, vs_value *a, int n, vs_value *out) {    \
    (void)n;                                                                   \
    return list_nth(vm, a, k, out);                                            \
  }
NTHS(N)
#undef N

static vs_status list_rest(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_pair(a[0])) return vs_fail_type(vm, 0, "a list of one element or more", a[0]);
  *out = vs_cdr(a[0]);
  return VS_OK;
}

static vs_status list_last_pair(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_pair(a[0])) return vs_fail_type(vm, 0, "a list of one element or more", a[0]);
  if (!arg_ends(vm, a, 0)) return VS_ERROR;
  vs_value l = a[0];
  for (uint64_t i = 1; vs_is_pair(vs_cdr(l)); i++, l = vs_cdr(l))
    if (i % POLL_STEP == 0 && !vs_poll(vm, POLL_COST)) return VS_ERROR;
  *out = l;
  return VS_OK;
}

static vs_status list_last(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!list_last_pair(vm, a, n, out)) return VS_ERROR;
  *out = vs_car(*out);
  return VS_OK;
}

/* ---- copying lists ---- */

static vs_status list_append(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  LIST_MAKER(vm, r);
  for (int i = 0; i < n - 1; i++) {
    int64_t length;
    if (!arg_list(vm, a, i, &length) || !maker_copy(vm, r, &a[i], length)) return VS_ERROR;
  }
  maker_end(vm, r, n ? a[n - 1] : VS_NIL);
  *out = r[HEAD];
  return VS_OK;
}

/* Sets *out to the elements of the proper list a[0] in reverse order, followed by tail. */
static vs_status list_reverse_onto(vs_scheme *vm, vs_value *a, vs_value tail, vs_value *out) {
  int64_t length;
  return arg_list(vm, a, 0, &length) && vs_list_onto(vm, a, tail, out);
}

static vs_status list_reverse(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return list_reverse_onto(vm, a, VS_NIL, out);
}

static vs_status list_reverse_own(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_list_own_turned(vm, &a[0], a[1], out);
}

/* Returns #t if a[0] is a procedure and a[1] a proper list; map and for-each then use a fast path. */
static vs_status list_each_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_is_procedure(a[0]) && vs_list_length(a[1]) >= 0);
  return VS_OK;
}

/* Implements map for one list. Arguments: procedure list | results so far, in reverse order; number of continuations
 * that existed at the start. If there are enough registers, the instructions EACH and MORE replace the call
 * (run_loop.c). */
static vs_status list_map_each(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n >= 0) a[2] = VS_NIL, a[3] = vs_captures(vm);
  else if (!vs_cons(vm, *out, a[2], &a[2])) return VS_ERROR;
  if (!vs_is_pair(a[1])) return vs_list_own_turned(vm, &a[2], a[3], out);
  vs_value element = vs_car(a[1]);
  a[1] = vs_cdr(a[1]);
  return vs_call(vm, a[0], 1, &element);
}

/* Implements for-each for one list. Arguments: procedure list. */
static vs_status list_do_each(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  *out = VS_UNSPECIFIC;
  if (!vs_is_pair(a[1])) return VS_OK;
  vs_value element = vs_car(a[1]);
  a[1] = vs_cdr(a[1]);
  return vs_call(vm, a[0], 1, &element);
}

static vs_status list_append_reverse(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return list_reverse_onto(vm, a, a[1], out);
}

/* Copies a list. As in R7RS, a dotted list keeps its last cdr. */
static vs_status list_copy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  LIST_MAKER(vm, r);
  if (!arg_ends(vm, a, 0)) return VS_ERROR;
  for (uint64_t i = 1; vs_is_pair(a[0]); i++, a[0] = vs_cdr(a[0]))
    if (!maker_add(vm, r, vs_car(a[0])) || (i % POLL_STEP == 0 && !vs_poll(vm, POLL_COST))) return VS_ERROR;
  maker_end(vm, r, a[0]);
  *out = r[HEAD];
  return VS_OK;
}

static vs_status list_take(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k;
  vs_value rest;
  LIST_MAKER(vm, r);
  if (!vs_arg_index(vm, a, 1, 0, VS_FIXNUM_MAX, &k) || !arg_pairs(vm, a, 0, k, &rest) || !maker_copy(vm, r, &a[0], k))
    return VS_ERROR;
  *out = r[HEAD];
  return VS_OK;
}

/* Sets *pairs to the number of pairs of the list a[arg], which may be dotted. Reports a circular list. */
static bool arg_dotted(vs_scheme *vm, const vs_value *a, int arg, int64_t *pairs) {
  if (last_cdr(a[arg]) == VS_ABSENT) return vs_fail_type(vm, arg, "a list that ends", a[arg]);
  *pairs = 0;
  for (vs_value l = a[arg]; vs_is_pair(l); l = vs_cdr(l)) ++*pairs;
  return vs_poll(vm, (uint64_t)*pairs);
}

static vs_status list_take_right(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k, length;
  return arg_dotted(vm, a, 0, &length) && vs_arg_index(vm, a, 1, 0, length, &k) && arg_pairs(vm, a, 0, length - k, out);
}

static vs_status list_drop_right(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k, length;
  LIST_MAKER(vm, r);
  if (!arg_dotted(vm, a, 0, &length) || !vs_arg_index(vm, a, 1, 0, length, &k) || !maker_copy(vm, r, &a[0], length - k))
    return VS_ERROR;
  *out = r[HEAD];
  return VS_OK;
}

static vs_status list_split_at(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k;
  LIST_MAKER(vm, r);
  if (!vs_arg_index(vm, a, 1, 0, VS_FIXNUM_MAX, &k) || !arg_pairs(vm, a, 0, k, &r[NEW])) return VS_ERROR;
  if (!maker_copy(vm, r, &a[0], k)) return VS_ERROR;
  a[1] = a[0];
  a[0] = r[HEAD];
  return vs_several(vm, a, 2, out);
}

/* Returns the list of all elements of nested lists, in order; a value that is no list counts as one element. Each list
 * that is entered is compared with an earlier list, to detect a list that contains itself. */
static vs_status list_flatten(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  LIST_MAKER(vm, r);
  VS_ROOTS(vm, at, 3);      /* roots of the garbage collector: the remaining elements, the places to which to return,
                             * the list for the comparison */
  at[0] = a[0]; at[1] = VS_NIL; at[2] = VS_ABSENT;
  uint64_t depth = 0, mark = 0;
  if (!arg_ends(vm, a, 0)) return VS_ERROR;
  for (uint64_t i = 1;; i++) {
    if (i % POLL_STEP == 0 && !vs_poll(vm, POLL_COST)) return VS_ERROR;
    if (vs_is_pair(at[0])) {
      vs_value first = vs_car(at[0]);
      if (vs_is_pair(first) || first == VS_NIL) {
        if (last_cdr(first) == VS_ABSENT || (first == at[2] && depth >= mark))
          return vs_fail_type(vm, 0, "a list that does not contain itself", a[0]);
        if (!vs_cons(vm, vs_cdr(at[0]), at[1], &at[1])) return VS_ERROR;
        at[0] = vs_car(at[0]);
        if (++depth >= 2 * mark) { at[2] = at[0]; mark = depth; }
      } else {
        if (!maker_add(vm, r, first)) return VS_ERROR;
        at[0] = vs_cdr(at[0]);
      }
    } else {
      if (at[0] != VS_NIL && !maker_add(vm, r, at[0])) return VS_ERROR;
      if (at[1] == VS_NIL) break;
      at[0] = vs_car(at[1]);
      at[1] = vs_cdr(at[1]);
      if (--depth < mark) { at[2] = VS_ABSENT; mark = 0; }
    }
  }
  *out = r[HEAD];
  return VS_OK;
}

/* ---- searching in lists ---- */

typedef enum { BY_EQ, BY_EQV, BY_EQUAL } same_kind;

static bool list_same(vs_scheme *vm, same_kind kind, vs_value x, vs_value y, bool *same) {
  if (kind == BY_EQUAL) return vs_equal(vm, x, y, same);
  *same = kind == BY_EQ ? x == y : vs_eqv(x, y);
  return true;
}

/* Searches the list a[1] for the value a[0]. If `entries` is true, compares a[0] with the car of each element. The
 * elements of `a` are roots of the garbage collector, since vs_equal may move objects. */
static vs_status list_search(vs_scheme *vm, vs_value *a, same_kind kind, bool entries, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = a[1];
  uint64_t i = 1;
  for (; vs_is_pair(r[0]); i++, r[0] = vs_cdr(r[0])) {
    bool same;
    vs_value x = vs_car(r[0]);
    if (entries) {
      if (!vs_is_pair(x)) return vs_fail_type(vm, 1, "a list of pairs", a[1]);
      x = vs_car(x);
    }
    if (!list_same(vm, kind, a[0], x, &same) || (i % POLL_STEP == 0 && !vs_poll(vm, POLL_COST))) return VS_ERROR;
    if (same) {
      *out = entries ? vs_car(r[0]) : r[0];
      return VS_OK;
    }
    /* after a million elements, tests whether the list is circular */
    if (i == (uint64_t)1 << 20 && vs_list_length(a[1]) < 0) return vs_fail_type(vm, 1, "a list that ends", a[1]);
  }
  if (r[0] != VS_NIL) return vs_fail_type(vm, 1, "a list", a[1]);
  *out = VS_FALSE;
  return VS_OK;
}

#define SEARCH(name, kind, entries)                                            \
  static vs_status list_##name(vs_scheme *vm, vs_value *a, int n, vs_value *out) {    \
    (void)n;                                                                   \
    return list_search(vm, a, kind, entries, out);                             \
  }
SEARCH(memq, BY_EQ, false) SEARCH(memv, BY_EQV, false) SEARCH(member, BY_EQUAL, false)
SEARCH(assq, BY_EQ, true) SEARCH(assv, BY_EQV, true) SEARCH(assoc, BY_EQUAL, true)
#undef SEARCH

/* ---- checks for list procedures that are written in Scheme; errors show the name `who` ---- */

static vs_status fail_list(vs_scheme *vm, vs_value who, vs_value list) {
  VS_ROOTS(vm, r, 1);
  bool circular = last_cdr(list) == VS_ABSENT;
  vm->native = NULL;
  if (!vs_cons(vm, list, VS_NIL, &r[0])) return VS_ERROR;
  if (vs_is_fixnum(list) && vs_fixnum(list) > 0)
    return vs_fail_with(vm, vm->sym.type, r[0], "%s: expected a list, as (iota %lld) is of the numbers from 0, got",
                        vs_as_symbol(who)->name, (long long)vs_fixnum(list));
  return vs_fail_with(vm, vm->sym.type, r[0],
                      circular ? "%s: expected a list that ends, got" : "%s: expected a list, got",
                      vs_as_symbol(who)->name);
}

/* (%need-list who v): checks that v is a proper list. */
static vs_status need_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  int64_t length = vs_list_length(a[1]);
  return length < 0 ? fail_list(vm, a[0], a[1]) : vs_poll(vm, (uint64_t)length);
}

/* (%need-lists who lists): checks the list arguments of a procedure such as map. There must be at least one; all must
 * be lists, and at least one must be proper. */
static vs_status need_lists(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  if (a[1] == VS_NIL) {
    vm->native = NULL;
    return vs_fail(vm, vm->sym.arity, "%s: a list is missing", vs_as_symbol(a[0])->name);
  }
  vs_value bad = VS_ABSENT;
  bool ends = false;
  for (vs_value l = a[1]; vs_is_pair(l); l = vs_cdr(l)) {
    vs_value list = vs_car(l);
    if (!vs_is_pair(list) && list != VS_NIL) return fail_list(vm, a[0], list);
    if (!ends && vs_list_length(list) >= 0) ends = true;
    else if (!ends && bad == VS_ABSENT) bad = list;
  }
  return ends || fail_list(vm, a[0], bad);
}

/* (%need-end who lists): checks that at least one of the lists is not circular. Called repeatedly during a search,
 * which may find its element in a circular list. */
static vs_status need_end(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  for (vs_value l = a[1]; vs_is_pair(l); l = vs_cdr(l))
    if (vs_list_length(vs_car(l)) >= 0 || !vs_is_pair(vs_car(l))) return VS_OK;
  return fail_list(vm, a[0], vs_car(a[1]));
}

static const vs_native_def defs[] = {
  { "%need-list", "who list", need_list, 0, NULL },
  { "%need-lists", "who lists", need_lists, 0, NULL },
  { "%need-turn", "who lists", need_end, 0, NULL },
  { "cons", "a b", list_cons, 0, "a new pair" },
  { "set-car!", "pair value", list_set_car, 0, NULL },
  { "set-cdr!", "pair value", list_set_cdr, 0, NULL },
#define P(path) { "c" #path "r", "pair", list_c##path##r, 0, NULL },
  PATHS(P)
#undef P
  { "null? empty? null-list?", "x", list_null_p, 0, "is x the empty list?" },
  { "pair? cons?", "x", list_pair_p, 0, NULL },
  { "list?", "x", list_list_p, 0, "is x a proper list?" },
  { "list", ". elements", list_list, 0, "a new list of the arguments" },
  { "cons* list*", "first . more", list_cons_star, 0, "a list of the arguments, the last being its tail" },
  { "make-list", "n [fill]", list_make_list, 0, NULL },
  { "iota", "n [start step]", list_iota, 0, "n numbers from start (0) by step (1)" },
  { "range", "a [b step]", list_range, 0, "the numbers from a up to b, without b; (range b) starts at 0" },
  { "length", "list", list_length, 0, "how many elements list has" },
  { "append append!", ". lists", list_append, 0, "the elements of all lists in one" },
  { "reverse reverse!", "list", list_reverse, 0, "the elements in the other order" },
  { "%reverse-own", "list captures", list_reverse_own, 0, NULL },
  { "%each?", "procedure list", list_each_p, 0, NULL },
  { "%map-each", "procedure list", list_map_each, 2, NULL },
  { "%do-each", "procedure list", list_do_each, 1, NULL },
  { "append-reverse append-reverse!", "list tail", list_append_reverse, 0, "(append (reverse list) tail)" },
  { "list-copy", "list", list_copy, 0, NULL },
  { "list-tail drop", "list k", list_tail, 0, "list without its first k elements" },
  { "list-head take take!", "list k", list_take, 0, "the first k elements" },
  { "take-right", "list k", list_take_right, 0, "the last k elements" },
  { "drop-right drop-right!", "list k", list_drop_right, 0, "list without its last k elements" },
  { "split-at split-at!", "list k", list_split_at, 0, "two values: (take list k) (drop list k)" },
  { "list-ref", "list index", list_ref, 0, "the element at index, counted from 0" },
  { "list-set!", "list index value", list_set, 0, NULL },
#define N(k, name) { #name, "list", list_##name, 0, NULL },
  NTHS(N)
#undef N
  { "rest", "list", list_rest, 0, "list without its first element" },
  { "last-pair", "list", list_last_pair, 0, NULL },
  { "last", "list", list_last, 0, "the last element" },
  { "flatten", "list", list_flatten, 0, "all elements of lists within lists" },
  { "memq", "x list", list_memq, 0, NULL },
  { "memv", "x list", list_memv, 0, NULL },
  { "%member", "x list", list_member, 0, NULL },
  { "assq", "key alist", list_assq, 0, NULL },
  { "assv", "key alist", list_assv, 0, NULL },
  { "%assoc", "key alist", list_assoc, 0, NULL },
  { NULL, NULL, NULL, 0, NULL }
};
const vs_native_table vs_list_natives = { "list", defs };
