/* Makes the random numbers of a test from a seed. */
#ifndef VS_TESTS_DICE_H
#define VS_TESTS_DICE_H

#include <stdint.h>

typedef struct { uint64_t at; } dice;

/* Returns the next 64 bits (SplitMix64: Steele, Lea, Flood, 2014). */
static inline uint64_t throw(dice *d) {
  uint64_t z = d->at += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}
static inline double between(dice *d, double a, double b) {
  return a + (b - a) * (double)(throw(d) >> 11) / 9007199254740992.0;
}
/* Returns a whole number from low to high. */
static inline int32_t whole_between(dice *d, int32_t low, int32_t high) {
  return (int32_t)(low + (int64_t)((throw(d) >> 11) % (uint64_t)((int64_t)high - low + 1)));
}

#endif
