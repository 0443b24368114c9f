/* Owns the map of distances: the scan with a colour at each point, as .ply and .x3d. */
#ifndef VS_GEOMETRY_FITTING_DISTANCE_MAP_H
#define VS_GEOMETRY_FITTING_DISTANCE_MAP_H

#include "geometry/files/meshfile.h"

typedef struct {
  const vs_face_list *scan;
  const double *distances; /* of its points; NaN: nowhere, left out */
  double range;            /* > 0: colours run from blue at -range over pale grey at 0 to red at range */
  const char *units;
} vs_distance_map;

typedef bool vs_map_write(void *context, const char *text, size_t length);

/* False: write said so. Faces that lack a point are left out. The map's range is above 0. */
bool vs_distance_map_ply(const vs_distance_map *m, vs_map_write *write, void *context);
/* The map's range is above 0. */
bool vs_distance_map_x3d(const vs_distance_map *m, vs_map_write *write, void *context);

/* The colour of a distance, 0 to 1 each. */
void vs_distance_colour(double share, double rgb[3]);

#endif
