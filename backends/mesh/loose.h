/* Declares the collection of objects that are not solids, for formats of triangles that can express them: curves as
 * lines, regions and open surfaces as open faces. */
#ifndef VS_BACKENDS_MESH_LOOSE_H
#define VS_BACKENDS_MESH_LOOSE_H

#include "backends/backend.h"

/* A run: a line through its corners, or a list of triangles with three corners each. */
typedef struct {
  bool line;
  size_t first, count;         /* first: index of the run's first corner in the array `corners`; count: number of its
                                * corners */
  const vs_material *material; /* material of the run, or NULL */
  const char *layer, *part;    /* layer and part of the run, or NULL */
} vs_loose_run;

typedef struct {
  vs_vec3 *points;
  uint32_t *corners;           /* indices of points; the indices of a closed line end with its first index */
  vs_loose_run *runs;
  size_t point_count, corner_count, run_count;
  size_t point_room, corner_room, run_room;
} vs_loose;

/* The functions `begin` and `close` for a back-end whose e->state is a vs_loose. */
bool vs_loose_begin(vs_emitter *e);
void vs_loose_close(vs_emitter *e);
vs_emit_fn vs_loose_leaf, vs_loose_line, vs_loose_through, vs_loose_boolean;
size_t vs_loose_triangles(const vs_loose *l); /* returns the number of triangles in all open faces */
size_t vs_loose_pieces(const vs_loose *l);    /* returns the number of segments in all lines */

/* VS_LOOSE_SHAPES(more) contains the emit functions for a back-end that writes lines and open faces. more: further
 * traits (flags) of the back-end, or 0. */
#define VS_LOOSE_SHAPES(more)                                                                                          \
  .traits = VS_LOOSE | (more), .close = vs_loose_close,                                                                \
  VS_EMIT_SHAPES(vs_loose_leaf, vs_loose_line, vs_loose_through, vs_loose_boolean)
#define VS_LOOSE_FACES(curves) .traits = VS_LOOSE | VS_TURNS | VS_UNITS, .close = vs_loose_close, \
                               .omit = { [VS_CURVE] = curves }, \
                               VS_EMIT_SHAPES(vs_loose_leaf, NULL, vs_loose_through, vs_loose_boolean)

#endif
