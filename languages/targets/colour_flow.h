/* Owns which texts of a lowered tree name colours. */
#ifndef VS_LANGUAGES_TARGETS_COLOUR_FLOW_H
#define VS_LANGUAGES_TARGETS_COLOUR_FLOW_H

#include "languages/translate/core_tree.h"

/* Marks the nodes and variables that are said as colours (tr_node.colour, tr_variable.colour). After tr_find_kinds: the
 * rows of primitives tell how lists are taken apart. */
void tr_find_colours(translation *t);

#endif
