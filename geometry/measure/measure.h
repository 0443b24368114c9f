/* Owns the form of an answer about size: volume, area, length, centroid, and which of them are known. */
#ifndef VS_GEOMETRY_MEASURE_MEASURE_H
#define VS_GEOMETRY_MEASURE_MEASURE_H

#include "model/mesh.h"

typedef struct {
  bool known;      /* false: there is no formula; the mesh that kernel/ makes has to be measured */
  double volume;   /* of solids */
  double area;     /* of a solid's surface, of a region's content */
  bool area_known; /* an unevenly scaled sphere has a known volume and an unknown area */
  double length;   /* of curves */
  vs_vec3 centroid;
} vs_measure;

void vs_mesh_measure(const vs_mesh *mesh, vs_measure *out); /* of a closed mesh */

#endif
