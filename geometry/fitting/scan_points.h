/* Owns a scan: the points of a file, and those by which it is fitted. */
#ifndef VS_GEOMETRY_FITTING_SCAN_POINTS_H
#define VS_GEOMETRY_FITTING_SCAN_POINTS_H

#include "geometry/files/meshfile.h"

typedef struct {
  vs_face_list file; /* as it was read; points that are nowhere have NaN */
  vs_vec3 *samples;  /* in random order, always the same for the same file: its points, or, of a mesh, places spread
                             evenly over its faces */
  size_t sample_count;
  size_t nowhere; /* points of the file without a finite place */
} vs_scan_points;

/* Takes over what was read, which is empty then, also after a failure. least: samples of a mesh. */
bool vs_scan_points_take(vs_face_list *file, size_t least, vs_scan_points *out, vs_error *e);
void vs_scan_points_free(vs_scan_points *s);

#endif
