/* Owns the hashes that nodes, texts and materials are known by. */
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
  d += 0.0; /* -0 is 0 */
  memcpy(&v, &d, sizeof v);
  return vs_hash_mix(h, v);
}

uint64_t vs_material_hash(const vs_material *m) {
  uint64_t h = vs_hash_bytes(2, m->name, strlen(m->name));
  const double fields[] = { m->red, m->green, m->blue, m->roughness, m->metallic, m->transparency, m->ior };
  const vs_material_pattern *p = &m->pattern;
  const double pattern[] = { p->kind, p->red, p->green, p->blue, p->size, p->angle };
  for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) h = vs_hash_real(h, fields[i]);
  if (p->kind == VS_PATTERN_NONE) return h;
  for (size_t i = 0; i < sizeof pattern / sizeof *pattern; i++) h = vs_hash_real(h, pattern[i]);
  return h;
}
