/* Declares the type of measures: volume, area, length, centroid, and whether each is known. */
#ifndef VS_GEOMETRY_MEASURE_MEASURE_H
#define VS_GEOMETRY_MEASURE_MEASURE_H

#include "model/mesh.h"

typedef struct {
  bool known;      /* false: there is no formula; the caller must measure the mesh of kernel/ */
  double volume;   /* of a solid */
  double area;     /* of a solid's surface, or of a region */
  bool area_known; /* a non-uniformly scaled sphere has a known volume and an unknown area */
  double length;   /* of a curve */
  vs_vec3 centroid;
} vs_measure;

void vs_mesh_measure(const vs_mesh *mesh, vs_measure *out); /* measures a closed mesh */

#endif
