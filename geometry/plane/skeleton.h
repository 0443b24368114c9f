/* Declares the straight skeleton of closed outlines. Each edge of an outline moves inwards at its own speed; the strip
 * that it sweeps over is its face. With the time as height, the faces are a roof of planes. */
#ifndef VS_GEOMETRY_PLANE_SKELETON_H
#define VS_GEOMETRY_PLANE_SKELETON_H

#include "geometry/plane/ear_clipping.h"
#include "model/long_work.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Closed loops in a plane, in any order and direction. A loop inside an odd number of other loops is a hole. Edge k of
 * a loop goes from its corner k to the next corner. */
typedef struct {
  const vs_vec2 *at;
  const double *speed; /* speed[i]: speed with which the edge that begins at corner i moves inwards, as length for each
                        * unit of time, 0 or more */
  const size_t *size;  /* size[l]: number of corners of loop l, 3 or more */
  size_t loop_count;
} vs_skeleton_outline;

#define VS_SKELETON_STEP SIZE_MAX /* value of the member `edge` of a vertical face between the faces of two edges that
                                   * lie on one line and have different speeds */

/* A face: one loop of corners, counter-clockwise as seen from above. The face of an edge with speed 0 is vertical. If
 * two edges on one line have different speeds, a vertical face lies between their faces; its member `edge` is
 * VS_SKELETON_STEP. */
typedef struct {
  size_t edge;         /* index of the face's edge among the outline's edges, or VS_SKELETON_STEP */
  size_t first, count; /* the face's corners are corner[first] to corner[first + count - 1] */
} vs_skeleton_face;

typedef struct {
  vs_vec3 *at; /* positions of the nodes: first the corners of the outline, then the others; z is the time at which the
                * moving edges reach the node */
  size_t count, room;
  uint32_t *corner; /* corners of all faces, as numbers of nodes */
  size_t corner_count, corner_room;
  vs_skeleton_face *face; /* faces in the order of the outline's edges; an edge may have no face */
  size_t face_count, face_room;
} vs_skeleton;

typedef enum {
  VS_SKELETON_DONE,
  VS_SKELETON_CROSSES, /* two edges of the outline cross or touch, or an edge has no length; where[] are the edges'
                        * indices */
  VS_SKELETON_OPEN,    /* the edges' speeds are such that the moving edges never close the outline */
  VS_SKELETON_RING,    /* the face of an edge would surround other faces; only very different speeds cause this */
  VS_SKELETON_FAILED,  /* the outline has details that are too small for the accuracy of floating-point numbers */
  VS_SKELETON_MEMORY,
  VS_SKELETON_STOPPED /* the callback work.going returned false */
} vs_skeleton_outcome;

/* Computes the faces of the straight skeleton. As seen from above, they cover the outline without overlaps. On success
 * the caller frees *out with vs_skeleton_free; otherwise *out is empty. where: receives the indices of two edges if
 * these cross. */
vs_skeleton_outcome vs_skeleton_make(const vs_skeleton_outline *outline, vs_long_work work, vs_skeleton *out,
                                     size_t where[2]);
void vs_skeleton_free(vs_skeleton *s);

#endif
