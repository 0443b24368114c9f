/* Declares, for use in fitting/ alone, step 1 of a fit: the places of the scan in the model from which step 2 starts. */
#ifndef VS_GEOMETRY_FITTING_FIT_PLACES_H
#define VS_GEOMETRY_FITTING_FIT_PLACES_H

#include "geometry/fitting/fit_unknowns.h"

enum {
  VS_FIT_TRIED = 300,        /* points of step 1 */
  VS_FIT_STARTS_MOST = 10,   /* places from which step 2 starts */
  VS_FIT_PLACES_TRIED = 245  /* places tried at once */
};

typedef struct {
  vs_rigid_motion motion;
  double cost; /* mean size of the distances, each at most a tenth of the scan's size */
  bool scaled; /* the model has scaled numbers, vs_fit_search.begin[1] */
  bool core;   /* found by the core */
  float distances[VS_FIT_TRIED];
} vs_fit_place;

/* Finds the core of the scan: its points without strays. */
void vs_fit_find_core(vs_fit_search *f);
/* Runs step 1 with the current points, with the numbers unchanged and with the numbers scaled by the scan's size: adds
 * the best of both, improved. places: room for VS_FIT_PLACES_TRIED after the VS_FIT_STARTS_MOST. Returns false on
 * failure. */
bool vs_fit_find_starts(vs_fit_search *f, vs_fit_place *places, size_t *count);

#endif
