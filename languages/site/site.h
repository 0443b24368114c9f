/* Declares `vs doc`: the facts of an analysis as linked pages that a browser reads from disk. */
#ifndef VS_LANGUAGES_SITE_SITE_H
#define VS_LANGUAGES_SITE_SITE_H

#include "languages/analysis/analysis.h"

/* A function that writes a picture of the expression's value to the file `path`. expression NULL: a picture of the
 * whole model. It returns false if there is no picture. */
typedef bool know_picture(void *context, const char *expression, const char *path);

/* Writes the pages into an existing folder. picture may be NULL: the pages then have no pictures. Returns false if a
 * file cannot be written (k->trouble contains its name), or if memory is out. */
bool know_write_site(knowledge *k, const char *folder, const char *title, know_picture *picture, void *context);

#endif
