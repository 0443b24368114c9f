/* Declares the colours of a program, by name: a ready material, a CSS colour, or "#rrggbb". */
#ifndef VS_LANGUAGES_TARGETS_TARGET_COLOURS_H
#define VS_LANGUAGES_TARGETS_TARGET_COLOURS_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef struct {
  double r, g, b, transparency; /* colour in sRGB and transparency, 0 to 1 */
  bool material;                /* whether the name is that of a ready material, which no other language has */
} tr_colour;

/* Returns true if the node is the colour of an object or a material, directly or through variables (colour_flow.h). */
bool tr_is_colour(const tr_writer *w, tr_index node);
/* Sets *colour to the colour whose name is the string at the node. If there is no such colour, reports an error at the
 * node and returns false. */
bool tr_find_colour(tr_writer *w, tr_index node, tr_colour *colour);
/* Plans the text of a string that is a colour, for a target that has CSS colours: a material becomes a list of numbers,
 * all other colours are written unchanged. */
void tr_plan_css_colour(tr_writer *w, tr_index node);

#endif
