/* Declares the packed notation: the X3D tree as bytes, for the viewer. packed.c describes the notation. */
#ifndef VS_BACKENDS_X3D_PACKED_H
#define VS_BACKENDS_X3D_PACKED_H

#include "backends/backend.h"

bool vs_packed_open(vs_emitter *e); /* Allocates e->state and writes the head of the scene to e->out. */
bool vs_packed_finish(vs_emitter *e); /* Writes the end of the scene. */
void vs_packed_close(vs_emitter *e);
vs_emit_fn vs_packed_leaf, vs_packed_line, vs_packed_through, vs_packed_boolean;
bool vs_packed_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open);
bool vs_packed_use(vs_emitter *e, uint32_t id, const vs_ref *ref);

#define VS_PACKED_BACKEND(begin_, end_, close_, boolean_)                                                              \
  .begin = begin_, .end = end_, .close = close_, .define = vs_packed_define, .use = vs_packed_use, .family = "x3d",    \
  .highlights = VS_MARKS_PAINT, .ghosts = VS_MARKS_PAINT,                                                              \
  VS_EMIT_SHAPES(vs_packed_leaf, vs_packed_line, vs_packed_through, boolean_)

#endif
