/* Implements materials (material.h): plain materials, the names and sizes of patterns, and hashes. */
#include "model/looks/material.h"

#include <string.h>

#include "model/store/hashes.h"

static const struct { const char *name; double size; } patterns[VS_PATTERN_COUNT] = {
  { "none", 1 },
#define VS_PATTERN(id, name, size, shows) { name, size },
#include "model/looks/patterns.def"
  { "picture", 1 },
};

static const double plain_roughness = 0.6, plain_ior = 1.5; /* roughness and refractive index of a material that is
                                                             * given only by its colour */

const vs_material vs_material_default = { "", .8, .8, .8, .5, 0, 0, 1.5, { 0 } };
const double vs_pattern_darkening = 0.75;

vs_material vs_material_of_color(double red, double green, double blue) {
  return (vs_material){
    .name = "", .red = red, .green = green, .blue = blue, .roughness = plain_roughness, .ior = plain_ior };
}

const char *vs_pattern_name(vs_pattern p) { return patterns[p].name; }
double vs_pattern_size(const vs_material_pattern *p) { return p->size > 0 ? p->size : patterns[p->kind].size; }

double vs_pattern_height(const vs_material_pattern *p) {
  return p->picture ? vs_pattern_size(p) * p->picture->rows / p->picture->columns : vs_pattern_size(p);
}

bool vs_pattern_find(const char *name, vs_pattern *out) {
  for (int p = 0; p < VS_PATTERN_PICTURE; p++)
    if (!strcmp(name, patterns[p].name)) return *out = (vs_pattern)p, true;
  return false;
}

uint64_t vs_material_hash(const vs_material *m) {
  uint64_t h = vs_hash_bytes(2, m->name, strlen(m->name));
  const double fields[] = { m->red, m->green, m->blue, m->roughness, m->metallic, m->transparency, m->ior };
  const vs_material_pattern *p = &m->pattern;
  const double pattern[] = { p->kind, p->red, p->green, p->blue, p->size, p->angle };
  for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) h = vs_hash_real(h, fields[i]);
  if (p->kind == VS_PATTERN_NONE) return h;
  for (size_t i = 0; i < sizeof pattern / sizeof *pattern; i++) h = vs_hash_real(h, pattern[i]);
  if (p->picture) h = vs_hash_mix(h, p->picture->hash);
  return h;
}
