/* Declares the luminous intensity of a lamp in each direction, read from its maker's file: IES LM-63. */
#ifndef VS_GEOMETRY_LIGHT_IES_H
#define VS_GEOMETRY_LIGHT_IES_H

#include "model/node.h"

/* Luminous intensity of a lamp by direction (photometry of type C). Angles are in degrees and ascend. Vertical angles
 * are 0 straight down and 180 straight up. Horizontal angles count from the lamp's zero direction. */
typedef struct {
  double *at;                    /* all numbers in one array: the vertical angles, then the horizontal angles, then the
                                  * intensities in candelas, one row of vertical angles for each horizontal angle */
  size_t room;
  uint32_t verticals, horizontals;
  double most;                   /* greatest intensity of the lamp in any direction, in candelas */
  vs_store *store;               /* store whose memory `at` uses */
} vs_ies;

/* Reads an IES file (light of a lamp) that is in memory, with TILT=NONE and photometry of type C. Returns false if the
 * file has another format or invalid values. out needs no initialisation, and is empty after a failure. */
bool vs_ies_read(vs_store *store, const char *name, const char *text, size_t size, vs_ies *out, vs_error *e);
void vs_ies_free(vs_ies *ies);
/* Returns the intensity in candelas in the direction with the given angles in degrees. Interpolates linearly between
 * the file's angles. Outside their range, the intensity is 0. Symmetry extends a file for a quarter or half turn. */
double vs_ies_candelas(const vs_ies *ies, double vertical, double horizontal);

#endif
