/* Declares the type of measures: volume, area, length, centroid, and whether each is known. */
#ifndef VS_GEOMETRY_MEASURE_MEASURE_H
#define VS_GEOMETRY_MEASURE_MEASURE_H

#include "model/mesh.h"

typedef struct {
  bool known;      /* true if the measures are known by a formula; if false, the caller must measure the kernel's
                    * mesh */
  double volume;   /* volume of a solid, in cubic model units */
  double area;     /* area of a solid's surface, or of a region, in square model units */
  bool area_known; /* true if `area` is known; false if only the volume has a formula, as for a sphere with different
                    * scales along its axes */
  double length;   /* length of a curve, in model units */
  vs_vec3 centroid;
} vs_measure;

void vs_mesh_measure(const vs_mesh *mesh, vs_measure *out); /* computes the volume, area and centroid of a closed
                                                             * mesh */

#endif
