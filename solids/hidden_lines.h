/* Owns the visibility of a drawing's lines: lines against the triangles of a mesh, without pixels.
 *
 * All coordinates are the view's: x to the right, y up, z away from the viewer. In a parallel view a place is seen at
 * (x, y), in a perspective view, whose eye is the origin, at (x / z, y / z); there all coordinates must have z > 0. */
#ifndef VS_SOLIDS_HIDDEN_LINES_H
#define VS_SOLIDS_HIDDEN_LINES_H

#include "model/mesh.h"
#include "model/node.h"

typedef enum {
  VS_SIGHT_CUT,     /* around the faces that the view's plane cuts */
  VS_SIGHT_PARTING, /* between materials in that plane */
  VS_SIGHT_OUTLINE, /* behind one side of the edge is something further away; contours of curved surfaces are among
                     * these */
  VS_SIGHT_CREASE,  /* between two visible faces */
  VS_SIGHT_CURVE,   /* a curve that the program drew */
  VS_SIGHT_KINDS
} vs_sight_kind;

typedef struct {
  vs_vec3 p, q;
  vs_sight_kind kind;
  double slack; /* distance behind a face up to which it counts as lying in it */
} vs_sight_edge;
typedef struct { vs_sight_edge *at; size_t count, room; } vs_sight_edges;

/* The part of the edge between two fractions of its length from p to q. */
typedef struct { uint32_t edge; double from, to; bool hidden; } vs_sight_piece;
typedef struct { vs_sight_piece *at; size_t count, room; } vs_sight_pieces;

/* The triangles that hide lines. The first `closed` of them bound solids: those of them that face away from the viewer
 * hide nothing that others do not. */
typedef struct {
  const vs_vec3 *points;
  const uint32_t (*triangles)[3];
  size_t point_count, triangle_count, closed;
  const uint32_t *paints;   /* of each triangle: edges between different values are drawn; or NULL */
  const uint8_t *caps;      /* of each triangle: 1: it lies in the plane of the cut; or NULL */
  bool perspective;
  double slack;             /* lengths up to this count as zero: about 1e-7 of the size of all */
} vs_sight;

typedef struct { vs_store *store; bool (*going)(void *context); void *context; } vs_sight_host;

/* Appends the visible parts of the edges, in order; with_hidden: the hidden parts as well. Parts shorter than a few
 * times the slack are omitted. An edge is tested only against triangles whose place in the picture it crosses, nearest
 * first, until all of it is hidden. */
bool vs_sight_find_visible(const vs_sight_host *host, const vs_sight *s, const vs_sight_edges *edges, bool with_hidden,
                           vs_sight_pieces *out, vs_error *e);

void vs_sight_pieces_free(const vs_sight_host *host, vs_sight_pieces *pieces);

#endif
