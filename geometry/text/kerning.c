/* Reads kerning pairs from the GPOS table of a font: from every lookup of the feature `kern` that has type 2, or type 9
 * that refers to type 2.
 *
 * Names are those of the OpenType specification; numbers are big-endian. Every read is checked against the size of the
 * table, because users may supply broken fonts. */
#include "geometry/text/kerning.h"

#include <stdbool.h>

typedef struct { const unsigned char *at; size_t size; } table;

static uint32_t u16(const table *t, size_t at) {
  return at + 2 <= t->size ? (uint32_t)t->at[at] << 8 | t->at[at + 1] : 0;
}
static uint32_t u32(const table *t, size_t at) { return u16(t, at) << 16 | u16(t, at + 2); }
static int32_t s16(const table *t, size_t at) { return (int16_t)u16(t, at); }

/* Returns the index of the glyph in a coverage table, or -1 if the table does not contain the glyph. */
static long coverage(const table *t, size_t at, uint32_t glyph) {
  uint32_t count = u16(t, at + 2), low = 0, high = count;
  bool ranges = u16(t, at) == 2;
  if (!ranges && u16(t, at) != 1) return -1;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    size_t row = at + 4 + (size_t)middle * (ranges ? 6 : 2);
    uint32_t first = u16(t, row), last = ranges ? u16(t, row + 2) : first;
    if (glyph < first) high = middle;
    else if (glyph > last) low = middle + 1;
    else return ranges ? (long)(u16(t, row + 4) + glyph - first) : (long)middle;
  }
  return -1;
}

static uint32_t glyph_class(const table *t, size_t at, uint32_t glyph) {
  if (u16(t, at) == 1) {
    uint32_t first = u16(t, at + 2), count = u16(t, at + 4);
    return glyph >= first && glyph - first < count ? u16(t, at + 6 + 2 * (size_t)(glyph - first)) : 0;
  }
  uint32_t low = 0, high = u16(t, at) == 2 ? u16(t, at + 2) : 0;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    size_t row = at + 4 + 6 * (size_t)middle;
    if (glyph < u16(t, row)) high = middle;
    else if (glyph > u16(t, row + 2)) low = middle + 1;
    else return u16(t, row + 4);
  }
  return 0;
}

static size_t bits(uint32_t format) {
  size_t count = 0;
  for (; format; format &= format - 1) count++;
  return count;
}

/* Returns the horizontal advance (XAdvance) in a value record, or 0 if the record does not have it. Each bit of
 * `format` states whether a member exists: first XPlacement, then YPlacement, then XAdvance. */
static int32_t advance(const table *t, size_t record, uint32_t format) {
  return format & 4 ? s16(t, record + 2 * bits(format & 3)) : 0;
}

/* Sets *by to the kerning of the pair of glyphs left and right. Returns false if the subtable at offset `at` has no
 * entry for the pair. */
static bool pair(const table *t, size_t at, uint32_t left, uint32_t right, double *by) {
  uint32_t first = u16(t, at + 4), second = u16(t, at + 6);
  size_t record = 2 * (bits(first) + bits(second));
  long place = coverage(t, at + u16(t, at + 2), left);
  if (place < 0) return false;
  if (u16(t, at) == 1) {
    if ((uint32_t)place >= u16(t, at + 8)) return false;
    size_t set = at + u16(t, at + 10 + 2 * (size_t)place);
    uint32_t low = 0, high = u16(t, set);
    while (low < high) {
      uint32_t middle = low + (high - low) / 2, glyph;
      size_t row = set + 2 + (size_t)middle * (2 + record);
      glyph = u16(t, row);
      if (right < glyph) high = middle;
      else if (right > glyph) low = middle + 1;
      else return *by = advance(t, row + 2, first), true;
    }
    return false;
  }
  if (u16(t, at) != 2) return false;
  uint32_t left_class = glyph_class(t, at + u16(t, at + 8), left),
           right_class = glyph_class(t, at + u16(t, at + 10), right);
  uint32_t lefts = u16(t, at + 12), rights = u16(t, at + 14);
  if (left_class >= lefts || right_class >= rights) return false;
  *by = advance(t, at + 16 + ((size_t)left_class * rights + right_class) * record, first);
  return true;
}

static double lookup(const table *t, size_t at, uint32_t left, uint32_t right) {
  uint32_t type = u16(t, at), count = u16(t, at + 4);
  for (uint32_t i = 0; i < count; i++) {
    size_t sub = at + u16(t, at + 6 + 2 * (size_t)i);
    uint32_t kind = type;
    double by;
    if (type == 9) { /* type 9 is an extension subtable, which contains the actual type and a 32-bit offset */
      kind = u16(t, sub + 2);
      sub += u32(t, sub + 4);
    }
    if (kind == 2 && pair(t, sub, left, right, &by)) return by;
  }
  return 0;
}

double vs_kerning_pair(const unsigned char *bytes, size_t size, uint32_t left, uint32_t right) {
  const table t = { bytes, size };
  size_t features = u16(&t, 6), lookups = u16(&t, 8);
  uint32_t feature_count = u16(&t, features), lookup_count = u16(&t, lookups);
  double sum = 0;
  bool seen[256] = { false }; /* seen[i]: true if lookup i was already read, because several scripts refer to the same
                               * lookups; fonts have fewer than 256 lookups */
  for (uint32_t i = 0; i < feature_count; i++) {
    size_t row = features + 2 + 6 * (size_t)i;
    if (u32(&t, row) != 0x6B65726E) continue; /* 0x6B65726E: the four letters 'kern', name of the feature */
    size_t feature = features + u16(&t, row + 4);
    uint32_t count = u16(&t, feature + 2);
    for (uint32_t k = 0; k < count; k++) {
      uint32_t index = u16(&t, feature + 4 + 2 * (size_t)k);
      if (index >= lookup_count || index >= 256 || seen[index]) continue;
      seen[index] = true;
      sum += lookup(&t, lookups + u16(&t, lookups + 2 + 2 * (size_t)index), left, right);
    }
  }
  return sum;
}
