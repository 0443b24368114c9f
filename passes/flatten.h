/* Declares the pass flatten, which merges nested unions, intersections and differences. */
#ifndef VS_PASSES_FLATTEN_H
#define VS_PASSES_FLATTEN_H

#include "passes/rewrite.h"

bool vs_flatten_begin(vs_rewrite *w); /* makes the state of the pass, w->state; returns false when memory is out */
void vs_flatten_end(vs_rewrite *w);

#endif
