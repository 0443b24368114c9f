/* Declares, for use in fitting/ alone, the state of a fit: its unknowns, and the distances of the points for given
 * unknowns. */
#ifndef VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H
#define VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H

#include "geometry/fitting/model_fit.h"
#include "geometry/fitting/robust_squares.h"

enum {
  VS_FIT_UNKNOWNS_MOST = 200,
  VS_FIT_FIRST = 1000 /* number of scan points in step 2 of the fit */
};
#define VS_FIT_UPRIGHT .7 /* cosine of the largest angle between the upward directions of scan and model */

/* ---- conversion of a model's number to an unknown without bounds ---- */

double vs_fit_number_scale(const vs_fit_number *n); /* returns the scale of number n, the unit in which its changes are
                                                     * measured */
double vs_fit_number_outer(const vs_fit_number *n, double unknown); /* returns the value of number n that belongs to an
                                                                     * unknown of the solver */
double vs_fit_number_inner(const vs_fit_number *n, double number);  /* returns the solver's unknown that belongs to a
                                                                     * value of number n */

/* ---- the state of a fit ---- */

typedef struct {
  const vs_fit_problem *p;
  vs_model_fit *out;
  vs_error *e;
  size_t numbers, unknowns; /* numbers: count of the model's numbers; unknowns: count of all unknowns, including the six
                             * of the motion */
  double diagonal;          /* diagonal of the model's bounding box at the start of the fit */
  double tolerance;         /* facet tolerance of the model's mesh in the current step of the fit */
  vs_rigid_motion motion;   /* rigid motion of the scan when the six unknowns of the motion are 0 */
  size_t count;             /* number of scan points in the current step of the fit */
  bool failed;              /* true after an error that does not come from the numbers of the model */
  vs_vec3 *core;            /* points of the scan without stray points, in the order of the scan */
  size_t core_count;
  const vs_vec3 *points;    /* points used in the current step of the fit: all points of the scan, or the core */
  size_t point_count;
  bool level;               /* true if the fit rotates the scan only about the vertical axis */
  /* The members below describe the distances that were computed last, and the unknowns to which they belong. */
  vs_mesh_distance *field;
  double *at, *made_at, *trial; /* at: unknowns for which the distances were computed; made_at: the model's numbers from
                                 * which `field` was made; trial: numbers to test */
  bool known;
  double *begin[2]; /* start numbers: [0] the caller's, [1] scaled by the ratio of the scan's size to the model's */
  vs_vec3 *places, *slopes;
  double *distances, *other;
} vs_fit_search;

/* Calls the caller's function `going`. If `going` returns false for the first time, returns false. Afterwards it
 * returns true, because the remaining work is small and is completed. */
bool vs_fit_going(vs_fit_search *f);
/* Selects the points of the current step of the fit: the core if `core` is true, else all points of the scan. */
void vs_fit_take_points(vs_fit_search *f, bool core);

/* ---- distances of points from the model ---- */

/* Makes *out, the field of distances from the model with these numbers. Returns false when interrupted or failed, or if
 * the numbers do not make a solid; *refused is true in the last case. */
bool vs_fit_make_field(vs_fit_search *f, const double *numbers, vs_mesh_distance **out, bool *refused);
/* Computes the distances of the points at f->places from the model, and their gradients (slopes, may be NULL), by a
 * field of distances. Returns false when interrupted. */
bool vs_fit_measure(vs_fit_search *f, const vs_mesh_distance *field, double *distances, vs_vec3 *slopes);
void vs_fit_numbers_at(const vs_fit_search *f, const double *unknowns, double *out);
/* Computes the distances of the points and their derivatives for these unknowns. Returns false when interrupted or
 * failed, or if the unknowns do not make a solid; *refused is true in the last case. */
bool vs_fit_evaluate(vs_fit_search *f, const double *unknowns, bool *refused);
/* Returns the median of the absolute values of `count` distances. count is at least 1; scratch has room for count
 * elements. */
double vs_fit_median_size(const double *distances, size_t count, double *scratch);
/* Returns the spread of the last computed distances: 1.4826 times the median of their absolute values, and at least the
 * facets' tolerance. */
double vs_fit_spread(vs_fit_search *f);
int vs_fit_compare(const void *p, const void *q); /* compares two doubles, as qsort requires */

/* ---- derivatives: f->count elements for each unknown ---- */

/* Computes the derivatives of the distances by the six unknowns of the motion: the gradient of the distance times the
 * velocity of the point. */
void vs_fit_motion_slopes(const vs_fit_search *f, const double *unknowns, double *out);
/* Computes the derivatives of the distances by the model's number j, at the unknowns f->at. They are 0 if no number
 * nearby makes a solid. Returns false when interrupted or failed. */
bool vs_fit_number_slopes(vs_fit_search *f, size_t j, double *out);

/* ---- fitting ---- */

/* The effort of a fit: number of points, greatest number of rounds, and of evaluations in a round. A round ends when
 * the loss or the unknowns change by less than the fraction `tolerance`. */
typedef struct {
  size_t points;
  unsigned rounds, most;
  double tolerance;
} vs_fit_effort;

/* Fits all unknowns from their current values with Tukey's loss, in rounds; each round computes the spread of the
 * distances again. If there are at least three rounds, the first uses three times the spread, so that slightly
 * displaced parts have an influence. Returns false when interrupted or failed. */
bool vs_fit_improve(vs_fit_search *f, const vs_fit_effort *effort, double *unknowns);
/* Moves f->motion by the unknowns of the motion, and sets these unknowns to 0. */
void vs_fit_settle(vs_fit_search *f, double *unknowns);

#endif
