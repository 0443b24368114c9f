/* Declares, for use in fitting/ alone, step 2 of a fit: all unknowns from the best places. */
#ifndef VS_GEOMETRY_FITTING_FIT_CANDIDATES_H
#define VS_GEOMETRY_FITTING_FIT_CANDIDATES_H

#include "geometry/fitting/fit_places.h"

/* The unknowns to which a start has led. */
typedef struct {
  vs_rigid_motion motion;
  double unknowns[VS_FIT_UNKNOWNS_MOST + VS_RIGID_UNKNOWNS], cost, spread;
  float distances[VS_FIT_FIRST / 2];
  size_t known; /* number of distances */
  bool core;
} vs_fit_candidate;

/* Fits all unknowns from the places, a few iterations each; then the better half of those that differ, to convergence.
 * *second: the best with other numbers; its cost is INFINITY if there is none. Returns false on failure; a stop is no
 * failure. */
bool vs_fit_from_places(vs_fit_search *f, const vs_fit_place *places, size_t count, vs_fit_candidate *best,
                        vs_fit_candidate *second);

#endif
