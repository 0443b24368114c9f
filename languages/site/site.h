/* Owns `vs doc`: what is known of a program as linked pages that a browser reads from disk. */
#ifndef VS_LANGUAGES_SITE_SITE_H
#define VS_LANGUAGES_SITE_SITE_H

#include "languages/analysis/analysis.h"

/* Writes a picture of what the expression gives to path; expression NULL: of the whole model. False: there is none. */
typedef bool know_picture(void *context, const char *expression, const char *path);

/* Writes the pages into the folder, which must be there. picture may be NULL: no pictures. False: a file cannot be
 * written (k->trouble says which), or out of memory. */
bool know_write_site(knowledge *k, const char *folder, const char *title, know_picture *picture, void *context);

#endif
