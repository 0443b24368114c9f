/* Declares feature edges: the edges of a mesh that a draughtsman would draw, such as creases and borders. */
#ifndef VS_SOLIDS_FEATURE_EDGES_H
#define VS_SOLIDS_FEATURE_EDGES_H

#include "solids/sections.h"

void vs_polylines_free(vs_polylines *p);

#endif
