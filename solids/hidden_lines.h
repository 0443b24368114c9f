/* Declares the visibility of a drawing's lines, computed from lines and the triangles of a mesh, without pixels.
 *
 * All coordinates are those of the view: x to the right, y up, z away from the viewer. A parallel view shows a point at
 * (x, y). In a perspective view the eye is the origin, and the view shows a point at (x / z, y / z); all points must
 * then have z > 0. */
#ifndef VS_SOLIDS_HIDDEN_LINES_H
#define VS_SOLIDS_HIDDEN_LINES_H

#include "model/job.h"
#include "model/mesh.h"
#include "model/node.h"

typedef enum {
  VS_SIGHT_CUT,     /* a line around the faces at which the view's plane cuts the drawing */
  VS_SIGHT_PARTING, /* a line between two materials in the plane of the view's cut */
  VS_SIGHT_OUTLINE, /* an edge beside which something farther away is visible; includes the contours of curved
                     * surfaces */
  VS_SIGHT_CREASE,  /* an edge between two visible faces */
  VS_SIGHT_CURVE,   /* a curve that the model draws */
  VS_SIGHT_KINDS
} vs_sight_kind;

typedef struct {
  vs_vec3 p, q;
  vs_sight_kind kind;
  double slack; /* distance behind a face up to which the edge counts as lying in the face, in the view's units */
  uint32_t owner; /* owner (see vs_sight.owners) of a triangle at the edge; 0: triangles have no owners */
} vs_sight_edge;
typedef struct { vs_sight_edge *at; size_t count, room; } vs_sight_edges;

/* A part of an edge, between the fractions `from` and `to` of its length from p to q. hidden: true if triangles hide
 * it. */
typedef struct { uint32_t edge; double from, to; bool hidden; } vs_sight_piece;
typedef struct { vs_sight_piece *at; size_t count, room; } vs_sight_pieces;

/* The triangles that hide lines. The first `closed` triangles bound solids. Triangles of solids that face away from the
 * viewer are ignored, because the front of the same solid hides the same lines. */
typedef struct {
  const vs_vec3 *points;
  const uint32_t (*triangles)[3];
  size_t point_count, triangle_count, closed;
  const uint32_t *paints;   /* paints[i]: paint of triangle i; edges between different paints are drawn; may be NULL */
  const uint32_t *owners;   /* owners[i]: owner of triangle i, a number that its edges get; may be NULL */
  const uint32_t *objects;  /* objects[i]: object of triangle i; edges between different objects are drawn; may be
                             * NULL */
  const uint8_t *caps;      /* caps[i]: 1 if triangle i lies in the plane of the view's cut; may be NULL */
  bool perspective;
  double slack;             /* lengths up to this count as zero: about 1e-7 of the drawing's size */
} vs_sight;

typedef struct { vs_store *store; vs_job *job; /* job: it may stop the work; NULL: none */ } vs_sight_host;

/* Appends to `out` the visible parts of the edges, in order. with_hidden: also appends the hidden parts. Parts shorter
 * than a few times the slack are omitted. An edge is tested only against triangles that it crosses in the picture,
 * nearest first, until the entire edge is hidden. */
bool vs_sight_find_visible(const vs_sight_host *host, const vs_sight *s, const vs_sight_edges *edges, bool with_hidden,
                           vs_sight_pieces *out, vs_error *e);

void vs_sight_pieces_free(const vs_sight_host *host, vs_sight_pieces *pieces);

#endif
