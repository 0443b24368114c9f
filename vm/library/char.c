/* Implements the procedures of characters, with the Unicode tables of utf8proc for case and category. */
#include <utf8proc.h>

#include "vm/machine/native.h"
#include "vm/library/text_order.h"

static bool arg_char(vs_scheme *vm, const vs_value *a, int arg) {
  return vs_is_char(a[arg]) || vs_fail_type(vm, arg, "a character", a[arg]);
}

static vs_status char_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm, (void)n;
  *out = vs_bool(vs_is_char(a[0]));
  return VS_OK;
}

static vs_status char_to_integer(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_char(vm, a, 0)) return VS_ERROR;
  *out = vs_fix(vs_char(a[0]));
  return VS_OK;
}

static vs_status integer_to_char(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t c;
  if (!vs_arg_index(vm, a, 0, 0, 0x10FFFF, &c)) return VS_ERROR;
  if (c >= 0xD800 && c <= 0xDFFF) return vs_fail_type(vm, 0, "a code point that is no surrogate", a[0]);
  *out = VS_CHAR(c);
  return VS_OK;
}

/* ---- upper and lower case ---- */

/* char_up and char_down return a character's upper case and lower case. They do not change the sharp s, whose upper
 * case has two letters. */
static uint32_t char_up(uint32_t c) { return c == 0xDF ? c : (uint32_t)utf8proc_toupper((utf8proc_int32_t)c); }
static uint32_t char_down(uint32_t c) { return (uint32_t)utf8proc_tolower((utf8proc_int32_t)c); }
/* Returns the character's folded case, for comparisons that ignore case. The i with a dot and the i without a dot
 * remain different. */
static uint32_t char_fold(uint32_t c) { return c == 0x130 || c == 0x131 ? c : char_down(char_up(c)); }

#define CASE(name, map)                                                        \
  static vs_status char_##name(vs_scheme *vm, vs_value *a, int n, vs_value *out) {    \
    (void)n;                                                                   \
    if (!arg_char(vm, a, 0)) return VS_ERROR;                                  \
    *out = VS_CHAR(map(vs_char(a[0])));                                        \
    return VS_OK;                                                              \
  }
CASE(upcase, char_up) CASE(downcase, char_down) CASE(foldcase, char_fold)
#undef CASE

/* ---- comparison ---- */

static vs_status char_compare(vs_scheme *vm, const vs_value *a, int n, vs_text_order order, bool fold, vs_value *out) {
  bool holds = true;
  for (int i = 0; i < n; i++)
    if (!arg_char(vm, a, i)) return VS_ERROR;
  for (int i = 0; holds && i + 1 < n; i++) {
    uint32_t x = vs_char(a[i]), y = vs_char(a[i + 1]);
    if (fold) x = char_fold(x), y = char_fold(y);
    holds = vs_order_holds(order, (x > y) - (x < y));
  }
  *out = vs_bool(holds);
  return VS_OK;
}

#define O(name, order, fold)                                                                                           \
  static vs_status char_##name(vs_scheme *vm, vs_value *a, int n, vs_value *out) {                                     \
    return char_compare(vm, a, n, order, fold, out);                                                                   \
  }
VS_ORDERS(O)
#undef O

/* ---- Unicode categories ---- */

static bool is_alphabetic(uint32_t c) {
  utf8proc_category_t k = utf8proc_category((utf8proc_int32_t)c);
  return (k >= UTF8PROC_CATEGORY_LU && k <= UTF8PROC_CATEGORY_LO) || k == UTF8PROC_CATEGORY_NL;
}
static bool is_numeric(uint32_t c) { return utf8proc_category((utf8proc_int32_t)c) == UTF8PROC_CATEGORY_ND; }
static bool is_whitespace(uint32_t c) {
  utf8proc_category_t k = utf8proc_category((utf8proc_int32_t)c);
  return (c >= 9 && c <= 13) || c == 0x85 || k == UTF8PROC_CATEGORY_ZS || k == UTF8PROC_CATEGORY_ZL ||
         k == UTF8PROC_CATEGORY_ZP;
}
static bool is_upper(uint32_t c) {
  return char_down(c) != c || utf8proc_category((utf8proc_int32_t)c) == UTF8PROC_CATEGORY_LU;
}

/* Returns true for characters with Unicode's property Other_Lowercase that are not of category Ll and have no upper
 * case: ordinal indicators and superscript letters. */
static bool is_other_lower(uint32_t c) {
  static const uint32_t range[][2] = { { 0xAA, 0xAA },     { 0xBA, 0xBA },     { 0x2B0, 0x2B8 },   { 0x2C0, 0x2C1 },
                                       { 0x2E0, 0x2E4 },   { 0x345, 0x345 },   { 0x37A, 0x37A },   { 0x10FC, 0x10FC },
                                       { 0x1D2C, 0x1D6A }, { 0x1D78, 0x1D78 }, { 0x1D9B, 0x1DBF }, { 0x2071, 0x2071 },
                                       { 0x207F, 0x207F }, { 0x2090, 0x209C }, { 0x2C7C, 0x2C7D }, { 0xA69C, 0xA69D },
                                       { 0xA770, 0xA770 }, { 0xA7F8, 0xA7F9 }, { 0xAB5C, 0xAB5F } };
  for (size_t i = 0; i < sizeof range / sizeof *range; i++)
    if (c >= range[i][0] && c <= range[i][1]) return true;
  return false;
}

static bool is_lower(uint32_t c) {
  return !is_upper(c) &&
         (char_up(c) != c || utf8proc_category((utf8proc_int32_t)c) == UTF8PROC_CATEGORY_LL || is_other_lower(c));
}

#define CATEGORIES(C) C(alphabetic) C(numeric) C(whitespace) C(upper) C(lower)
#define C(name)                                                                  \
  static vs_status char_##name##_p(vs_scheme *vm, vs_value *a, int n, vs_value *out) {  \
    (void)n;                                                                     \
    if (!arg_char(vm, a, 0)) return VS_ERROR;                                    \
    *out = vs_bool(is_##name(vs_char(a[0])));                                    \
    return VS_OK;                                                                \
  }
CATEGORIES(C)
#undef C

/* Sets *out to the value of a decimal digit. In Unicode, the digits 0 to 9 of a script follow each other. The value is
 * therefore the distance from the first digit, at most nine characters back. */
static vs_status char_digit_value(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!arg_char(vm, a, 0)) return VS_ERROR;
  uint32_t c = vs_char(a[0]), back = 0;
  *out = VS_FALSE;
  if (!is_numeric(c)) return VS_OK;
  if (c >= 0x1D7CE && c <= 0x1D7FF) { /* the mathematical digits are five sequences of ten without gaps between them */
    *out = vs_fix((c - 0x1D7CE) % 10);
    return VS_OK;
  }
  while (back < 9 && is_numeric(c - back - 1)) back++;
  *out = vs_fix(back);
  return VS_OK;
}

static const vs_native_def defs[] = {
  { "char?", "x", char_p, 0, NULL },
  { "char->integer", "char", char_to_integer, 0, "the code point" },
  { "integer->char", "n", integer_to_char, 0, NULL },
  { "char-upcase", "char", char_upcase, 0, NULL },
  { "char-downcase", "char", char_downcase, 0, NULL },
  { "char-foldcase", "char", char_foldcase, 0, NULL },
  { "char<?", "char . chars", char_lt, 0, NULL },
  { "char<=?", "char . chars", char_le, 0, NULL },
  { "char=?", "char . chars", char_eq, 0, NULL },
  { "char>=?", "char . chars", char_ge, 0, NULL },
  { "char>?", "char . chars", char_gt, 0, NULL },
  { "char-ci<?", "char . chars", char_ci_lt, 0, NULL },
  { "char-ci<=?", "char . chars", char_ci_le, 0, NULL },
  { "char-ci=?", "char . chars", char_ci_eq, 0, NULL },
  { "char-ci>=?", "char . chars", char_ci_ge, 0, NULL },
  { "char-ci>?", "char . chars", char_ci_gt, 0, NULL },
  { "char-alphabetic?", "char", char_alphabetic_p, 0, NULL },
  { "char-numeric?", "char", char_numeric_p, 0, NULL },
  { "char-whitespace?", "char", char_whitespace_p, 0, NULL },
  { "char-upper-case?", "char", char_upper_p, 0, NULL },
  { "char-lower-case?", "char", char_lower_p, 0, NULL },
  { "digit-value", "char", char_digit_value, 0, "0 to 9 for a decimal digit of any script, else #f" },
  { NULL, NULL, NULL, 0, NULL }
};
const vs_native_table vs_char_natives = { "char", defs };
