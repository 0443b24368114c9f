/* Declares the functions of fontfile.c: the search for font files. */
#ifndef VS_GEOMETRY_TEXT_FONTFILE_H
#define VS_GEOMETRY_TEXT_FONTFILE_H

#include "model/node.h"

/* Finds the file of a family, or of the default font if the name is "". Returns false if there is none, or memory is
 * out (then e is set). */
bool vs_font_file(const char *family, char *path, size_t room, vs_error *e);
/* Writes the available families as "A, B, C ..." for messages; as many as fit. */
void vs_font_families(char *text, size_t room);

#endif
