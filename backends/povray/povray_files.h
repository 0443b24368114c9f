/* Owns the interface of povray_files.c: the files that a scene for POV-Ray names. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_FILES_H
#define VS_BACKENDS_POVRAY_POVRAY_FILES_H

#include "backends/backend.h"

/* Writes the format and the name of a picture: of its copy in the worker's folder, or, without a folder, of the picture
 * itself. number: distinguishes the copies. */
bool vs_povray_put_picture(vs_emitter *e, const vs_picture *p, size_t number);

#endif
