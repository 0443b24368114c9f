/* Declares the reading of PLY files. */
#ifndef VS_GEOMETRY_FILES_PLY_H
#define VS_GEOMETRY_FILES_PLY_H

#include "geometry/files/byte_scan.h"
#include "geometry/files/meshfile.h"

bool vs_ply_read(vs_byte_scan *s, vs_face_list *out);

#endif
