/* Declares the pass share. */
#ifndef VS_PASSES_SHARE_H
#define VS_PASSES_SHARE_H

#include "passes/rewrite.h"

bool vs_share_begin(vs_rewrite *w); /* makes w->state */
void vs_share_end(vs_rewrite *w);

#endif
