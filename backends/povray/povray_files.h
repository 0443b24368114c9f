/* Declares the files that a scene for POV-Ray names. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_FILES_H
#define VS_BACKENDS_POVRAY_POVRAY_FILES_H

#include "backends/backend.h"

/* Puts out the format and the name of a picture: of its copy in the worker's folder, or where there is none of the
 * picture itself. number: tells the copies apart. */
bool vs_povray_put_picture(vs_emitter *e, const vs_picture *p, size_t number);

#endif
