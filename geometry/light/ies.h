/* Declares the luminous intensity of a lamp by direction, from its maker's file: IES LM-63. */
#ifndef VS_GEOMETRY_LIGHT_IES_H
#define VS_GEOMETRY_LIGHT_IES_H

#include "model/node.h"

/* Luminous intensity by direction: photometry of type C. Angles are in degrees and ascend. Vertical angles are 0
 * straight down and 180 straight up; horizontal ones count from the lamp's own first direction. */
typedef struct {
  double *at;                    /* vertical angles, horizontal angles, then candelas: a row for each horizontal
                                  * angle */
  size_t room;
  uint32_t verticals, horizontals;
  double most;                   /* the largest intensity, candelas */
  vs_store *store;               /* the owner of the memory */
} vs_ies;

/* Reads a file that is in memory: of 1986, 1991, 1995 or 2002, with TILT=NONE, photometry of type C. name: for
 * messages, without folders. Returns false if the file has another format or invalid values; the error has the line.
 * out needs no initialisation, and is empty after a failure. */
bool vs_ies_read(vs_store *store, const char *name, const char *text, size_t size, vs_ies *out, vs_error *e);
void vs_ies_free(vs_ies *ies);
/* Returns the intensity in a direction, interpolated linearly between the file's angles; 0 outside their range.
 * Symmetries are the file's: by a quarter, a half, or a full turn. */
double vs_ies_candelas(const vs_ies *ies, double vertical, double horizontal);

#endif
