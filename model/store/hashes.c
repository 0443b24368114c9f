/* Computes the hashes with which the store finds interned values (hashes.h). */
#include "model/store/hashes.h"

#include <string.h>

uint64_t vs_hash_bytes(uint64_t h, const void *bytes, size_t size) {
  const unsigned char *p = bytes;
  uint64_t v;
  h = vs_hash_mix(h, size);
  for (; size >= sizeof v; p += sizeof v, size -= sizeof v) {
    memcpy(&v, p, sizeof v);
    h = vs_hash_mix(h, v);
  }
  v = 0;
  memcpy(&v, p, size);
  return vs_hash_mix(h, v);
}

uint64_t vs_hash_real(uint64_t h, double d) {
  uint64_t v;
  d += 0.0; /* adding 0.0 changes -0 to 0, so that equal numbers have equal hashes */
  memcpy(&v, &d, sizeof v);
  return vs_hash_mix(h, v);
}
