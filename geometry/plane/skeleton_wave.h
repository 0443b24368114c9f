/* Declares the wave front of a straight skeleton, for skeleton.c alone: the outline while its edges move inwards. */
#ifndef VS_GEOMETRY_PLANE_SKELETON_WAVE_H
#define VS_GEOMETRY_PLANE_SKELETON_WAVE_H

#include "geometry/plane/skeleton.h"

typedef struct { long double x, y; } vs_wave_point;

/* A line that moves to its left. At each time, its points p fulfil normal . p = offset + speed * time. along, normal:
 * unit vectors. */
typedef struct {
  vs_wave_point along, normal;
  long double offset, speed;
} vs_wave_line;

/* A segment of the front. Its start is a vertex whose position at each time is at + time * way. Its end is the start of
 * the next segment. */
typedef struct {
  uint32_t line, last, next; /* line: number of the segment's moving line; last, next: indices of the segments before
                              * and after it */
  uint32_t born;             /* node of the skeleton from which the vertex started */
  vs_wave_point at, way;
} vs_wave_segment;

typedef struct {
  vs_wave_point at;
  long double time;
} vs_wave_node;

/* A half-edge: an edge of the face that belongs to `line`, from node to node. The face is on its left. */
typedef struct { uint32_t line, from, to; } vs_wave_half;

typedef struct {
  vs_wave_line *line;
  size_t line_count, line_room;
  vs_wave_segment *segment;
  size_t count, room;
  vs_wave_node *node;
  size_t node_count, node_room;
  vs_wave_half *half;
  size_t half_count, half_room;
  long double time, least; /* time: present time of the front; least: distance within which points coincide */
  struct vs_wave_work *work;
} vs_wave;

/* Moves the front until it vanishes, and records the borders of all faces. For each edge i of the outline, line[i] is
 * its moving line, node[i] its start node, and next[i] the edge after it. */
vs_skeleton_outcome vs_wave_run(vs_wave *w, const uint32_t *next, vs_long_work going);
void vs_wave_free(vs_wave *w);

bool vs_wave_half_add(vs_wave *w, uint32_t line, uint32_t from, uint32_t to); /* adds a half-edge between two nodes to
                                                                               * the border of the face that belongs to
                                                                               * `line`; returns false when memory is
                                                                               * out */

static inline long double vs_wave_dot(vs_wave_point a, vs_wave_point b) { return a.x * b.x + a.y * b.y; }
static inline long double vs_wave_cross(vs_wave_point a, vs_wave_point b) { return a.x * b.y - a.y * b.x; }
static inline vs_wave_point vs_wave_sub(vs_wave_point a, vs_wave_point b) {
  return (vs_wave_point){ a.x - b.x, a.y - b.y };
}

/* Returns the angle, in radians, on the left side of a path that arrives in direction `in` and leaves in direction
 * `out`: above 0, and at most two pi. */
long double vs_wave_turn(vs_wave_point in, vs_wave_point out);

#endif
