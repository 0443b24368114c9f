/* Declares step 2 of a fit, for use in fitting/ alone: it fits all unknowns, starting from the best places of the
 * scan. */
#ifndef VS_GEOMETRY_FITTING_FIT_CANDIDATES_H
#define VS_GEOMETRY_FITTING_FIT_CANDIDATES_H

#include "geometry/fitting/fit_places.h"

/* A candidate: the values of the unknowns after a fit from one start. */
typedef struct {
  vs_rigid_motion motion;
  double unknowns[VS_FIT_UNKNOWNS_MOST + VS_RIGID_UNKNOWNS], cost, spread;
  float distances[VS_FIT_FIRST / 2];
  size_t known; /* number of the scan's points whose distances from this candidate's model were computed */
  bool core;
} vs_fit_candidate;

/* Fits all unknowns, starting from each of `count` places of the scan. *second: best result with clearly different
 * numbers; its cost is INFINITY if there is none. Returns false on failure; an interruption is no failure. */
bool vs_fit_from_places(vs_fit_search *f, const vs_fit_place *places, size_t count, vs_fit_candidate *best,
                        vs_fit_candidate *second);

#endif
