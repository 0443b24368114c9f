/* Owns the search for texts of a lowered tree that name colours. */
#ifndef VS_LANGUAGES_TARGETS_COLOUR_FLOW_H
#define VS_LANGUAGES_TARGETS_COLOUR_FLOW_H

#include "languages/translate/core_tree.h"

/* Marks the nodes and variables that are colours (tr_node.colour, tr_variable.colour). tr_find_kinds comes first: the
 * rows of primitives tell how lists are taken apart. */
void tr_find_colours(translation *t);

#endif
