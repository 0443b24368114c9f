/* Owns how far two pictures are apart. */
#ifndef VS_GEOMETRY_PICTURES_PICTURE_DIFFERENCE_H
#define VS_GEOMETRY_PICTURES_PICTURE_DIFFERENCE_H

#include "geometry/pictures/tone.h"
#include "model/node.h"

typedef struct {
  double most, mean, root; /* of the differences of red, green and blue in linear light; root: of the mean of squares */
  size_t worst;            /* the pixel of the largest */
  double peak_ratio;       /* peak signal to noise, dB, where 1 is the peak; infinite: they are equal */
  double similarity;       /* structural similarity of the developed pictures: 1 is equal */
} vs_picture_gap;

/* Both have as many columns and rows. each: the mean difference of a pixel's three numbers goes there, where it is not
 * NULL. False: out of memory. */
bool vs_picture_measure_gap(vs_store *store, const vs_light *a, const vs_light *b, float *each,
                            vs_picture_gap *out, vs_error *e);

#endif
