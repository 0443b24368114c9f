/* Implements the use of OpenEXR's C library by the reader and the writer of EXR files. */
#include "geometry/files/exr_library.h"

static const char *const exr_files[] = { "libOpenEXRCore-3_1.so.30", "libOpenEXRCore-3_2.so.31", "libOpenEXRCore.so",
    NULL };
const vs_dynamic_library vs_exr_library = { exr_files, "libopenexr-3-1-30", "EXR pictures" };

void vs_exr_quiet(exr_const_context_t c, exr_result_t code, const char *message) {
  (void)c, (void)code, (void)message;
}
