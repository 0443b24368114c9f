/* Declares the pass share, which stores repeated subtrees once, as templates. */
#ifndef VS_PASSES_SHARE_H
#define VS_PASSES_SHARE_H

#include "passes/rewrite.h"

bool vs_share_begin(vs_rewrite *w); /* makes the state of the pass, w->state; returns false when memory is out */
void vs_share_end(vs_rewrite *w);

#endif
