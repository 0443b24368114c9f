/* Declares the drawing of a tree of calls. */
#ifndef VS_CLI_PROFILE_FLAME_GRAPH_H
#define VS_CLI_PROFILE_FLAME_GRAPH_H

#include <stdio.h>

#include "cli/profile/profile_lines.h"

/* Writes the tree as SVG: a bar for each call, as wide as its time, upon that of its caller. Returns false when memory
 * is out. */
bool profile_write_flames(const profile_tree *t, const char *title, FILE *to);

#endif
