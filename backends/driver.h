/* Declares the driver, which writes a drawing by the functions of a back-end. */
#ifndef VS_BACKENDS_DRIVER_H
#define VS_BACKENDS_DRIVER_H

#include "backends/backend.h"

/* Writes the format's beginning, the templates, the drawing and the format's end. Returns false on failure; the error
 * of e or of its writer has the reason. Call vs_drive_free even after a failure. */
bool vs_drive_scene(vs_emitter *e);
void vs_drive_free(vs_emitter *e);

#endif
