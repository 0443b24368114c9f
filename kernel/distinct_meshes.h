/* Owns the facts that the kernel computes once for each distinct mesh, for any number of leaves with that mesh: the
 * pairs of edges, and the data for quick tests if a place is inside. */
#ifndef VS_KERNEL_DISTINCT_MESHES_H
#define VS_KERNEL_DISTINCT_MESHES_H

#include "kernel/problem.h"
#include "kernel/exact/interned.h"

typedef struct {
  const vs_mesh *mesh;
  uint32_t *twins;      /* twins[3 * t + j]: the corner whose edge runs the other way; NULL if the mesh is closed only
                         * on the grid */
  size_t twin_room;
  double volume;        /* signed */
  vs_vec3 middle;       /* the mean of the corners */
  bool star;            /* seen from the middle, the surface is seen from inside, each direction once: it does not
                         * intersect itself */
  bool convex;          /* a star that is convex up to rounding; only known if joined */
  uint32_t *starts;     /* convex parts: a triangle at or near each of some directions from the middle, by cells of a
                         * cube's sides; see distinct_meshes.c */
  size_t start_room;
  uint32_t start_cells; /* number of cells along an edge of the cube; 0: the part has so few triangles that a walk may
                         * begin at any */
  double inner, outer;  /* convex parts: radii of a ball inside and of a ball around the part, about the middle */
  /* for a part that is no star: whether it can be copied unchanged where nothing touches it */
  enum { VS_UNASKED, VS_GOOD, VS_DOUBTFUL } alone;
  bool joined;          /* a leaf of it touches another; a star that is not joined has no twins, and its convexity is
                         * unknown: it is copied unchanged */
} vs_part;

typedef struct {
  VS_LIST(vs_part) all;
  VS_LIST(uint32_t) of_leaf;
} vs_parts;

/* order: leaves by cluster; cluster: beside it, the cluster of each; count: of both. */
bool vs_parts_prepare(vs_kernel *k, vs_parts *p, const vs_kernel_problem *problem, const uint32_t *order,
                      const uint32_t *cluster, uint32_t count);
void vs_parts_free(vs_kernel *k, vs_parts *p);

/* Triangles whose edges are to be paired. */
typedef struct {
  const uint32_t (*triangles)[3];
  size_t count;
  const uint32_t *id;   /* id[v]: number of vertex v; vertices with equal numbers are one corner. NULL: the vertex
                         * itself */
  size_t id_count;      /* all numbers are less */
} vs_twins_input;

/* Fills twins, 3 for each triangle; an edge between corners of one number has no twin: VS_NONE. *open: a triangle with
 * an edge without a twin, else VS_NONE. */
bool vs_twins_find(vs_kernel *k, const vs_twins_input *in, uint32_t *twins, uint32_t *open);

/* Returns true if q is inside a convex part, further than margin from its surface. May return false even if it is.
 * margin is 0 or more. */
bool vs_part_holds(const vs_part *p, vs_vec3 q, double margin);

#endif
