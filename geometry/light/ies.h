/* Declares how much a lamp shines which way, by its maker's file: IES LM-63. */
#ifndef VS_GEOMETRY_LIGHT_IES_H
#define VS_GEOMETRY_LIGHT_IES_H

#include "model/node.h"

/* Luminous intensity by direction: photometry of type C. Angles are in degrees and ascend. The vertical one is 0
 * straight down and 180 straight up; the horizontal one is counted from the lamp's own first direction. */
typedef struct {
  double *at;                    /* vertical angles, horizontal angles, then candelas: a row a horizontal angle */
  size_t room;
  uint32_t verticals, horizontals;
  double most;                   /* candelas */
  vs_store *store;               /* whose memory it is */
} vs_ies;

/* Reads a file that is in memory: of 1986, 1991, 1995 or 2002, TILT=NONE, photometry of type C. name: for messages,
 * without folders. False: it is none, or says something that cannot be; the error has the line. out need not be
 * initialised and is empty after a failure. */
bool vs_ies_read(vs_store *store, const char *name, const char *text, size_t size, vs_ies *out, vs_error *e);
void vs_ies_free(vs_ies *ies);
/* The intensity in a direction, between the file's angles by proportion; 0 where the file has none. Symmetries are the
 * file's: by a quarter, a half, or all round. */
double vs_ies_candelas(const vs_ies *ies, double vertical, double horizontal);

#endif
