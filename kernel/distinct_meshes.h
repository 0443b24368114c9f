/* Owns what is worked out once for each distinct mesh, however many leaves place it: which edges belong together, and
 * whether a place in it can be told quickly to be inside. */
#ifndef VS_KERNEL_DISTINCT_MESHES_H
#define VS_KERNEL_DISTINCT_MESHES_H

#include "kernel/problem.h"
#include "kernel/exact/interned.h"

typedef struct {
  const vs_mesh *mesh;
  uint32_t *twins;      /* of corner 3 * t + j: the corner whose edge runs the other way; NULL where the mesh closes
                         * only on the grid */
  size_t twin_room;
  double volume;        /* signed */
  vs_vec3 middle;       /* the mean of the corners */
  bool star;            /* the middle sees all of the surface from inside, each direction once: nothing crosses
                         * anything */
  bool convex;          /* star, and so but for rounding; where it is joined */
  uint32_t *starts;     /* convex: a triangle at or near each of some directions from the middle, by cells of a cube's
                         * sides; see distinct_meshes.c */
  size_t start_room;
  uint32_t start_cells; /* along a side's edge; 0: of so few triangles that any will do */
  double inner, outer;  /* convex: radii about the middle of a ball within and a ball without */
  /* of one that is no star: may it stand as it is where nothing touches it? */
  enum { VS_UNASKED, VS_GOOD, VS_DOUBTFUL } alone;
  bool joined;          /* a leaf of it touches another; a star that is not has no twins and does not know whether it is
                         * convex: it stands as it is */
} vs_part;

typedef struct {
  VS_LIST(vs_part) all;
  VS_LIST(uint32_t) of_leaf;
} vs_parts;

/* order: leaves by cluster, and cluster beside it, count of both. */
bool vs_parts_prepare(vs_kernel *k, vs_parts *p, const vs_kernel_problem *problem, const uint32_t *order,
                      const uint32_t *cluster, uint32_t count);
void vs_parts_free(vs_kernel *k, vs_parts *p);

/* Triangles whose edges are to be joined. */
typedef struct {
  const uint32_t (*triangles)[3];
  size_t count;
  const uint32_t *id;   /* of a corner's vertex: the number by which corners are one; NULL: that of the vertex */
  size_t id_count;      /* the numbers are below it */
} vs_twins_input;

/* Fills twins, 3 a triangle; an edge between corners of one number has no twin: VS_NONE. *open: a triangle whose edge
 * nothing answers, else VS_NONE. */
bool vs_twins_find(vs_kernel *k, const vs_twins_input *in, uint32_t *twins, uint32_t *open);

/* Is q inside a convex part, further than margin from its surface? May say no where it is. margin is 0 or more. */
bool vs_part_holds(const vs_part *p, vs_vec3 q, double margin);

#endif
