/* Declares a scan: the points of a file, and the samples for its fit. */
#ifndef VS_GEOMETRY_FITTING_SCAN_POINTS_H
#define VS_GEOMETRY_FITTING_SCAN_POINTS_H

#include "geometry/files/meshfile.h"

typedef struct {
  vs_face_list file; /* as read; points without a position have NaN */
  vs_vec3 *samples;  /* in random order, always the same for the same file: its points, or, for a mesh, positions
                      * distributed evenly over its faces */
  size_t sample_count;
  size_t nowhere; /* points of the file without a finite position */
} vs_scan_points;

/* Takes over *file, which is empty afterwards, also after a failure. least: samples of a mesh. */
bool vs_scan_points_take(vs_face_list *file, size_t least, vs_scan_points *out, vs_error *e);
void vs_scan_points_free(vs_scan_points *s);

#endif
