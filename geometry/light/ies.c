/* Reads files of lamps in the format IES LM-63, Standard File Format for the Electronic Transfer of Photometric Data.
 * It accepts the editions of 1986 (which does not name its edition in a line), 1991, 1995 and 2002. */
#include "geometry/light/ies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ANGLES_MOST = 2000, LINE_MOST = 4096, WORD_MOST = 64 };
static const double candelas_most = 1e9;

typedef struct {
  const char *name, *at, *end;
  uint32_t line;
  vs_error *error;
} ies_text;

static bool ies_wrong(const ies_text *t, const char *what) {
  return vs_error_set(t->error, VS_ERROR_MODEL, NULL, "%.100s:%u: %s", t->name, t->line, what);
}

/* Sets *from and *count to the next line without its line end. Returns false at the end of the text. */
static bool ies_line(ies_text *t, const char **from, size_t *count) {
  if (t->at == t->end) return false;
  const char *stop = memchr(t->at, '\n', (size_t)(t->end - t->at));
  *from = t->at, *count = (size_t)((stop ? stop : t->end) - t->at);
  while (*count > 0 && ((*from)[*count - 1] == '\r' || (*from)[*count - 1] == ' ')) --*count;
  t->at = stop ? stop + 1 : t->end;
  t->line++;
  return true;
}

/* Reads label lines up to the line TILT=, whose value must be NONE. Returns false on failure. */
static bool ies_labels(ies_text *t) {
  const char *from;
  size_t count;
  t->line = 0;
  while (ies_line(t, &from, &count)) {
    if (count > LINE_MOST || memchr(from, 0, count)) return ies_wrong(t, "this is no text of an IES file");
    if (count < 5 || memcmp(from, "TILT=", 5) != 0) continue;
    if (count == 9 && !memcmp(from + 5, "NONE", 4)) return t->line++, true; /* the numbers begin on the line after
                                                                             * TILT=NONE */
    return ies_wrong(t, "only IES files with TILT=NONE can be read");
  }
  return ies_wrong(t, "this is no IES file: it has no line TILT=NONE");
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == '\f'; }

/* Reads the next number, on the current line or a later one. Commas also separate numbers. Returns false, with an
 * error, if the number is not from least to most. */
static bool ies_number(ies_text *t, const char *what, double least, double most, double *out) {
  char word[WORD_MOST], *rest;
  size_t count = 0;
  for (; t->at < t->end && is_blank(*t->at); t->at++) t->line += *t->at == '\n';
  while (t->at < t->end && !is_blank(*t->at) && count + 1 < WORD_MOST) word[count++] = *t->at++;
  word[count] = 0;
  bool plain = strspn(word, "0123456789+-.eE") == count; /* `plain` is false for "nan", "inf" and hexadecimal numbers,
                                                          * which strtod would accept */
  *out = plain ? strtod(word, &rest) : 0;
  if (count > 0 && plain && *rest == 0 && isfinite(*out) && *out >= least && *out <= most) return true;
  return vs_error_set(t->error, VS_ERROR_MODEL, NULL,
                      count > 0 ? "%.100s:%u: %s must be a number from %g to %g, got %s"
                                : "%.100s:%u: the file ends before %s, a number from %g to %g",
                      t->name, t->line, what, least, most, word);
}

static bool ies_count(ies_text *t, const char *what, double most, uint32_t *out) {
  double x;
  if (!ies_number(t, what, 1, most, &x)) return false;
  *out = (uint32_t)x;
  return x == floor(x) || ies_wrong(t, "a count must be a whole number");
}

static bool ies_angles(ies_text *t, const char *what, double most, double *at, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) {
    if (!ies_number(t, what, 0, most, &at[i])) return false;
    if (i > 0 && at[i] <= at[i - 1]) return ies_wrong(t, "the angles must ascend");
  }
  return true;
}

static const double *horizontals_of(const vs_ies *x) { return x->at + x->verticals; }
/* Returns the intensities in candelas at horizontal angle number i, one for each vertical angle. */
static const double *row_of(const vs_ies *x, uint32_t i) {
  VS_ASSERT(i < x->horizontals);
  return x->at + x->verticals + x->horizontals + (size_t)i * x->verticals;
}

/* Returns true if the format allows the range of horizontal angles: a full turn, or a part of a turn that symmetry
 * completes. */
static bool ies_is_round(const ies_text *t, const vs_ies *x) {
  const double *h = horizontals_of(x), last = h[x->horizontals - 1];
  if (h[0] == 0 && (last == 0 || last == 90 || last == 180 || last == 360)) return true;
  if (h[0] == 90 && last == 270) return true;
  /* Many makers omit the row of intensities at 360 degrees, which would repeat the row at 0. */
  if (h[0] == 0 && last > 180 && last < 360) return true;
  return ies_wrong(t, "the horizontal angles must go from 0 to 0, 90, 180 or 360, or from 90 to 270");
}

static bool ies_body(ies_text *t, vs_ies *x) {
  double lamps, lumens, times, type, unused, ballast, factor;
  if (!ies_number(t, "the number of lamps", 1, 1e6, &lamps) ||
      !ies_number(t, "the lumens of a lamp", -1, 1e9, &lumens) ||
      !ies_number(t, "the multiplier of candelas", 0, 1e6, &times) ||
      !ies_count(t, "the number of vertical angles", ANGLES_MOST, &x->verticals) ||
      !ies_count(t, "the number of horizontal angles", ANGLES_MOST, &x->horizontals) ||
      !ies_number(t, "the type of photometry", 1, 3, &type))
    return false;
  if (type != 1) return ies_wrong(t, "only photometry of type C (the number 1) can be read");
  if (!ies_number(t, "the unit of lengths", 1, 2, &unused)) return false;
  for (int i = 0; i < 3; i++)
    if (!ies_number(t, "the width, length or height of the lamp", -1e6, 1e6, &unused)) return false;
  if (!ies_number(t, "the ballast factor", 0, 1e3, &ballast) ||
      !ies_number(t, "the ballast lamp factor", 0, 1e3, &factor) || !ies_number(t, "the watts", 0, 1e9, &unused))
    return false;
  size_t count = (size_t)x->verticals * x->horizontals;
  /* Each number takes at least two bytes of the file. This check prevents the allocation of more memory than the file
   * can fill. */
  if (count > (size_t)(t->end - t->at)) return ies_wrong(t, "the file has fewer numbers than its angles need");
  x->room = (x->verticals + x->horizontals + count) * sizeof *x->at;
  x->at = vs_store_realloc(x->store, NULL, 0, x->room);
  if (!x->at) return vs_error_memory(t->error, NULL);
  double *h = x->at + x->verticals, *candelas = h + x->horizontals;
  if (!ies_angles(t, "a vertical angle", 180, x->at, x->verticals)) return false;
  if (!ies_angles(t, "a horizontal angle", 360, h, x->horizontals) || !ies_is_round(t, x)) return false;
  for (size_t i = 0; i < count; i++) {
    if (!ies_number(t, "an intensity in candelas", 0, candelas_most, &candelas[i])) return false;
    candelas[i] *= times * ballast * factor;
    x->most = fmax(x->most, candelas[i]);
  }
  return (x->most > 0 && x->most <= candelas_most) ||
         ies_wrong(t, x->most > 0 ? "the lamp is impossibly bright" : "the lamp gives no light");
}

bool vs_ies_read(vs_store *store, const char *name, const char *text, size_t size, vs_ies *out, vs_error *e) {
  ies_text t = { .name = name, .at = text, .end = text + size, .error = e };
  *out = (vs_ies){ .store = store };
  bool ok = ies_labels(&t) && ies_body(&t, out);
  if (!ok) vs_ies_free(out);
  return ok;
}

void vs_ies_free(vs_ies *ies) {
  if (ies->at) vs_store_realloc(ies->store, ies->at, ies->room, 0);
  *ies = (vs_ies){ .store = ies->store };
}

/* Finds the neighbours *i and *i + 1 of `angle` in the ascending array `at`. *share: position of `angle` between the
 * two, 0 to 1. Returns false if `angle` is outside the range. count is at least 1. */
static bool between(const double *at, uint32_t count, double angle, uint32_t *i, double *share) {
  uint32_t low = 0, high = count - 1;
  VS_ASSERT(count > 0);
  *i = 0, *share = 0;
  if (angle < at[0] - 1e-9 || angle > at[high] + 1e-9) return false;
  while (high - low > 1) {
    uint32_t middle = low + (high - low) / 2;
    if (at[middle] <= angle) low = middle;
    else high = middle;
  }
  *i = low;
  if (count > 1) *share = fmax(0, fmin(1, (angle - at[low]) / (at[low + 1] - at[low])));
  return true;
}

static double along(const vs_ies *x, uint32_t row, uint32_t i, double share) {
  const double *c = row_of(x, row);
  return share > 0 ? c[i] + share * (c[i + 1] - c[i]) : c[i];
}

double vs_ies_candelas(const vs_ies *x, double vertical, double horizontal) {
  const double *h = horizontals_of(x), first = h[0], last = h[x->horizontals - 1];
  uint32_t i, k;
  double down, round;
  if (!between(x->at, x->verticals, vertical, &i, &down)) return 0;
  horizontal = fmod(fmod(horizontal, 360) + 360, 360);
  if (last == 0) return along(x, 0, i, down);
  if (first == 90) { /* the file's angles go from 90 to 270 degrees; the other half of the turn is its mirror image */
    if (horizontal < 90) horizontal = 180 - horizontal;
    else if (horizontal > 270) horizontal = 540 - horizontal;
  } else if (last <= 180) {
    if (horizontal > 180) horizontal = 360 - horizontal;
    if (last == 90 && horizontal > 90) horizontal = 180 - horizontal;
  } else if (horizontal > last) { /* interpolates between the last horizontal angle and the first, across 360 degrees */
    double share = (horizontal - last) / (360 - last);
    return (1 - share) * along(x, x->horizontals - 1, i, down) + share * along(x, 0, i, down);
  }
  if (!between(h, x->horizontals, horizontal, &k, &round)) return 0;
  double a = along(x, k, i, down);
  return round > 0 ? a + round * (along(x, k + 1, i, down) - a) : a;
}
