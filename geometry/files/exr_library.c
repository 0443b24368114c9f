/* Implements the use of OpenEXR's C library by the reader and the writer of EXR files. */
#include "geometry/files/exr_library.h"

void vs_exr_quiet(exr_const_context_t c, exr_result_t code, const char *message) {
  (void)c, (void)code, (void)message;
}
