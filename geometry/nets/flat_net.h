/* Declares flat nets: the triangles of a mesh, laid into a plane and joined along some of their edges. */
#ifndef VS_GEOMETRY_NETS_FLAT_NET_H
#define VS_GEOMETRY_NETS_FLAT_NET_H

#include "geometry/nets/mesh_edges.h"
#include "geometry/plane/areas.h"

typedef struct {
  vs_mesh_edges edges;
  vs_vec2 (*at)[3];    /* at[t][k]: corner k of triangle t in the plane, counter-clockwise */
  uint32_t *face;      /* face[t]: index of the flat face to which triangle t belongs */
  uint32_t *piece;     /* piece[t]: index of the piece to which triangle t belongs */
  bool *joined;        /* joined[e]: whether the two triangles beside edge e lie beside each other in the plane */
  size_t faces, pieces;
  double size, slack;  /* size of the mesh; distance below which two points count as one, in model units */
} vs_flat_net;

/* Finds the edges and the flat faces of m, which must outlive the net. Fails when memory is out, or when more than two
 * triangles meet along an edge (*several). The caller frees s with vs_flat_net_free in either case. */
bool vs_flat_net_make(vs_flat_net *s, const vs_mesh *m, bool *several);
void vs_flat_net_free(vs_flat_net *s);

/* Returns the place of the corner of triangle t opposite to edge e, from the places of the edge's ends. side: 1 if it
 * lies to the left of the edge, -1 to the right. */
vs_vec2 vs_flat_net_apex(const vs_flat_net *s, uint32_t t, uint32_t e, const vs_vec2 ends[2], double side);
/* Sets ends to the places of the ends a and b of edge e in triangle t. */
void vs_flat_net_ends(const vs_flat_net *s, uint32_t t, uint32_t e, vs_vec2 ends[2]);
/* Lays triangle `to` beside triangle `from`, across their common edge e. */
void vs_flat_net_lay(vs_flat_net *s, uint32_t from, uint32_t to, uint32_t e);
/* Returns the index of the corner of triangle t that is opposite to edge e. */
int vs_flat_net_corner(const vs_flat_net *s, uint32_t t, uint32_t e);
/* Marks the edges as joined where both triangles belong to one piece and the ends of the edge agree within `slack`. */
void vs_flat_net_join(vs_flat_net *s, double slack);

/* How far a mesh is from one that can be laid flat. */
typedef struct {
  double worst;     /* largest difference between the angles about an inner corner and a full turn, in radians */
  double curvature; /* sum of these differences, each taken as positive, in radians */
  double gap;       /* largest distance between two places of one corner, if the mesh is laid flat all the same */
  double twist;     /* for pairs of triangles 2i and 2i+1: the largest share by which the pair is wider halfway in the
                     * plane than a ruled surface through its four corners */
} vs_flatness;
/* Lays each part of the mesh flat from its first triangle, the triangles of a flat face first, and measures the error.
 * Each part becomes a piece. Returns false when memory is out. */
bool vs_flat_net_unroll(vs_flat_net *s, vs_flatness *out);

/* Receives the next border edge e of the triangle t, from p to q. Returns false when memory is out. */
typedef bool vs_flat_border(void *context, uint32_t t, uint32_t e, const vs_vec2 ends[2]);
/* Walks the borders of the triangles of a piece. After each loop calls `ended`. Returns false when memory is out, or a
 * function returns false. */
bool vs_flat_net_borders(const vs_flat_net *s, uint32_t piece, vs_flat_border *edge, bool (*ended)(void *),
                         void *context);

#endif
