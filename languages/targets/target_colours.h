/* Owns what a program says as a colour: a ready material, a colour of CSS, or "#rrggbb", by its name. */
#ifndef VS_LANGUAGES_TARGETS_TARGET_COLOURS_H
#define VS_LANGUAGES_TARGETS_TARGET_COLOURS_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef struct {
  double r, g, b, transparency; /* sRGB, 0..1 */
  bool material;                /* a ready material, whose name no other language knows */
} tr_colour;

/* Is the node said as a colour, of an object or a material, there or by way of variables (colour_flow.h)? */
bool tr_is_colour(const tr_writer *w, tr_index node);
/* The colour that a string names. If it names none, an error is reported at the node, and the result is false. */
bool tr_find_colour(tr_writer *w, tr_index node, tr_colour *colour);
/* Plans a string that is said as a colour where the target knows CSS: a material as a list of numbers, all else as it
 * stands. */
void tr_plan_css_colour(tr_writer *w, tr_index node);

#endif
