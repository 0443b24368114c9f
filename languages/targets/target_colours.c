/* Converts names of colours to numbers. A name is searched in the order of model/looks/ready_materials.c: a ready
 * material has precedence over the CSS colour of the same name. */
#include "languages/targets/target_colours.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "languages/translate/text_plan.h"

static const tr_node *at(const tr_writer *w, tr_index n) { return &w->t->nodes[n]; }

bool tr_is_colour(const tr_writer *w, tr_index n) { return at(w, n)->colour == 1; }

static tr_colour of_rgb(unsigned rgb) {
  return (tr_colour){ (rgb >> 16) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, 0, false };
}

bool tr_find_colour(tr_writer *w, tr_index n, tr_colour *colour) {
  static const struct { const char *name; double r, g, b, transparency; } materials[] = {
#define VS_READY_MATERIAL(name, r, g, b, roughness, metallic, transparency, ...) { name, r, g, b, transparency },
#include "model/looks/materials.def"
#undef VS_READY_MATERIAL
  };
  static const struct { const char *name; unsigned rgb; } colours[] = {
#define VS_COLOR(name, value) { #name, value },
#include "model/looks/colors.def"
#undef VS_COLOR
  };
  const char *text = at(w, n)->text;
  for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
    if (!strcmp(materials[i].name, text))
      return *colour = (tr_colour){ materials[i].r, materials[i].g, materials[i].b, materials[i].transparency, true },
             true;
  if (*text == '#' && strlen(text) == 7 && strspn(text + 1, "0123456789abcdefABCDEF") == 6)
    return *colour = of_rgb((unsigned)strtoul(text + 1, NULL, 16)), true;
  for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
    if (!strcasecmp(colours[i].name, text)) return *colour = of_rgb(colours[i].rgb), true;
  tr_complain(w->t, n, "%s knows no colour \"%s\": say \"#rrggbb\"", w->target->title, text);
  return false;
}

void tr_plan_css_colour(tr_writer *w, tr_index n) {
  tr_colour c;
  char out[100];
  if (!tr_find_colour(w, n, &c)) return;
  if (!c.material) {
    tr_plan_quoted(w, at(w, n)->text);
    return;
  }
  int size = snprintf(out, sizeof out, "[%.4g, %.4g, %.4g", c.r, c.g, c.b);
  size += snprintf(out + size, sizeof out - (size_t)size, c.transparency > 0 ? ", %.4g]" : "]", 1 - c.transparency);
  tr_plan(w, "%s", know_text(w->t->k, out, (size_t)size));
}
