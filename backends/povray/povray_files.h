/* Declares the references to files in a scene for POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_FILES_H
#define VS_BACKENDS_POVRAY_POVRAY_FILES_H

#include "backends/backend.h"

/* Writes the format and the file name of a picture. It is the name of its copy in the worker's folder, or of the
 * picture itself if there is no such folder. The parameter number distinguishes the copies of pictures. */
bool vs_povray_put_picture(vs_emitter *e, const vs_picture *p, size_t number);

#endif
