/* Declares the comparison of parts in different places: whether a motion makes one part equal to another. */
#ifndef VS_GEOMETRY_MEASURE_PART_SHAPE_H
#define VS_GEOMETRY_MEASURE_PART_SHAPE_H

#include "model/mesh.h"

/* The shape of a part, independent of its position and orientation. */
typedef struct {
  int dimension;       /* 3 for a solid, 2 for a region or a surface, 1 for a curve */
  double measure;      /* volume of a solid, area of a surface or region, or length of a curve */
  double spread[3];    /* invariants of the matrix of second moments about the centroid, per unit of measure */
  double lean;         /* square of the length of the vector of third moments, per unit of measure */
  vs_vec3 *corners;    /* corners relative to the centroid, the nearest first */
  vs_vec3 *along;      /* the corners in the order of their heights along a fixed direction (part_shape.c) */
  size_t count;        /* number of corners */
} vs_part_shape;

/* Computes the shape of a closed mesh (solid), or of a surface. A part without extent has the measure 0. Returns false
 * when memory is out. The caller frees *out in both cases. */
bool vs_part_shape_of_mesh(const vs_mesh *m, bool solid, vs_part_shape *out);
/* Computes the shape of the polyline through n points. Returns false when memory is out. The caller frees *out in both
 * cases. */
bool vs_part_shape_of_line(const vs_vec3 *at, size_t n, bool closed, vs_part_shape *out);
void vs_part_shape_free(vs_part_shape *s);

/* Returns true if a motion makes the two parts equal, within `tolerance` times their size. If the corners do not
 * correspond, as in two meshes of one curved part, compares only moments. */
bool vs_part_shapes_equal(const vs_part_shape *a, const vs_part_shape *b, double tolerance);

/* A box around a part. axes: unit vectors along its edges; size: lengths of these edges; the longest edge comes
 * first. */
typedef struct { vs_vec3 axes[3]; double size[3]; } vs_part_box;

/* Finds a small box around the mesh: the smallest of some with a side in a large plane of the mesh, and of the box with
 * edges along the unit vectors `own`. A mesh without triangles has a box of size 0. */
void vs_mesh_smallest_box(const vs_mesh *m, const vs_vec3 own[3], vs_part_box *out);

#endif
