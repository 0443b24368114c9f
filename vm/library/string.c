/* Implements the procedures of strings and symbols that have no procedure arguments.
 *
 * The characters of a string are in a BYTES object, the store. A character takes one byte if all characters of the
 * string are below U+0100, otherwise four bytes (vm/values/string_chars.h). string-ref therefore takes constant time,
 * and string-set! may once convert the store. Procedures that build text with characters of unknown width use a vs_text
 * (UTF-8), and convert it to a string at the end. If the length is known, they write into the string. Case and
 * categories of characters are those of utf8proc. */
#include "vm/library/string.h"

#include "vm/machine/fail.h"
#include "vm/machine/poll.h"
#include "vm/values/heap.h"
#include "vm/values/string_chars.h"

#include <utf8proc.h>

#include "vm/library/text_order.h"
#include "vm/library/range.h"
#include "vm/values/text.h"

static const int64_t LONGEST = INT64_C(1) << 30;

static bool arg_string(vs_scheme *vm, const vs_value *a, int arg) { return vs_arg_type(vm, a, arg, VS_T_STRING); }
static bool arg_symbol(vs_scheme *vm, const vs_value *a, int arg) { return vs_arg_type(vm, a, arg, VS_T_SYMBOL); }
static bool arg_mutable(vs_scheme *vm, const vs_value *a, int arg) {
  return arg_string(vm, a, arg) && (!(vs_object_of(a[arg])->flags & VS_F_IMMUTABLE) ||
                                    vs_fail_type(vm, arg, "a string that may change, not a literal", a[arg]));
}
static int64_t length_of(vs_value s) { return vs_as_string(s)->length; }

/* Returns the greatest code point of the characters from start to end - 1, or 0 if there are none. For a string of
 * one-byte characters, returns 0xFF without reading them. */
static uint32_t widest_of(vs_value s, size_t start, size_t end) {
  uint32_t widest = 0;
  VS_ASSERT(start <= end && end <= vs_as_string(s)->length);
  if (!(vs_object_of(s)->flags & VS_F_WIDE)) return 0xFF;
  for (size_t i = start; i < end; i++) {
    uint32_t c = vs_string_at(s, i);
    if (c > widest) widest = c;
  }
  return widest;
}

/* ---- functions for the other files of vm/ ---- */

bool vs_string_set(vs_scheme *vm, vs_value *s, size_t k, uint32_t c) {
  VS_ASSERT(k < vs_as_string(*s)->length);
  if (c > 0xFF && !(vs_object_of(*s)->flags & VS_F_WIDE)) {
    VS_ROOTS(vm, r, 1);
    size_t length = vs_as_string(*s)->length;
    if (!vs_make_string(vm, length, 0x100, &r[0])) return false;
    for (size_t i = 0; i < length; i++) {
      vs_string_put(r[0], i, vs_string_at(*s, i));
      if (!vs_poll_turn(vm, i, 1)) return false;
    }
    vs_gc_store(vm, vs_object_of(*s), &vs_as_string(*s)->store, vs_as_string(r[0])->store);
    vs_object_of(*s)->flags |= VS_F_WIDE;
  }
  vs_string_put(*s, k, c);
  return true;
}

bool vs_string_slice(vs_scheme *vm, const vs_value *s, size_t start, size_t end, vs_value *out) {
  uint32_t widest = widest_of(*s, start, end);
  VS_ROOTS(vm, r, 1);
  VS_ASSERT(start <= end && end <= vs_as_string(*s)->length);
  if (!vs_make_string(vm, end - start, widest > 0xFF ? widest : 0, &r[0])) return false;
  if (!(vs_object_of(*s)->flags & VS_F_WIDE)) {
    if (!vs_poll_move(vm, vs_as_bytes(vs_as_string(r[0])->store)->at, vs_as_bytes(vs_as_string(*s)->store)->at + start,
                      end - start))
      return false;
  } else {
    for (size_t i = start; i < end; i++) {
      vs_string_put(r[0], i - start, vs_string_at(*s, i));
      if (!vs_poll_turn(vm, i, 1)) return false;
    }
  }
  *out = r[0];
  return true;
}

int vs_string_compare(vs_value a, vs_value b) {
  size_t n = vs_as_string(a)->length, m = vs_as_string(b)->length;
  /* Each character of both strings is one byte, so memcmp compares the strings by code points. */
  if (!((vs_object_of(a)->flags | vs_object_of(b)->flags) & VS_F_WIDE)) {
    int order = memcmp(vs_as_bytes(vs_as_string(a)->store)->at, vs_as_bytes(vs_as_string(b)->store)->at, n < m ? n : m);
    return order ? (order < 0 ? -1 : 1) : n < m ? -1 : n > m;
  }
  for (size_t i = 0; i < n && i < m; i++) {
    uint32_t x = vs_string_at(a, i), y = vs_string_at(b, i);
    if (x != y) return x < y ? -1 : 1;
  }
  return n < m ? -1 : n > m;
}

/* ---- construction and parts ---- */

static vs_status string_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_is_string(a[0]));
  return VS_OK;
}

static vs_status string_make(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t count;
  if (!vs_arg_index(vm, a, 0, 0, LONGEST, &count)) return VS_ERROR;
  if (n > 1 && !vs_is_char(a[1])) return vs_fail_type(vm, 1, "a character", a[1]);
  return vs_make_string(vm, (size_t)count, n > 1 ? vs_char(a[1]) : ' ', out);
}

/* (string #\a #\b): returns a string of these characters. */
static vs_status string_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  uint32_t widest = 0;
  for (int i = 0; i < n; i++) {
    if (!vs_is_char(a[i])) return vs_fail_type(vm, i, "a character", a[i]);
    if (vs_char(a[i]) > widest) widest = vs_char(a[i]);
  }
  if (!vs_make_string(vm, (size_t)n, widest > 0xFF ? widest : 0, out)) return VS_ERROR;
  for (int i = 0; i < n; i++) vs_string_put(*out, (size_t)i, vs_char(a[i]));
  return VS_OK;
}

static vs_status string_length(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  *out = vs_fix(length_of(a[0]));
  return VS_OK;
}

static bool string_index(vs_scheme *vm, const vs_value *a, int64_t *k) {
  if (length_of(a[0]) == 0) return vs_fail(vm, vm->sym.range, "the string is empty");
  return vs_arg_index(vm, a, 1, 0, length_of(a[0]) - 1, k);
}

static vs_status string_ref(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t k;
  if (!arg_string(vm, a, 0) || !string_index(vm, a, &k)) return VS_ERROR;
  *out = VS_CHAR(vs_string_at(a[0], (size_t)k));
  return VS_OK;
}

static vs_status string_set(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n, (void)out;
  int64_t k;
  if (!arg_mutable(vm, a, 0) || !string_index(vm, a, &k)) return VS_ERROR;
  if (!vs_is_char(a[2])) return vs_fail_type(vm, 2, "a character", a[2]);
  return vs_string_set(vm, &a[0], (size_t)k, vs_char(a[2]));
}

static vs_status string_copy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  return arg_string(vm, a, 0) && vs_arg_range(vm, a, n, 1, length_of(a[0]), &start, &end) &&
         vs_string_slice(vm, &a[0], (size_t)start, (size_t)end, out);
}

static vs_status string_copy_to(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  int64_t at, start, end;
  if (!arg_mutable(vm, a, 0) || !arg_string(vm, a, 2) || !vs_arg_range(vm, a, n, 3, length_of(a[2]), &start, &end) ||
      !vs_arg_index(vm, a, 1, 0, length_of(a[0]), &at))
    return VS_ERROR;
  if (end - start > length_of(a[0]) - at)
    return vs_fail(vm, vm->sym.range, "%lld characters do not fit behind index %lld of a string of %lld",
                   (long long)(end - start), (long long)at, (long long)length_of(a[0]));
  int64_t count = end - start;
  bool backwards = a[0] == a[2] && at > start;
  for (int64_t k = 0; k < count; k++) {
    int64_t i = backwards ? count - 1 - k : k;
    if (!vs_string_set(vm, &a[0], (size_t)(at + i), vs_string_at(a[2], (size_t)(start + i))) ||
        !vs_poll_turn(vm, (uint64_t)k, 1))
      return VS_ERROR;
  }
  return VS_OK;
}

static vs_status string_fill(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  int64_t start, end;
  if (!arg_mutable(vm, a, 0) || !vs_arg_range(vm, a, n, 2, length_of(a[0]), &start, &end)) return VS_ERROR;
  if (!vs_is_char(a[1])) return vs_fail_type(vm, 1, "a character", a[1]);
  for (int64_t i = start; i < end; i++)
    if (!vs_string_set(vm, &a[0], (size_t)i, vs_char(a[1])) || !vs_poll_turn(vm, (uint64_t)i, 1)) return VS_ERROR;
  return VS_OK;
}

static vs_status string_append(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t total = 0;
  uint32_t widest = 0;
  for (int i = 0; i < n; i++) {
    if (!arg_string(vm, a, i)) return VS_ERROR;
    total += length_of(a[i]);
    if (vs_object_of(a[i])->flags & VS_F_WIDE) widest = 0x100;
  }
  if (total > LONGEST) return vs_fail_memory(vm);
  if (!vs_make_string(vm, (size_t)total, widest, out)) return VS_ERROR;
  size_t at = 0;
  for (int i = 0; i < n; i++) {
    size_t length = (size_t)length_of(a[i]);
    if (!widest) {
      if (!vs_poll_move(vm, vs_as_bytes(vs_as_string(*out)->store)->at + at, vs_as_bytes(vs_as_string(a[i])->store)->at,
                        length))
        return VS_ERROR;
    } else {
      for (size_t k = 0; k < length; k++) {
        vs_string_put(*out, at + k, vs_string_at(a[i], k));
        if (!vs_poll_turn(vm, k, 1)) return VS_ERROR;
      }
    }
    at += length;
    if (!vs_poll(vm, length / 8)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status string_to_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start, end;
  if (!arg_string(vm, a, 0) || !vs_arg_range(vm, a, n, 1, length_of(a[0]), &start, &end)) return VS_ERROR;
  *out = VS_NIL;
  for (int64_t i = end; i-- > start;)
    if (!vs_cons(vm, VS_CHAR(vs_string_at(a[0], (size_t)i)), *out, out) || !vs_poll_turn(vm, (uint64_t)i, 4))
      return VS_ERROR;
  return VS_OK;
}

static vs_status list_to_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t length = vs_list_length(a[0]), i = 0;
  uint32_t widest = 0;
  if (length < 0) return vs_fail_type(vm, 0, "a list of characters", a[0]);
  for (vs_value l = a[0]; vs_is_pair(l); l = vs_cdr(l)) {
    if (!vs_is_char(vs_car(l))) return vs_fail_type(vm, 0, "a list of characters", a[0]);
    if (vs_char(vs_car(l)) > widest) widest = vs_char(vs_car(l));
    if (!vs_poll_turn(vm, (uint64_t)i++, 2)) return VS_ERROR;
  }
  i = 0;
  if (!vs_make_string(vm, (size_t)length, widest > 0xFF ? widest : 0, out)) return VS_ERROR;
  for (vs_value l = a[0]; i < length; l = vs_cdr(l), i++) {
    vs_string_put(*out, (size_t)i, vs_char(vs_car(l)));
    if (!vs_poll_turn(vm, (uint64_t)i, 2)) return VS_ERROR;
  }
  return VS_OK;
}

static vs_status string_reverse(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  size_t length = (size_t)length_of(a[0]);
  if (!vs_string_slice(vm, &a[0], 0, length, out)) return VS_ERROR;
  for (size_t i = 0; i < length; i++) {
    vs_string_put(*out, i, vs_string_at(a[0], length - 1 - i));
    if (!vs_poll_turn(vm, i, 1)) return VS_ERROR;
  }
  return VS_OK;
}

/* ---- comparison ---- */

/* Replaces *s by its full case folding: ß becomes ss. */
static bool string_fold(vs_scheme *vm, vs_value *s) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = true;
  for (size_t i = 0; ok && i < (size_t)length_of(*s) && (ok = vs_poll_turn(vm, i, 16)); i++) {
    utf8proc_int32_t folded[8];
    utf8proc_ssize_t m =
        utf8proc_decompose_char((utf8proc_int32_t)vs_string_at(*s, i), folded, 8, UTF8PROC_CASEFOLD, NULL);
    if (m <= 0 || m > 8) ok = vs_text_char(&t, vs_string_at(*s, i));
    else
      for (utf8proc_ssize_t k = 0; ok && k < m; k++) ok = vs_text_char(&t, (uint32_t)folded[k]);
  }
  ok = ok && vs_text_to_string(&t, s);
  vs_text_close(&t);
  return ok;
}

static vs_status string_compare(vs_scheme *vm, vs_value *a, int n, vs_text_order order, bool fold, vs_value *out) {
  bool holds = true;
  for (int i = 0; i < n; i++)
    if (!arg_string(vm, a, i)) return VS_ERROR;
  for (int i = 0; fold && i < n; i++)
    if (!string_fold(vm, &a[i])) return VS_ERROR;
  for (int i = 0; holds && i + 1 < n; i++) {
    holds = vs_order_holds(order, vs_string_compare(a[i], a[i + 1]));
  }
  *out = vs_bool(holds);
  return VS_OK;
}

#define O(name, order, fold)                                                                                           \
  static vs_status string_##name(vs_scheme *vm, vs_value *a, int n, vs_value *out) {                                   \
    return string_compare(vm, a, n, order, fold, out);                                                                 \
  }
VS_ORDERS(O)
#undef O

/* ---- upper and lower case ---- */

/* is_cased and is_case_ignorable test Unicode's properties Cased and Case_Ignorable, which define the end of a word. A
 * case-ignorable character (a mark, an apostrophe, a full stop) after a letter does not end the word. */
static bool is_cased(uint32_t c) {
  utf8proc_category_t k = utf8proc_category((utf8proc_int32_t)c);
  return k >= UTF8PROC_CATEGORY_LU && k <= UTF8PROC_CATEGORY_LT;
}

static bool is_case_ignorable(uint32_t c) {
  static const uint16_t between[] = { 0x27,   0x2E,   0x3A,   0xB7,   0x387,  0x5F4,  0x2018, 0x2019,
                                      0x2024, 0x2027, 0xFE13, 0xFE52, 0xFE55, 0xFF07, 0xFF0E, 0xFF1A };
  for (size_t i = 0; i < sizeof between / sizeof *between; i++)
    if (c == between[i]) return true;
  utf8proc_category_t k = utf8proc_category((utf8proc_int32_t)c);
  return k == UTF8PROC_CATEGORY_MN || k == UTF8PROC_CATEGORY_ME || k == UTF8PROC_CATEGORY_CF ||
         k == UTF8PROC_CATEGORY_LM || k == UTF8PROC_CATEGORY_SK;
}

/* Returns true if character i, a Greek sigma, is the last letter of a word of two or more letters (Unicode's
 * Final_Sigma). */
static bool ends_word(vs_value s, size_t i) {
  size_t before = i, after = i + 1, length = (size_t)length_of(s);
  VS_ASSERT(i < length);
  while (before > 0 && is_case_ignorable(vs_string_at(s, before - 1))) before--;
  while (after < length && is_case_ignorable(vs_string_at(s, after))) after++;
  return before > 0 && is_cased(vs_string_at(s, before - 1)) && !(after < length && is_cased(vs_string_at(s, after)));
}

/* Appends the upper case of a character to t. If the case folding of a small letter has several characters, as that
 * of ß has, appends the upper case of these characters. */
static bool put_capitals(vs_text *t, uint32_t c) {
  utf8proc_int32_t folded[8];
  utf8proc_ssize_t m = c < 0x80 || utf8proc_category((utf8proc_int32_t)c) == UTF8PROC_CATEGORY_LU
                           ? 1 : utf8proc_decompose_char((utf8proc_int32_t)c, folded, 8, UTF8PROC_CASEFOLD, NULL);
  if (m < 2 || m > 8) return vs_text_char(t, (uint32_t)utf8proc_toupper((utf8proc_int32_t)c));
  bool ok = true;
  for (utf8proc_ssize_t k = 0; ok && k < m; k++) ok = vs_text_char(t, (uint32_t)utf8proc_toupper(folded[k]));
  return ok;
}

static vs_status string_upcase(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = true;
  for (size_t i = 0; ok && i < (size_t)length_of(a[0]) && (ok = vs_poll_turn(vm, i, 8)); i++) {
    ok = put_capitals(&t, vs_string_at(a[0], i));
  }
  ok = ok && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

/* Converts to lower case by Unicode's SpecialCasing: a sigma at the end of a word becomes the final sigma. The capital
 * I with a dot becomes i with a combining dot above. */
static vs_status string_downcase(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = true;
  size_t length = (size_t)length_of(a[0]);
  for (size_t i = 0; ok && i < length && (ok = vs_poll_turn(vm, i, 8)); i++) {
    uint32_t c = vs_string_at(a[0], i);
    ok = vs_text_char(&t, c == 0x3A3 && ends_word(a[0], i) ? 0x3C2 : (uint32_t)utf8proc_tolower((utf8proc_int32_t)c)) &&
         (c != 0x130 || vs_text_char(&t, 0x307));
  }
  ok = ok && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

static vs_status string_foldcase(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0) || !string_fold(vm, &a[0])) return VS_ERROR;
  *out = a[0];
  return VS_OK;
}

/* ---- searching in strings ---- */

/* Data for searching a text. border[i]: length of the longest proper prefix of the text's first i + 1 characters that
 * is also their suffix (Knuth, Morris and Pratt). `border` is NULL for a text of one character. */
typedef struct { uint32_t *border; int64_t length; } needle;

static bool needle_open(vs_scheme *vm, vs_value text, needle *d) {
  *d = (needle){ NULL, length_of(text) };
  if (d->length < 2) return true;
  if (!(d->border = vs_mem(vm, NULL, 0, (size_t)d->length * sizeof *d->border))) return vs_fail_memory(vm);
  d->border[0] = 0;
  uint32_t k = 0;
  for (size_t i = 1; i < (size_t)d->length; i++) {
    uint32_t c = vs_string_at(text, i);
    while (k && vs_string_at(text, k) != c) k = d->border[k - 1];
    if (vs_string_at(text, k) == c) k++;
    d->border[i] = k;
    if (!vs_poll_turn(vm, i, 2)) return false;
  }
  return true;
}

static void needle_close(vs_scheme *vm, needle *d) {
  if (d->border) vs_mem(vm, d->border, (size_t)d->length * sizeof *d->border, 0);
  d->border = NULL;
}

/* Sets *at to the first position, not before `from`, at which the string s contains the text. Sets *at to -1 if there
 * is none. */
static bool find_from(vs_scheme *vm, vs_value s, vs_value text, const needle *d, int64_t from, int64_t *at) {
  int64_t n = length_of(s), k = 0;
  VS_ASSERT(from >= 0);
  *at = d->length == 0 && from <= n ? from : -1;
  if (d->length == 0) return true;
  for (int64_t i = from; i < n; i++) {
    uint32_t c = vs_string_at(s, (size_t)i);
    while (k && vs_string_at(text, (size_t)k) != c) k = d->border[k - 1];
    if (vs_string_at(text, (size_t)k) == c && ++k == d->length) return *at = i + 1 - k, true;
    if (!vs_poll_turn(vm, (uint64_t)i, 1)) return false;
  }
  return true;
}

/* Searches for a text in s from position `from`, as find_from does, with a search table that it creates and frees. */
static bool find_once(vs_scheme *vm, vs_value s, vs_value text, int64_t from, int64_t *at) {
  needle d;
  bool ok = needle_open(vm, text, &d) && find_from(vm, s, text, &d, from, at);
  needle_close(vm, &d);
  return ok;
}

static vs_status string_search(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t start = 0, at;
  if (!arg_string(vm, a, 0) || !arg_string(vm, a, 1) ||
      (n > 2 && !vs_arg_index(vm, a, 2, 0, length_of(a[0]), &start)) || !find_once(vm, a[0], a[1], start, &at))
    return VS_ERROR;
  *out = at < 0 ? VS_FALSE : vs_fix(at);
  return VS_OK;
}

static vs_status string_contains_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t at;
  if (!arg_string(vm, a, 0) || !arg_string(vm, a, 1) || !find_once(vm, a[0], a[1], 0, &at)) return VS_ERROR;
  *out = vs_bool(at >= 0);
  return VS_OK;
}

static vs_status string_prefix_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0) || !arg_string(vm, a, 1)) return VS_ERROR;
  int64_t m = length_of(a[1]), k = 0;
  while (k < m && k < length_of(a[0]) && vs_string_at(a[0], (size_t)k) == vs_string_at(a[1], (size_t)k)) k++;
  *out = vs_bool(k == m);
  return VS_OK;
}

static vs_status string_suffix_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0) || !arg_string(vm, a, 1)) return VS_ERROR;
  int64_t length = length_of(a[0]), m = length_of(a[1]), k = 0;
  while (k < m && k < length && vs_string_at(a[0], (size_t)(length - 1 - k)) == vs_string_at(a[1], (size_t)(m - 1 - k)))
    k++;
  *out = vs_bool(k == m);
  return VS_OK;
}

/* ---- joining, splitting, trimming ---- */

static vs_status string_join(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (vs_list_length(a[0]) < 0) return vs_fail_type(vm, 0, "a list of strings", a[0]);
  if (n > 1 && !arg_string(vm, a, 1)) return VS_ERROR;
  vs_text t;
  VS_ROOTS(vm, r, 1); /* a root of the garbage collector: the strings not yet joined, which vs_poll may move */
  vs_text_open(vm, &t, 0);
  bool ok = true, first = true;
  for (r[0] = a[0]; ok && vs_is_pair(r[0]); r[0] = vs_cdr(r[0]), first = false) {
    ok = vs_is_string(vs_car(r[0])) || vs_fail_type(vm, 0, "a list of strings", a[0]);
    if (ok && !first) ok = n > 1 ? vs_text_string(&t, a[1]) : vs_text_puts(&t, " ");
    ok = ok && vs_text_string(&t, vs_car(r[0])) && vs_poll(vm, 16);
  }
  ok = ok && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

static bool is_space(uint32_t c) {
  return (c >= 9 && c <= 13) || c == ' ' || c == 0x85 || c == 0xA0 ||
         (c > 0xFF && utf8proc_category((utf8proc_int32_t)c) == UTF8PROC_CATEGORY_ZS);
}

/* Splits a string at each occurrence of the separator. Without a separator, splits at sequences of blanks, and ignores
 * blanks at both ends. */
static vs_status string_split(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  VS_ROOTS(vm, r, 3); /* roots of the garbage collector: first pair, last pair, the piece */
  r[0] = r[1] = VS_NIL;
  int64_t length = length_of(a[0]), start = 0;
  bool blanks = n < 2;
  if (!blanks) {
    if (vs_is_char(a[1])) {
      if (!vs_make_string(vm, 1, vs_char(a[1]), &a[1])) return VS_ERROR;
    } else if (!vs_is_string(a[1])) return vs_fail_type(vm, 1, "a string or a character", a[1]);
    if (length_of(a[1]) == 0) return vs_fail_type(vm, 1, "a string of one character or more", a[1]);
  }
  needle d = { NULL, 0 };
  bool ok = blanks || needle_open(vm, a[1], &d);
  while (ok && start <= length) {
    int64_t end, next;
    if (blanks) {
      while (ok && start < length && is_space(vs_string_at(a[0], (size_t)start)))
        ok = vs_poll_turn(vm, (uint64_t)start++, 1);
      if (start >= length) break;
      for (end = start; ok && end < length && !is_space(vs_string_at(a[0], (size_t)end));)
        ok = vs_poll_turn(vm, (uint64_t)end++, 1);
      next = end;
    } else {
      ok = find_from(vm, a[0], a[1], &d, start, &end);
      if (!ok) break;
      next = end < 0 ? length + 1 : end + length_of(a[1]);
      if (end < 0) end = length;
    }
    ok = ok && vs_string_slice(vm, &a[0], (size_t)start, (size_t)end, &r[2]) && vs_cons(vm, r[2], VS_NIL, &r[2]) &&
         vs_poll(vm, 16);
    if (!ok) break;
    if (r[0] == VS_NIL) r[0] = r[2];
    else vs_gc_store(vm, vs_object_of(r[1]), &vs_as_pair(r[1])->cdr, r[2]);
    r[1] = r[2];
    start = next;
  }
  needle_close(vm, &d);
  *out = r[0];
  return ok;
}

static vs_status string_trimmed(vs_scheme *vm, vs_value *a, bool left, bool right, vs_value *out) {
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  size_t start = 0, end = (size_t)length_of(a[0]);
  while (left && start < end && is_space(vs_string_at(a[0], start))) start++;
  while (right && end > start && is_space(vs_string_at(a[0], end - 1))) end--;
  return vs_string_slice(vm, &a[0], start, end, out);
}
static vs_status string_trim(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return string_trimmed(vm, a, true, true, out);
}
static vs_status string_trim_left(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return string_trimmed(vm, a, true, false, out);
}
static vs_status string_trim_right(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return string_trimmed(vm, a, false, true, out);
}

/* Pads a string to exactly `width` characters, as in SRFI 13. A longer string loses characters on the side on which a
 * shorter one is padded. */
static vs_status string_padded(vs_scheme *vm, vs_value *a, int n, bool left, vs_value *out) {
  int64_t width;
  if (!arg_string(vm, a, 0) || !vs_arg_index(vm, a, 1, 0, LONGEST, &width)) return VS_ERROR;
  if (n > 2 && !vs_is_char(a[2])) return vs_fail_type(vm, 2, "a character", a[2]);
  int64_t length = length_of(a[0]);
  uint32_t fill = n > 2 ? vs_char(a[2]) : ' ';
  if (length >= width)
    return vs_string_slice(vm, &a[0], (size_t)(left ? length - width : 0), (size_t)(left ? length : width), out);
  uint32_t widest = widest_of(a[0], 0, (size_t)length);
  if (fill > widest) widest = fill;
  VS_ROOTS(vm, r, 1);
  if (!vs_make_string(vm, (size_t)width, widest > 0xFF ? widest : 0, &r[0])) return VS_ERROR;
  int64_t at = left ? width - length : 0;
  for (int64_t i = 0; i < width; i++) {
    vs_string_put(r[0], (size_t)i, i >= at && i < at + length ? vs_string_at(a[0], (size_t)(i - at)) : fill);
    if (!vs_poll_turn(vm, (uint64_t)i, 1)) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}
static vs_status string_pad_left(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return string_padded(vm, a, n, true, out);
}
static vs_status string_pad_right(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return string_padded(vm, a, n, false, out);
}

/* Replaces every occurrence of `from` in the string by `to`. */
static vs_status string_replace(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  for (int i = 0; i < 3; i++)
    if (!arg_string(vm, a, i)) return VS_ERROR;
  if (length_of(a[1]) == 0) return vs_fail_type(vm, 1, "a string of one character or more", a[1]);
  vs_text t;
  vs_text_open(vm, &t, 0);
  needle d;
  bool ok = needle_open(vm, a[1], &d);
  int64_t length = length_of(a[0]), start = 0, at;
  while (ok && start < length && (ok = find_from(vm, a[0], a[1], &d, start, &at))) {
    int64_t end = at < 0 ? length : at;
    for (; ok && start < end; start++)
      ok = vs_text_char(&t, vs_string_at(a[0], (size_t)start)) && vs_poll_turn(vm, (uint64_t)start, 4);
    if (at >= 0) ok = ok && vs_text_string(&t, a[2]);
    if (at >= 0) start = at + length_of(a[1]);
    ok = ok && vs_poll(vm, 1);
  }
  needle_close(vm, &d);
  ok = ok && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

static vs_status string_null_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  *out = vs_bool(length_of(a[0]) == 0);
  return VS_OK;
}

/* ---- symbols ---- */

static vs_status symbol_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_is_symbol(a[0]));
  return VS_OK;
}

static vs_status symbol_equal_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  bool same = true;
  for (int i = 0; i < n; i++) {
    if (!arg_symbol(vm, a, i)) return VS_ERROR;
    same = same && a[i] == a[0];
  }
  *out = vs_bool(same);
  return VS_OK;
}

static vs_status symbol_to_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_symbol(vm, a, 0)) return VS_ERROR;
  vs_text t; /* copies the name, since creating the string may move the symbol */
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_put(&t, vs_as_symbol(a[0])->name, vs_as_symbol(a[0])->length) && vs_text_to_string(&t, out);
  vs_text_close(&t);
  if (ok) vs_object_of(*out)->flags |= VS_F_IMMUTABLE;
  return ok;
}

static vs_status string_to_symbol(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_string(vm, a, 0)) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_string(&t, a[0]) && vs_text_end(&t) && vs_intern(vm, t.at, t.count, out);
  vs_text_close(&t);
  return ok;
}

static vs_status symbol_append(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = true;
  for (int i = 0; ok && i < n; i++)
    ok = arg_symbol(vm, a, i) && vs_text_put(&t, vs_as_symbol(a[i])->name, vs_as_symbol(a[i])->length);
  ok = ok && vs_text_end(&t) && vs_intern(vm, t.at, t.count, out);
  vs_text_close(&t);
  return ok;
}

static const vs_native_def defs[] = {
  { "string?", "x", string_p, 0, NULL },
  { "make-string", "n [char]", string_make, 0, NULL },
  { "string", ". chars", string_string, 0, "a string of these characters" },
  { "string-length", "string", string_length, 0, NULL },
  { "string-ref", "string index", string_ref, 0, "the character at index, counted from 0" },
  { "string-set!", "string index char", string_set, 0, NULL },
  { "substring string-copy", "string [start end]", string_copy, 0, NULL },
  { "string-copy!", "to at from [start end]", string_copy_to, 0, NULL },
  { "string-fill!", "string char [start end]", string_fill, 0, NULL },
  { "string-append", ". strings", string_append, 0, NULL },
  { "string->list", "string [start end]", string_to_list, 0, NULL },
  { "list->string", "list", list_to_string, 0, NULL },
  { "string-reverse", "string", string_reverse, 0, NULL },
  { "string<?", "string . strings", string_lt, 0, NULL },
  { "string<=?", "string . strings", string_le, 0, NULL },
  { "string=?", "string . strings", string_eq, 0, NULL },
  { "string>=?", "string . strings", string_ge, 0, NULL },
  { "string>?", "string . strings", string_gt, 0, NULL },
  { "string-ci<?", "string . strings", string_ci_lt, 0, NULL },
  { "string-ci<=?", "string . strings", string_ci_le, 0, NULL },
  { "string-ci=?", "string . strings", string_ci_eq, 0, NULL },
  { "string-ci>=?", "string . strings", string_ci_ge, 0, NULL },
  { "string-ci>?", "string . strings", string_ci_gt, 0, NULL },
  { "string-upcase", "string", string_upcase, 0, NULL },
  { "string-downcase", "string", string_downcase, 0, NULL },
  { "string-foldcase", "string", string_foldcase, 0, NULL },
  { "string-search string-contains", "string text [start]", string_search, 0,
    "index of the first occurrence of text, or #f" },
  { "string-contains?", "string text", string_contains_p, 0, NULL },
  { "string-prefix?", "string prefix", string_prefix_p, 0, "does string begin with prefix?" },
  { "string-suffix?", "string suffix", string_suffix_p, 0, "does string end with suffix?" },
  { "string-join", "strings [between]", string_join, 0, "one string of all, with between (a blank) in between" },
  { "string-split", "string [separator]", string_split, 0, "a list of the pieces; without a separator the words" },
  { "string-trim", "string", string_trim, 0, "without the blanks at both ends" },
  { "string-trim-left", "string", string_trim_left, 0, NULL },
  { "string-trim-right", "string", string_trim_right, 0, NULL },
  { "string-pad-left", "string width [char]", string_pad_left, 0, NULL },
  { "string-pad-right", "string width [char]", string_pad_right, 0, NULL },
  { "string-replace", "string from to", string_replace, 0, "with every `from` replaced by `to`" },
  { "string-null?", "string", string_null_p, 0, NULL },
  { "symbol?", "x", symbol_p, 0, NULL },
  { "symbol=?", "symbol . symbols", symbol_equal_p, 0, NULL },
  { "symbol->string", "symbol", symbol_to_string, 0, NULL },
  { "string->symbol intern", "string", string_to_symbol, 0, NULL },
  { "symbol-append", ". symbols", symbol_append, 0, NULL },
  { NULL, NULL, NULL, 0, NULL }
};
const vs_native_table vs_string_natives = { "string", defs };
