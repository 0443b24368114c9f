/* Declares the choice of the lines of a mesh that a view shows. */
#ifndef VS_SOLIDS_SIGHT_EDGES_H
#define VS_SOLIDS_SIGHT_EDGES_H

#include "solids/hidden_lines.h"

/* Appends the lines of a mesh that a draughtsman would draw: creases of more than 20 degrees, contours, borders, and
 * the lines of the view's cut. Vertices with equal positions count as one. Returns false and sets e if memory is out or
 * the caller interrupts. Takes n log n steps. */
bool vs_sight_find_edges(const vs_sight_host *host, const vs_sight *s, vs_sight_edges *out, vs_error *e);

void vs_sight_edges_free(const vs_sight_host *host, vs_sight_edges *edges);

#endif
