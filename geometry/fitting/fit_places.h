/* Owns, for fitting/ alone, step 1 of a fit: the places of the scan in the model from which step 2 starts. */
#ifndef VS_GEOMETRY_FITTING_FIT_PLACES_H
#define VS_GEOMETRY_FITTING_FIT_PLACES_H

#include "geometry/fitting/fit_unknowns.h"

enum {
  VS_FIT_TRIED = 300,        /* points of step 1 */
  VS_FIT_STARTS_MOST = 10,   /* that step 2 goes on with */
  VS_FIT_PLACES_TRIED = 245  /* at once */
};

typedef struct {
  vs_rigid_motion motion;
  double cost; /* mean size of the distances, none above a tenth of the scan's size */
  bool scaled; /* the model has its numbers by the scan's size, vs_fit_search.begin[1] */
  bool core;   /* it was found by the core */
  float distances[VS_FIT_TRIED];
} vs_fit_place;

/* Fills the core of the scan: its points without strays. */
void vs_fit_find_core(vs_fit_search *f);
/* Step 1 by the points that are taken, with the numbers as they are and by the scan's size: adds the best of both,
 * improved. places: room for VS_FIT_PLACES_TRIED behind the VS_FIT_STARTS_MOST. False: failed. */
bool vs_fit_find_starts(vs_fit_search *f, vs_fit_place *places, size_t *count);

#endif
