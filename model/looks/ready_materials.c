/* Finds materials by name: the predefined materials, the CSS colours and "#rrggbb". */
#include "model/looks/ready_materials.h"

#include <string.h>

static const struct { const char *name; vs_material material; } ready[] = {
#define VS_READY_MATERIAL(name, r, g, b, roughness, metallic, transparency, ior, kind, r2, g2, b2, size, angle)        \
  { name, { name, r, g, b, roughness, metallic, transparency, ior,                                                     \
            { VS_PATTERN_##kind, r2, g2, b2, size, angle, NULL } } },
#include "model/looks/materials.def"
};
static const struct { const char *name; unsigned rgb; } colors[] = {
#define VS_COLOR(name, rgb) { #name, rgb },
#include "model/looks/colors.def"
};

static vs_material material_of_hex(unsigned rgb, const char *name) {
  vs_material m = vs_material_of_color((rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0);
  m.name = name;
  return m;
}

static const vs_material *material_hex(vs_store *s, unsigned rgb, const char *name) {
  vs_material m = material_of_hex(rgb, name);
  return vs_store_material(s, &m);
}

static int material_hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static bool material_same_name(const char *table, const char *given) { /* Returns true if the two names are equal. In
                                                                        * CSS names, upper and lower case count as
                                                                        * equal. */
  for (; *table && *given; table++, given++)
    if (*table != (*given >= 'A' && *given <= 'Z' ? *given + 32 : *given)) return false;
  return *table == *given;
}

const vs_material *vs_store_ready_material(vs_store *s, const char *name) {
  for (size_t i = 0; i < sizeof ready / sizeof *ready; i++)
    if (!strcmp(name, ready[i].name)) return vs_store_material(s, &ready[i].material);
  if (name[0] == '#' && strlen(name) == 7) {
    unsigned rgb = 0;
    for (int i = 1; i < 7; i++) {
      int digit = material_hex_digit(name[i]);
      if (digit < 0) return NULL;
      rgb = rgb << 4 | (unsigned)digit;
    }
    return material_hex(s, rgb, "");
  }
  for (size_t i = 0; i < sizeof colors / sizeof *colors; i++)
    if (material_same_name(colors[i].name, name)) return material_hex(s, colors[i].rgb, colors[i].name);
  return NULL;
}

vs_named vs_ready_material_table(const vs_material *m) {
  for (size_t i = 0; i < sizeof ready / sizeof *ready; i++)
    if (!strcmp(m->name, ready[i].name))
      return vs_material_hash(m) == vs_material_hash(&ready[i].material) ? VS_NAMED_MATERIAL : VS_NAMED_NONE;
  for (size_t i = 0; i < sizeof colors / sizeof *colors; i++) {
    if (strcmp(m->name, colors[i].name)) continue;
    vs_material paint = material_of_hex(colors[i].rgb, colors[i].name);
    return vs_material_hash(m) == vs_material_hash(&paint) ? VS_NAMED_COLOR : VS_NAMED_NONE;
  }
  return VS_NAMED_NONE;
}

const char *vs_ready_material_name(size_t i) {
  size_t materials = sizeof ready / sizeof *ready;
  if (i < materials) return ready[i].name;
  return i < materials + sizeof colors / sizeof *colors ? colors[i - materials].name : NULL;
}
