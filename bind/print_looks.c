/* Writes materials as text, as a program writes them: a predefined material by its name, a colour as "#rrggbb" or as a
 * list, other materials by the keywords of make-material that differ from the defaults. */
#include "bind/print_looks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/looks/ready_materials.h"

/* Returns true if the program probably gave the colour as "#rrggbb": the components are multiples of 1/255, and would
 * be longer as decimals than programs write them. parts: the components times 255. */
static bool is_hex(const double c[3], int parts[3]) {
  const size_t most = 5; /* greatest length of a colour's component as text: up to three decimals, as programs write
                          * them */
  bool longer = false;
  for (int i = 0; i < 3; i++) {
    char t[32];
    parts[i] = (int)lround(c[i] * 255);
    if (c[i] != parts[i] / 255.0) return false;
    vs_bind_number_text(t, c[i]);
    longer = longer || strlen(t) > most;
  }
  return longer;
}

static bool color(const sink *k, double red, double green, double blue, bool hex) {
  const double c[3] = { red, green, blue };
  int parts[3];
  char t[16];
  if (is_hex(c, parts) || (hex && red * 255 == parts[0] && green * 255 == parts[1] && blue * 255 == parts[2])) {
    snprintf(t, sizeof t, "\"#%02x%02x%02x\"", (unsigned)parts[0] & 255, (unsigned)parts[1] & 255,
             (unsigned)parts[2] & 255);
    return text(k, t);
  }
  return text(k, "(list ") && number(k, red) && text(k, " ") && number(k, green) && text(k, " ") && number(k, blue) &&
         text(k, ")");
}

/* Returns true if the call (color c o) creates the material m for some colour c. *hex: whether c is a string, not a
 * list. */
static bool is_paint(const vs_material *m, bool *hex) {
  vs_material by_text = vs_material_of_color(m->red, m->green, m->blue), by_list = by_text;
  by_list.roughness = vs_material_default.roughness;
  uint64_t hash = vs_material_hash(m);
  *hex = hash == vs_material_hash(&by_text);
  return *hex || hash == vs_material_hash(&by_list);
}

static bool keyword(const sink *k, const char *name, double value, double usual) {
  return value == usual || (text(k, " #:") && text(k, name) && text(k, " ") && number(k, value));
}

static bool pattern(const sink *k, const vs_material *m) {
  const vs_material_pattern *p = &m->pattern;
  const double darker = vs_pattern_darkening;
  if (p->kind == VS_PATTERN_NONE) return true;
  if (p->picture) {
    if (!text(k, " #:image ") || !quoted(k, p->picture->path)) return false;
  } else {
    if (!text(k, " #:pattern '") || !text(k, vs_pattern_name(p->kind))) return false;
    if ((p->red != darker * m->red || p->green != darker * m->green || p->blue != darker * m->blue) &&
        !(text(k, " #:pattern-color ") && color(k, p->red, p->green, p->blue, false)))
      return false;
  }
  return keyword(k, "pattern-size", p->size, 0) && keyword(k, "pattern-angle", p->angle, 0);
}

static bool call(const sink *k, const vs_material *m) {
  const vs_material *d = &vs_material_default;
  const double plain[3] = { d->red, d->green, d->blue };
  const double *usual = m->pattern.picture ? m->pattern.picture->mean : plain;
  bool colored = m->red != usual[0] || m->green != usual[1] || m->blue != usual[2];
  return text(k, "(make-material") &&
         (!*m->name || (text(k, " #:name ") && quoted(k, m->name))) &&
         (!colored || (text(k, " #:color ") && color(k, m->red, m->green, m->blue, false))) &&
         keyword(k, "roughness", m->roughness, d->roughness) && keyword(k, "metallic", m->metallic, d->metallic) &&
         keyword(k, "transparency", m->transparency, d->transparency) && keyword(k, "ior", m->ior, d->ior) &&
         pattern(k, m) && text(k, ")");
}

bool vs_bind_print_material(const vs_material *m, vs_put_text *put, void *to) {
  const sink k = { put, to };
  return vs_ready_material_table(m) != VS_NAMED_NONE ? text(&k, m->name) : call(&k, m);
}

bool vs_bind_print_painting(const vs_material *m, vs_put_text *put, void *to) {
  const sink k = { put, to };
  bool hex;
  switch (vs_ready_material_table(m)) {
    case VS_NAMED_MATERIAL: return text(&k, "(with-material ") && quoted(&k, m->name);
    case VS_NAMED_COLOR: return text(&k, "(color ") && quoted(&k, m->name);
    case VS_NAMED_NONE: break;
  }
  if (m->pattern.picture) return text(&k, "(with-material ") && quoted(&k, m->name);
  if (is_paint(m, &hex)) {
    const double c[3] = { m->red, m->green, m->blue };
    int parts[3];
    if (hex || !is_hex(c, parts)) return text(&k, "(color ") && color(&k, m->red, m->green, m->blue, hex);
  }
  return text(&k, "(with-material ") && call(&k, m);
}
