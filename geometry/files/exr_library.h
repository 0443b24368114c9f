/* Declares how the reader and the writer of EXR files use OpenEXR's C library. */
#ifndef VS_GEOMETRY_FILES_EXR_LIBRARY_H
#define VS_GEOMETRY_FILES_EXR_LIBRARY_H

#include <openexr.h>

/* Receives and discards a message of the library, whose result codes contain the same information. */
void vs_exr_quiet(exr_const_context_t c, exr_result_t code, const char *message);

#endif
