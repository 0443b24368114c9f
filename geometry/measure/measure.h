/* Declares the type of measures: volume, area, length, centroid, and whether each is known. */
#ifndef VS_GEOMETRY_MEASURE_MEASURE_H
#define VS_GEOMETRY_MEASURE_MEASURE_H

#include "model/mesh.h"

typedef struct {
  bool known;      /* false if there is no formula; the caller must then measure the kernel's mesh */
  double volume;   /* volume of a solid */
  double area;     /* area of a solid's surface, or of a region */
  bool area_known; /* false if there is a formula for the volume but none for the area, as for a sphere with different
                    * scales along its axes */
  double length;   /* length of a curve */
  vs_vec3 centroid;
} vs_measure;

void vs_mesh_measure(const vs_mesh *mesh, vs_measure *out); /* measures a closed mesh */

#endif
