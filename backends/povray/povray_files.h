/* Declares the references to files in a scene for POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_FILES_H
#define VS_BACKENDS_POVRAY_POVRAY_FILES_H

#include "backends/backend.h"

/* Writes the format and the file name of a picture. In a worker's folder, it is the name of the picture's copy there;
 * without such a folder, the name of the picture itself. number: distinguishes the copies of several pictures. */
bool vs_povray_put_picture(vs_emitter *e, const vs_picture *p, size_t number);

#endif
