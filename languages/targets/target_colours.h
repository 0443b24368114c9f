/* Owns the colours of a program: a ready material, a colour of CSS, or "#rrggbb", by its name. */
#ifndef VS_LANGUAGES_TARGETS_TARGET_COLOURS_H
#define VS_LANGUAGES_TARGETS_TARGET_COLOURS_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef struct {
  double r, g, b, transparency; /* sRGB, 0..1 */
  bool material;                /* a ready material, whose name no other language has */
} tr_colour;

/* Returns true if the node is a colour, of an object or a material, directly or through variables (colour_flow.h). */
bool tr_is_colour(const tr_writer *w, tr_index node);
/* Gives the colour that a string names. If it names none, reports an error at the node and returns false. */
bool tr_find_colour(tr_writer *w, tr_index node, tr_colour *colour);
/* Plans a string that is a colour, for a target with CSS: a material as a list of numbers, all else unchanged. */
void tr_plan_css_colour(tr_writer *w, tr_index node);

#endif
