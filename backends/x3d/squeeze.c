/* Owns squeezing: the packed scene of a page repeats itself, because parts alike differ by their places alone.
 *
 * The text begins with "VSL1" and is a row of sequences: a number of literal bytes, these bytes, the length of a match,
 * and, where that is not 0, how far back the match lies. Numbers are in base 128, low digits first. A match may reach
 * into itself. viewer/packed.js expands it. */
#include "backends/x3d/squeeze.h"

#include <string.h>

enum { MATCH_LEAST = 6 };

static bool put_count(vs_writer *w, size_t n) {
  unsigned char digits[10];
  size_t used = 0;
  for (; n > 127; n >>= 7) digits[used++] = (unsigned char)(n & 127) | 128;
  digits[used++] = (unsigned char)n;
  return vs_put(w, (const char *)digits, used);
}

static bool put_sequence(vs_squeeze *s, size_t from, size_t to, size_t match, size_t back) {
  return put_count(s->to, to - from) && vs_put(s->to, (const char *)s->at + from, to - from) &&
         put_count(s->to, match) && (match == 0 || put_count(s->to, back));
}

static uint32_t *head_of(vs_squeeze *s, size_t i) {
  uint32_t four;
  memcpy(&four, s->at + i, sizeof four);
  return &s->head[four * 2654435761u >> 16];
}

/* The length of the match at i with what stood at `before`, 0 where it is too short to be worth its two numbers. */
static size_t match_length(const vs_squeeze *s, size_t before, size_t i) {
  size_t n = 0;
  while (i + n < s->filled && s->at[before + n] == s->at[i + n]) n++;
  return n < MATCH_LEAST ? 0 : n;
}

static bool write_waiting(vs_squeeze *s) {
  size_t literal = s->squeezed, i = literal;
  while (i + MATCH_LEAST <= s->filled) {
    uint32_t *head = head_of(s, i);
    size_t before = *head, n = before ? match_length(s, before - 1, i) : 0;
    *head = (uint32_t)i + 1;
    if (n == 0) {
      i++;
      continue;
    }
    if (!put_sequence(s, literal, i, n, i - (before - 1))) return false;
    for (size_t end = i + n; ++i < end;)
      if (i + 4 <= s->filled) *head_of(s, i) = (uint32_t)i + 1;
    literal = i;
  }
  s->squeezed = s->filled;
  return literal == s->filled || put_sequence(s, literal, s->filled, 0, 0);
}

/* The last window stays, for matches to reach. */
static void slide(vs_squeeze *s) {
  size_t gone = s->filled - VS_SQUEEZE_WINDOW;
  memmove(s->at, s->at + gone, VS_SQUEEZE_WINDOW);
  for (size_t h = 0; h < VS_SQUEEZE_HEADS; h++) s->head[h] = s->head[h] > gone ? s->head[h] - (uint32_t)gone : 0;
  s->filled = s->squeezed = VS_SQUEEZE_WINDOW;
}

bool vs_squeeze_put(void *context, const void *bytes, size_t count) {
  vs_squeeze *s = context;
  const unsigned char *from = bytes;
  while (count) {
    size_t room = sizeof s->at - s->filled, n = count < room ? count : room;
    memcpy(s->at + s->filled, from, n);
    s->filled += n, from += n, count -= n;
    if (s->filled < sizeof s->at) continue;
    if (!write_waiting(s)) return false;
    slide(s);
  }
  return !s->to->failed;
}

bool vs_squeeze_end(vs_squeeze *s) { return write_waiting(s); }
