/* Declares the reading of Radiance pictures (.hdr), a common format for panoramas of the sky. */
#ifndef VS_GEOMETRY_LIGHT_RADIANCE_H
#define VS_GEOMETRY_LIGHT_RADIANCE_H

#include "geometry/files/exr.h"

/* Reads a Radiance file that is in memory into the channels R, G and B of out. Returns false on an error. out needs no
 * initialisation, and is empty after a failure. */
bool vs_radiance_read(vs_store *store, const vs_file_bytes *file, vs_exr *out, vs_error *e);

#endif
