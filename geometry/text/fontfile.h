/* Declares the search for font files in the folders of the system and the user. */
#ifndef VS_GEOMETRY_TEXT_FONTFILE_H
#define VS_GEOMETRY_TEXT_FONTFILE_H

#include "model/node.h"

/* Finds the file of a font family, or of the default font if the name is "". Writes the file's path to `path`. Returns
 * false if there is no such file, or memory is out; e is set only in the second case. */
bool vs_font_file(const char *family, char *path, size_t room, vs_error *e);
/* Writes the names of the available font families to text, as "A, B, C ...", for messages. Omits names for which there
 * is no room. */
void vs_font_families(char *text, size_t room);

#endif
