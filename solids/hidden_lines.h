/* Declares the visibility of a drawing's lines, which is computed from lines and the triangles of a mesh, without
 * pixels.
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
  VS_SIGHT_CUT,     /* a line at the border of the area where the view's plane cuts the model */
  VS_SIGHT_PARTING, /* a line between two materials within the area where the view's plane cuts the model */
  VS_SIGHT_OUTLINE, /* an edge with something farther away, or nothing, beside it; includes the contours of curved
                     * surfaces */
  VS_SIGHT_CREASE,  /* an edge between two visible faces */
  VS_SIGHT_CURVE,   /* a curve that the model draws */
  VS_SIGHT_KINDS
} vs_sight_kind;

typedef struct {
  vs_vec3 p, q;
  vs_sight_kind kind;
  double slack; /* greatest distance, in the view's units, of the edge behind a face at which it counts as lying in the
                 * face */
  uint32_t owner; /* number of the owner (vs_sight.owners) of one of the triangles at the edge; 0 if triangles have no
                   * owners */
} vs_sight_edge;
typedef struct { vs_sight_edge *at; size_t count, room; } vs_sight_edges;

/* A part of the edge number `edge`, from the fraction `from` to the fraction `to` of its length. hidden: true if
 * triangles hide it. */
typedef struct { uint32_t edge; double from, to; bool hidden; } vs_sight_piece;
typedef struct { vs_sight_piece *at; size_t count, room; } vs_sight_pieces;

/* The triangles that hide lines. The first `closed` of them bound solids; of these, triangles that face away from the
 * viewer are ignored, because the front of the same solid hides the same lines. */
typedef struct {
  const vs_vec3 *points;
  const uint32_t (*triangles)[3];
  size_t point_count, triangle_count, closed;
  const uint32_t *paints;   /* paints[i]: number of the paint of triangle i; an edge between different paints is drawn;
                             * may be NULL */
  const uint32_t *owners;   /* owners[i]: number that the edges of triangle i get as their owner; may be NULL */
  const uint32_t *objects;  /* objects[i]: number of the object of triangle i; an edge between different objects is
                             * drawn; may be NULL */
  const uint8_t *caps;      /* caps[i]: 1 if triangle i lies in the plane of the view's cut; may be NULL */
  bool perspective;
  double slack;             /* greatest length that counts as 0, about 1e-7 of the drawing's size */
} vs_sight;

typedef struct { vs_store *store; vs_job *job; /* job that may stop the work; NULL: nothing stops it */ } vs_sight_host;

/* Appends the visible parts of the edges to out, in order. with_hidden: also appends the hidden parts. Omits parts
 * shorter than a few times the slack. Returns false and sets e on failure. */
bool vs_sight_find_visible(const vs_sight_host *host, const vs_sight *s, const vs_sight_edges *edges, bool with_hidden,
                           vs_sight_pieces *out, vs_error *e);

void vs_sight_pieces_free(const vs_sight_host *host, vs_sight_pieces *pieces);

#endif
