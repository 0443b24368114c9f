/* Implements the setting of errors (model_error.h). */
#include "model/model_error.h"

#include <stdarg.h>
#include <stdio.h>

bool vs_error_set(vs_error *e, vs_error_kind kind, const vs_origin *origin, const char *format, ...) {
  if (!e) return false;
  e->kind = kind;
  e->origin = origin;
  va_list args;
  va_start(args, format);
  int length = vsnprintf(e->message, sizeof e->message, format, args);
  va_end(args);
  if (length >= (int)sizeof e->message) { /* a message that is too long is cut between two characters, not inside a
                                           * character */
    size_t end = sizeof e->message - 1, start = end;
    while (start > 0 && end - start < 4 && ((unsigned char)e->message[start - 1] & 0xC0) == 0x80) start--;
    if (start > 0 && (unsigned char)e->message[start - 1] >= 0xC0) {
      unsigned char lead = (unsigned char)e->message[start - 1];
      size_t need = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
      if (end - (start - 1) < need) e->message[start - 1] = '\0';
    }
  }
  return false;
}

bool vs_error_memory(vs_error *e, const vs_origin *origin) {
  return vs_error_set(e, VS_ERROR_MEMORY, origin, "out of memory");
}
