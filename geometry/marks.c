/* Implements sets of small numbers. Level 0 has a bit for each number, in words of 64 bits. Each higher level has a bit
 * for every word of the level below, set if that word is not 0. The top level is one word. */
#include "geometry/marks.h"
#include "model/store/array.h"

#include <stdlib.h>

bool vs_marks_make(vs_marks *m, size_t count) {
  size_t words = 0, n = count;
  *m = (vs_marks){ .levels = 0 };
  do {
    n = n / 64 + 1;
    words += n;
    m->levels++;
  } while (n > 1);
  uint64_t *at = vs_zeros(words, sizeof *at);
  if (!at) return false;
  n = count;
  for (int k = 0; k < m->levels; k++) {
    n = n / 64 + 1;
    m->level[k] = at;
    at += n;
  }
  return true;
}

void vs_marks_free(vs_marks *m) {
  free(m->level[0]);
  *m = (vs_marks){ .levels = 0 };
}

void vs_marks_set(vs_marks *m, size_t i, bool in) {
  for (int k = 0; k < m->levels; k++, i /= 64) {
    uint64_t *word = &m->level[k][i / 64], bit = UINT64_C(1) << i % 64;
    if (in) *word |= bit;
    else if ((*word &= ~bit) != 0) return; /* the word still has other bits, so no higher level changes */
  }
}

static int marks_first(uint64_t word) { return __builtin_ctzll(word); }

/* Each level has one word more than it needs, so that the index i is valid even after the last word. */
size_t vs_marks_next(const vs_marks *m, size_t from) {
  size_t i = from;
  for (int k = 0; k < m->levels; k++, i = i / 64 + 1) { /* goes up to the first level at which a bit is set at position
                                                         * i or after it in the same word */
    uint64_t rest = m->level[k][i / 64] & ~UINT64_C(0) << i % 64;
    if (rest == 0) continue;
    i = i / 64 * 64 + (size_t)marks_first(rest);
    while (k-- > 0) i = i * 64 + (size_t)marks_first(m->level[k][i]); /* goes down again; in each level, takes the first
                                                                       * bit that is set in the word */
    return i;
  }
  return SIZE_MAX;
}
