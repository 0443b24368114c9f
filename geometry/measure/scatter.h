/* Scatters numbers over an interval, for the directions of rays. */
#ifndef VS_GEOMETRY_MEASURE_SCATTER_H
#define VS_GEOMETRY_MEASURE_SCATTER_H

#include <stdint.h>

/* Returns a number from 0 to below 1, by a hash of x (the last step of MurmurHash3). */
static inline double vs_scattered(uint32_t x) {
  x ^= x >> 16, x *= 0x85ebca6bu;
  x ^= x >> 13, x *= 0xc2b2ae35u;
  return (x ^ x >> 16) * 0x1p-32;
}

#endif
