/* Declares a scan (measured points): the points of a file, and the samples to which a model is fitted. */
#ifndef VS_GEOMETRY_FITTING_SCAN_POINTS_H
#define VS_GEOMETRY_FITTING_SCAN_POINTS_H

#include "geometry/files/meshfile.h"

typedef struct {
  vs_face_list file; /* points and faces of the file; coordinates of points without a position are NaN */
  vs_vec3 *samples;  /* Points to which the model is fitted, in a random order that is equal for equal files. They are
                      * the file's points; for a mesh, they are evenly distributed over its faces. */
  size_t sample_count;
  size_t nowhere; /* number of points in the file without a finite position */
} vs_scan_points;

/* Makes the scan of the points and faces in *file. *file is empty afterwards, also after a failure. least: least number
 * of samples of a mesh. Returns false when memory is out. */
bool vs_scan_points_take(vs_face_list *file, size_t least, vs_scan_points *out, vs_error *e);
void vs_scan_points_free(vs_scan_points *s);

#endif
