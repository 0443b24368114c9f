/* Declares step 1 of a fit, for use in fitting/ alone: it finds the places of the scan in the model from which step 2
 * starts. */
#ifndef VS_GEOMETRY_FITTING_FIT_PLACES_H
#define VS_GEOMETRY_FITTING_FIT_PLACES_H

#include "geometry/fitting/fit_unknowns.h"

enum {
  VS_FIT_TRIED = 300,        /* number of the scan's points that step 1 of the fit uses */
  VS_FIT_STARTS_MOST = 10,   /* greatest number of places of the scan in the model from which step 2 of the fit
                              * starts */
  VS_FIT_PLACES_TRIED = 245  /* greatest number of places of the scan that are evaluated in one run of step 1 */
};

typedef struct {
  vs_rigid_motion motion;
  double cost; /* mean of the points' distances from the model, as absolute values that are limited to a tenth of the
                * scan's size */
  bool scaled; /* true if the place was found for the model with scaled start numbers, begin[1] of vs_fit_search */
  bool core;   /* true if the place was found with the core of the scan, without its stray points */
  float distances[VS_FIT_TRIED];
} vs_fit_place;

/* Finds the core of the scan: its points without stray points. Stores it in f->core. */
void vs_fit_find_core(vs_fit_search *f);
/* Finds the places of the scan from which step 2 starts, with the caller's start numbers and with numbers scaled by the
 * scan's size. Appends them to `places`, with room for VS_FIT_STARTS_MOST + VS_FIT_PLACES_TRIED elements. Returns false
 * on failure. */
bool vs_fit_find_starts(vs_fit_search *f, vs_fit_place *places, size_t *count);

#endif
