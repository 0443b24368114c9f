/* Owns the materials that exist by name: the ready ones, the CSS colours and "#rrggbb". */
#include <string.h>

#include "model/node.h"

static const struct { const char *name; vs_material material; } ready[] = {
#define VS_READY_MATERIAL(name, red, green, blue, roughness, metallic, transparency, ior) \
  { #name, { #name, red, green, blue, roughness, metallic, transparency, ior } },
#include "model/materials.def"
};
static const struct { const char *name; unsigned rgb; } colors[] = {
#define VS_COLOR(name, rgb) { #name, rgb },
#include "model/colors.def"
};

static const double plain_roughness = 0.6, plain_ior = 1.5; /* of a material that is just a colour: matt paint */

vs_material vs_material_of_color(double red, double green, double blue) {
  return (vs_material){ .name = "", .red = red, .green = green, .blue = blue, .roughness = plain_roughness, .ior = plain_ior };
}

static const vs_material *material_hex(vs_store *s, unsigned rgb, const char *name) {
  vs_material m = vs_material_of_color((rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0);
  m.name = name;
  return vs_store_material(s, &m);
}

static int material_hex_digit(char c) {
  return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

static bool material_same_name(const char *table, const char *given) { /* CSS names are read in any case */
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

const char *vs_ready_material_name(size_t i) {
  size_t materials = sizeof ready / sizeof *ready;
  return i < materials ? ready[i].name : i < materials + sizeof colors / sizeof *colors ? colors[i - materials].name : NULL;
}
