/* Declares the hashes by which the store finds interned values: texts, origins, materials and pictures. */
#ifndef VS_MODEL_STORE_HASHES_H
#define VS_MODEL_STORE_HASHES_H

#include <stddef.h>
#include <stdint.h>

static inline uint64_t vs_hash_mix(uint64_t h, uint64_t v) {
  h = (h ^ v) * UINT64_C(0x9E3779B97F4A7C15);
  h ^= h >> 32;
  h *= UINT64_C(0xD6E8FEB86659FD93);
  return h ^ h >> 32;
}
uint64_t vs_hash_bytes(uint64_t h, const void *bytes, size_t size);
uint64_t vs_hash_real(uint64_t h, double d);

#endif
