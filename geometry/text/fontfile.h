/* Owns the interface of fontfile.c: the finding of font files. */
#ifndef VS_GEOMETRY_TEXT_FONTFILE_H
#define VS_GEOMETRY_TEXT_FONTFILE_H

#include "model/node.h"

/* The file of a family, or of the default font where the name is "". False: there is none, or no memory (then e says
 * so). */
bool vs_font_file(const char *family, char *path, size_t room, vs_error *e);
/* The families that there are, as "A, B, C ..." for messages; as many as fit. */
void vs_font_families(char *text, size_t room);

#endif
