/* Declares flat nets: the triangles of a mesh, placed in a plane and joined along some of their edges. */
#ifndef VS_GEOMETRY_NETS_FLAT_NET_H
#define VS_GEOMETRY_NETS_FLAT_NET_H

#include "geometry/nets/mesh_edges.h"
#include "geometry/plane/areas.h"

typedef struct {
  vs_mesh_edges edges;
  vs_vec2 (*at)[3];    /* at[t][k]: corner k of triangle t in the plane, counter-clockwise */
  uint32_t *face;      /* face[t]: number of the flat face (coplanar triangles) to which triangle t belongs */
  uint32_t *piece;     /* piece[t]: number of the piece of the flat net to which triangle t belongs */
  bool *joined;        /* joined[e]: true if the two triangles at edge e are also connected by it in the plane */
  size_t faces, pieces;
  double size, slack;  /* size: size of the mesh; slack: distance below which two points count as equal; both in model
                        * units */
} vs_flat_net;

/* Finds the edges and the flat faces of m, which must outlive the net. Returns false when memory is out, or with
 * *several true when an edge has more than two triangles. The caller frees s in either case. */
bool vs_flat_net_make(vs_flat_net *s, const vs_mesh *m, bool *several);
void vs_flat_net_free(vs_flat_net *s);

/* Returns the position in the plane of a corner of triangle t: the corner opposite to edge e. `ends`: positions of the
 * edge's two ends; `side`: 1 if the corner lies to the left of the edge, -1 if to the right. */
vs_vec2 vs_flat_net_apex(const vs_flat_net *s, uint32_t t, uint32_t e, const vs_vec2 ends[2], double side);
/* Sets ends to the positions in the plane of the two ends of edge e, taken from triangle t. */
void vs_flat_net_ends(const vs_flat_net *s, uint32_t t, uint32_t e, vs_vec2 ends[2]);
/* Places triangle `to` in the plane beside triangle `from`, at their common edge e. */
void vs_flat_net_lay(vs_flat_net *s, uint32_t from, uint32_t to, uint32_t e);
/* Returns the index of the corner of triangle t that is opposite to edge e. */
int vs_flat_net_corner(const vs_flat_net *s, uint32_t t, uint32_t e);
/* Marks an edge as joined if its two triangles belong to one piece and both have the edge at the same place in the
 * plane, within `slack`. */
void vs_flat_net_join(vs_flat_net *s, double slack);

/* The deviation of a mesh from a developable surface, which can be laid flat without distortion. */
typedef struct {
  double worst;     /* largest difference, in radians, between a full turn and the sum of the angles around an inner
                     * corner */
  double curvature; /* sum of the absolute differences, in radians, between a full turn and the sum of the angles around
                     * each inner corner */
  double gap;       /* largest distance, in model units, between two positions of one corner after the mesh is laid
                     * flat */
  double twist;     /* largest distortion of a pair of triangles 2i and 2i + 1: the fraction by which the pair, laid
                     * flat, is wider at half its length than the ruled surface through its four corners */
} vs_flatness;
/* Lays each part of the mesh flat, from its first triangle on, and measures the errors. Each part becomes a piece.
 * Returns false when memory is out. */
bool vs_flat_net_unroll(vs_flat_net *s, vs_flatness *out);

/* A function that receives a border edge: edge e of triangle t, from ends[0] to ends[1] in the plane. Returns false
 * when memory is out. */
typedef bool vs_flat_border(void *context, uint32_t t, uint32_t e, const vs_vec2 ends[2]);
/* Follows the borders of a piece of the flat net, and calls `edge` for each border edge. Calls `ended` after each
 * closed loop. Returns false when memory is out, or one of these functions returns false. */
bool vs_flat_net_borders(const vs_flat_net *s, uint32_t piece, vs_flat_border *edge, bool (*ended)(void *),
                         void *context);

#endif
