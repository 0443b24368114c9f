/* Declares the comparison of parts that lie at different places: whether one part, moved and turned, equals another. */
#ifndef VS_GEOMETRY_MEASURE_PART_SHAPE_H
#define VS_GEOMETRY_MEASURE_PART_SHAPE_H

#include "model/mesh.h"

/* The shape of a part, apart from its place. */
typedef struct {
  int dimension;       /* 3: a solid; 2: a region or a surface; 1: a curve */
  double measure;      /* volume, area or length */
  double spread[3];    /* invariants of the matrix of second moments about the centroid, per unit of measure */
  double lean;         /* square of the length of the vector of third moments, per unit of measure */
  vs_vec3 *corners;    /* corners relative to the centroid, the nearest first */
  size_t count;        /* number of corners */
} vs_part_shape;

/* Computes the shape of a closed mesh (solid), or of a surface. A part without extent has the measure 0. Returns false
 * when memory is out. The caller frees *out in both cases. */
bool vs_part_shape_of_mesh(const vs_mesh *m, bool solid, vs_part_shape *out);
/* Computes the shape of a line through n points. As above. */
bool vs_part_shape_of_line(const vs_vec3 *at, size_t n, bool closed, vs_part_shape *out);
void vs_part_shape_free(vs_part_shape *s);

/* Returns true if a motion makes the parts equal, up to `tolerance` times their size. A part and its mirror image are
 * equal only if a motion turns one into the other. Parts whose corners do not correspond, such as two meshes of a
 * curved part, are equal if their moments are. */
bool vs_part_shapes_equal(const vs_part_shape *a, const vs_part_shape *b, double tolerance);

/* A box around a part: unit vectors along its edges, and the lengths of these, the longest first. */
typedef struct { vs_vec3 axes[3]; double size[3]; } vs_part_box;

/* Finds the smallest of these boxes around the mesh: those with a side along one of its 12 largest planes, and an edge
 * along one of 12 edges there; and the box along the unit vectors `own`. A mesh without triangles has a box of size
 * 0. */
void vs_mesh_smallest_box(const vs_mesh *m, const vs_vec3 own[3], vs_part_box *out);

#endif
