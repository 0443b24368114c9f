/* Declares the pass fold, which multiplies nested placements and moves placements, materials and layers where they save
 * commands. */
#ifndef VS_PASSES_FOLD_H
#define VS_PASSES_FOLD_H

#include "passes/rewrite.h"

bool vs_fold_begin(vs_rewrite *w); /* makes the state of the pass, w->state; returns false when memory is out */
void vs_fold_end(vs_rewrite *w);

#endif
