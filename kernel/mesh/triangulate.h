/* Declares the exact triangulation of a polygon in one plane. The polygon may have holes, corners that touch, and
 * slits. */
#ifndef VS_KERNEL_MESH_TRIANGULATE_H
#define VS_KERNEL_MESH_TRIANGULATE_H

#include "kernel/cluster.h"
#include "kernel/arrange/sweep.h"

typedef struct { uint32_t from, to; } vs_border;
typedef struct { uint32_t vertex, previous, next; } vs_chain_node;
typedef struct { uint32_t head, tail, rightmost; } vs_chain;
typedef struct { uint32_t l, r; uint8_t inside; } vs_boundary; /* an edge of the polygon with its left and right end;
                                                                * inside: bit 0 is set if the polygon is above the edge,
                                                                * bit 1 if it is below */

typedef struct {
  VS_LIST(vs_border) sides;              /* input: border of the polygon, from point to point; the inside is on the
                                          * left, as seen from the tip of the plane's normal */
  /* output: point numbers of the triangles' corners, counter-clockwise as seen from the tip of the plane's normal */
  struct { uint32_t (*at)[3]; size_t count, room; } triangles;
  vs_sweep sweep;
  VS_LIST(uint32_t) list, scratch, local;
  VS_LIST(vs_boundary) boundary;
  VS_LIST(vs_chain_node) nodes;
  VS_LIST(vs_chain) chains;            /* chains[e]: left border of the space directly above edge e that has no
                                        * triangles yet */
} vs_triangulation;

bool vs_plane_triangulate(vs_kernel *k, vs_triangulation *t, const vs_points_table *points, const vs_plane *plane);
void vs_triangulation_free(vs_kernel *k, vs_triangulation *t);

#endif
