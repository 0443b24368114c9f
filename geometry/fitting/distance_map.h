/* Declares a map of distances: a scan (measured points) with a colour at each point, written as .ply and .x3d. */
#ifndef VS_GEOMETRY_FITTING_DISTANCE_MAP_H
#define VS_GEOMETRY_FITTING_DISTANCE_MAP_H

#include "geometry/files/meshfile.h"

typedef struct {
  const vs_face_list *scan;
  const double *distances; /* distances[i]: distance of point i from the model; NaN if point i has no position, and so
                            * is not in the map */
  double range;            /* distance at which the colour is red, above 0; colours go from blue at -range through pale
                            * grey at 0 to red at range */
  const char *units;
} vs_distance_map;

typedef bool vs_map_write(void *context, const char *text, size_t length);

/* Writes the map as a PLY file. Omits points without a position, and faces with such a point. m->range is above 0.
 * Returns false if `write` has returned false. */
bool vs_distance_map_ply(const vs_distance_map *m, vs_map_write *write, void *context);
/* Writes the map as an X3D file. m->range is above 0. Returns false if `write` has returned false. */
bool vs_distance_map_x3d(const vs_distance_map *m, vs_map_write *write, void *context);

/* Sets rgb to the colour of a distance; its components are 0 to 1. share: distance divided by the range of the map, -1
 * to 1. */
void vs_distance_colour(double share, double rgb[3]);

#endif
