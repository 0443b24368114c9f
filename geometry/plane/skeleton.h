/* Declares the straight skeleton of closed outlines. Each edge of an outline moves inwards at its own speed; the strip
 * that it sweeps over is its face. With the time as height, the faces are a roof of planes. */
#ifndef VS_GEOMETRY_PLANE_SKELETON_H
#define VS_GEOMETRY_PLANE_SKELETON_H

#include "geometry/plane/ear_clipping.h"
#include "model/long_work.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Closed loops in a plane, in any order and direction. A loop inside an odd number of others is a hole. Edge k of a
 * loop goes from its corner k to the next one. */
typedef struct {
  const vs_vec2 *at;
  const double *speed; /* speed[i]: speed with which the edge that begins at corner i moves inwards, as length for each
                        * unit of time, 0 or more */
  const size_t *size;  /* size[l]: number of corners of loop l, 3 or more */
  size_t loop_count;
} vs_skeleton_outline;

#define VS_SKELETON_STEP SIZE_MAX /* value of a face's member `edge` if the face belongs to no edge of the outline: see
                                   * vs_skeleton_face */

/* A face is one loop of corners, counter-clockwise seen from above. The face of an edge of speed 0 is vertical. Where
 * edges of one line have different speeds, a vertical face joins their faces; its edge is VS_SKELETON_STEP. */
typedef struct {
  size_t edge;         /* index of the face's edge among the outline's edges, or VS_SKELETON_STEP */
  size_t first, count; /* the face's corners are corner[first] to corner[first + count - 1] */
} vs_skeleton_face;

typedef struct {
  vs_vec3 *at; /* positions of nodes: the corners of the outline, then the other nodes; z is the time at which the front
                * reaches the node */
  size_t count, room;
  uint32_t *corner; /* numbers of nodes, the corners of all faces */
  size_t corner_count, corner_room;
  vs_skeleton_face *face; /* faces in the order of the outline's edges; an edge may have no face */
  size_t face_count, face_room;
} vs_skeleton;

typedef enum {
  VS_SKELETON_DONE,
  VS_SKELETON_CROSSES, /* two edges of the outline cross or touch, or an edge has no length; where[] are the edges'
                        * indices */
  VS_SKELETON_OPEN,    /* the edges' speeds are such that the moving edges never close the outline */
  VS_SKELETON_RING,    /* the face of an edge would enclose other faces, which only very different speeds cause */
  VS_SKELETON_FAILED,  /* the outline has details below the resolution of the numbers */
  VS_SKELETON_MEMORY,
  VS_SKELETON_STOPPED /* the callback work.going returned false */
} vs_skeleton_outcome;

/* Computes the faces of the straight skeleton. Their projections onto the plane cover the outline without overlaps. On
 * success the caller frees *out with vs_skeleton_free; otherwise *out is empty. where: indices of two edges, set if
 * they cross. */
vs_skeleton_outcome vs_skeleton_make(const vs_skeleton_outline *outline, vs_long_work work, vs_skeleton *out,
                                     size_t where[2]);
void vs_skeleton_free(vs_skeleton *s);

#endif
