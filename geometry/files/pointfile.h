/* Declares the reading of clouds of points: .xyz files (text), .las files (binary), and .ply files. */
#ifndef VS_GEOMETRY_FILES_POINTFILE_H
#define VS_GEOMETRY_FILES_POINTFILE_H

#include "geometry/files/meshfile.h"

/* Returns true if the name ends in .xyz, .txt, .csv, .las or .ply. */
bool vs_point_file_is(const char *name);
/* Reads the points of a file that is in memory; the ending of its name determines the format. *out is empty at the
 * call. The caller frees it, also after a failure. */
bool vs_point_file_read(const vs_file_bytes *file, vs_poller poll, vs_face_list *out, vs_error *e);

#endif
