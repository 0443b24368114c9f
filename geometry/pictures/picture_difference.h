/* Declares the difference of two pictures. */
#ifndef VS_GEOMETRY_PICTURES_PICTURE_DIFFERENCE_H
#define VS_GEOMETRY_PICTURES_PICTURE_DIFFERENCE_H

#include "geometry/pictures/tone.h"
#include "model/node.h"

typedef struct {
  double most, mean, root; /* of the differences of red, green and blue in linear light; root: root of the mean
                            * square */
  size_t worst;            /* the pixel with the largest difference */
  double peak_ratio;       /* peak signal-to-noise ratio, dB, for a peak of 1; infinite: the pictures are equal */
  double similarity;       /* structural similarity of the developed pictures; 1: equal */
} vs_picture_gap;

/* Measures the difference of two pictures of the same size. each (may be NULL) receives the mean difference of each
 * pixel's three numbers. Returns false when memory is out. */
bool vs_picture_measure_gap(vs_store *store, const vs_light *a, const vs_light *b, float *each,
                            vs_picture_gap *out, vs_error *e);

#endif
