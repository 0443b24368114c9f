/* Declares the search for texts of a lowered tree that are names of colours. */
#ifndef VS_LANGUAGES_TARGETS_COLOUR_FLOW_H
#define VS_LANGUAGES_TARGETS_COLOUR_FLOW_H

#include "languages/translate/core_tree.h"

/* Marks the nodes and variables that are colours (tr_node.colour, tr_variable.colour). Call tr_find_kinds first: the
 * rows of primitives show how lists are accessed. */
void tr_find_colours(translation *t);

#endif
