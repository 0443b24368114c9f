/* Declares measures of the difference of two pictures. */
#ifndef VS_GEOMETRY_PICTURES_PICTURE_DIFFERENCE_H
#define VS_GEOMETRY_PICTURES_PICTURE_DIFFERENCE_H

#include "geometry/pictures/tone.h"
#include "model/node.h"

typedef struct {
  double most, mean, root; /* differences in linear light, over all pixels and colour components: the largest, the mean,
                            * and the root mean square */
  size_t worst;            /* index of the pixel at which the two pictures differ most */
  double peak_ratio;       /* peak signal-to-noise ratio in dB, for a peak of 1; INFINITY if the pictures are equal */
  double similarity;       /* structural similarity of the developed pictures; 1 if they are equal */
} vs_picture_gap;

/* Measures the difference of the pictures a and b, which have equal sizes. each[i]: receives the mean difference of
 * pixel i's three colour components; `each` may be NULL. Returns false when memory is out. */
bool vs_picture_measure_gap(vs_store *store, const vs_light *a, const vs_light *b, float *each,
                            vs_picture_gap *out, vs_error *e);

#endif
