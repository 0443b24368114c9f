/* Computes data once for each distinct mesh, for any number of leaves with that mesh: the pairs of edges, and the data
 * for a quick test whether a place is inside. */
#ifndef VS_KERNEL_DISTINCT_MESHES_H
#define VS_KERNEL_DISTINCT_MESHES_H

#include "kernel/problem.h"
#include "kernel/exact/interned.h"

typedef struct {
  const vs_mesh *mesh;
  uint32_t *twins;      /* twins[3 * t + j]: number of the corner whose edge runs opposite to edge j of triangle t; NULL
                         * if the mesh is closed only after rounding to the grid */
  size_t twin_room;
  double volume;        /* volume of the mesh, in cubic units of its coordinates; negative if the mesh is inside out */
  vs_vec3 middle;       /* mean of the mesh's vertices */
  bool star;            /* true if every ray from the middle crosses the surface exactly once, from inside to outside;
                         * such a mesh does not intersect itself */
  bool convex;          /* true if the part is convex up to rounding errors; set only if the part is a star and a leaf
                         * with this mesh touches another leaf */
  uint32_t *starts;     /* For a convex part: starts[i] is a triangle near the one that a ray from the middle crosses,
                         * if the ray's direction lies in cell i. Cells divide the sides of a cube around the part. */
  size_t start_room;
  uint32_t start_cells; /* number of cells along an edge of the cube to which `starts` refers; 0: the part has so few
                         * triangles that a search may begin at any triangle */
  double inner, outer;  /* for convex parts: radius of the largest ball about `middle` that lies inside the part, and of
                         * the smallest ball about it that contains the part */
  /* For a part that is not a star: VS_GOOD if the kernel may copy it unchanged where no other leaf touches it,
   * VS_DOUBTFUL if not, VS_UNASKED before the part is inspected. */
  enum { VS_UNASKED, VS_GOOD, VS_DOUBTFUL } alone;
  bool joined;          /* true if a leaf with this mesh touches another leaf. If it is false for a star, the kernel
                         * copies the mesh unchanged and does not set `twins` and `convex`. */
} vs_part;

typedef struct {
  VS_LIST(vs_part) all;
  VS_LIST(uint32_t) of_leaf;
} vs_parts;

/* Finds the distinct meshes of the problem and prepares data for each. order: numbers of the leaves, sorted by cluster;
 * cluster[i]: cluster of leaf order[i]. Returns false when memory is out or the caller interrupts. */
bool vs_parts_prepare(vs_kernel *k, vs_parts *p, const vs_kernel_problem *problem, const uint32_t *order,
                      const uint32_t *cluster, uint32_t count);
void vs_parts_free(vs_kernel *k, vs_parts *p);

/* The input of vs_twins_find: a list of triangles in which the function finds pairs of edges with opposite
 * directions. */
typedef struct {
  const uint32_t (*triangles)[3];
  size_t count;
  const uint32_t *id;   /* id[v]: number of the corner at vertex v; vertices with equal numbers are one corner; NULL:
                         * each vertex is a separate corner */
  size_t id_count;      /* number that exceeds all values of id */
} vs_twins_input;

/* Sets twins[3 * t + j] to the edge opposite to edge j of triangle t, or to VS_NONE if there is no such edge. *open: a
 * triangle with an edge that has no opposite edge, or VS_NONE. Returns false when memory is out or the caller
 * interrupts. */
bool vs_twins_find(vs_kernel *k, const vs_twins_input *in, uint32_t *twins, uint32_t *open);

/* Returns true if q is inside the convex part and farther than `margin` from its surface. May return false for a place
 * that is inside. margin: at least 0, in the part's coordinates. */
bool vs_part_holds(const vs_part *p, vs_vec3 q, double margin);

#endif
