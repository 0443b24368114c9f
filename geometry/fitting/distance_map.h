/* Declares the map of distances: the scan with a colour at each point, as .ply and .x3d. */
#ifndef VS_GEOMETRY_FITTING_DISTANCE_MAP_H
#define VS_GEOMETRY_FITTING_DISTANCE_MAP_H

#include "geometry/files/meshfile.h"

typedef struct {
  const vs_face_list *scan;
  const double *distances; /* distances[i]: of point i; NaN: the point has no position and is omitted */
  double range;            /* > 0: colours go from blue at -range through pale grey at 0 to red at range */
  const char *units;
} vs_distance_map;

typedef bool vs_map_write(void *context, const char *text, size_t length);

/* Writes the map as PLY; omits faces with an omitted point. Returns false if `write` did. The map's range is above
 * 0. */
bool vs_distance_map_ply(const vs_distance_map *m, vs_map_write *write, void *context);
/* Writes the map as X3D. Returns false if `write` did. The map's range is above 0. */
bool vs_distance_map_x3d(const vs_distance_map *m, vs_map_write *write, void *context);

/* Sets the colour of a distance, in shares of the range; each component is 0 to 1. */
void vs_distance_colour(double share, double rgb[3]);

#endif
