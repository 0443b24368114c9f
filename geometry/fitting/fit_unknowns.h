/* Declares the state of a fit, for use in fitting/ alone: its unknowns, and the distances of the points for given
 * unknowns. */
#ifndef VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H
#define VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H

#include "geometry/fitting/model_fit.h"
#include "geometry/fitting/robust_squares.h"

enum {
  VS_FIT_UNKNOWNS_MOST = 200,
  VS_FIT_FIRST = 1000 /* number of the scan's points that step 2 of the fit uses */
};
#define VS_FIT_UPRIGHT .7 /* cosine of the largest angle that is allowed between the upward directions of scan and
                           * model */

/* ---- conversion of a model's number to an unknown without bounds ---- */

double vs_fit_number_scale(const vs_fit_number *n); /* returns the scale of number n: the solver measures changes of the
                                                     * number in this unit */
double vs_fit_number_outer(const vs_fit_number *n, double unknown); /* returns the value of number n for a value of the
                                                                     * solver's unknown */
double vs_fit_number_inner(const vs_fit_number *n, double number);  /* returns the value of the solver's unknown for a
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
  bool failed;              /* true after an error other than that the model's numbers do not make a solid */
  vs_vec3 *core;            /* the core: points of the scan without stray points, in the order of the scan */
  size_t core_count;
  const vs_vec3 *points;    /* points used in the current step of the fit: all points of the scan, or the core */
  size_t point_count;
  bool level;               /* true if the fit rotates the scan only about the vertical axis */
  /* The members below belong to the latest computation of the points' distances from the model. */
  vs_mesh_distance *field;
  double *at, *made_at, *trial; /* at: unknowns for which the distances were computed; made_at: values of the model's
                                 * numbers for which `field` was made; trial: values of the numbers that are to be
                                 * tried */
  bool known;
  double *begin[2]; /* begin[0]: the caller's start numbers; begin[1]: these numbers, scaled by the ratio of the scan's
                     * size to the model's */
  vs_vec3 *places, *slopes;
  double *distances, *other;
} vs_fit_search;

/* Calls the caller's function `going`. Returns false when it returns false for the first time. Later calls return true
 * at once, so that the small rest of the work is completed. */
bool vs_fit_going(vs_fit_search *f);
/* Selects the points of the current step of the fit: the core if `core` is true, else all points of the scan. */
void vs_fit_take_points(vs_fit_search *f, bool core);

/* ---- distances of points from the model ---- */

/* Makes *out, the data for distances from the model with the given numbers. Returns false when interrupted or failed,
 * or if the numbers do not make a solid; only in the last case, *refused is true. */
bool vs_fit_make_field(vs_fit_search *f, const double *numbers, vs_mesh_distance **out, bool *refused);
/* Computes the distances of the points f->places from the model. field: data for distances from the model. slopes:
 * receives the gradients of the distances; may be NULL. Returns false when interrupted. */
bool vs_fit_measure(vs_fit_search *f, const vs_mesh_distance *field, double *distances, vs_vec3 *slopes);
void vs_fit_numbers_at(const vs_fit_search *f, const double *unknowns, double *out);
/* Computes the distances of the points, and their derivatives, for the given unknowns. Returns false when interrupted
 * or failed, or if the unknowns do not make a solid; only in the last case, *refused is true. */
bool vs_fit_evaluate(vs_fit_search *f, const double *unknowns, bool *refused);
/* Returns the median of the absolute values of `count` distances. count is at least 1; scratch is working memory for
 * count elements. */
double vs_fit_median_size(const double *distances, size_t count, double *scratch);
/* Returns the spread of the last computed distances: 1.4826 times the median of their absolute values, and at least the
 * facets' tolerance. */
double vs_fit_spread(vs_fit_search *f);
int vs_fit_compare(const void *p, const void *q); /* compares two doubles, as qsort requires */

/* ---- derivatives; an array has f->count elements for each unknown ---- */

/* Computes the derivatives of the distances by the six unknowns of the motion: the gradient of the distance times the
 * velocity of the point. */
void vs_fit_motion_slopes(const vs_fit_search *f, const double *unknowns, double *out);
/* Computes the derivatives of all distances by number j of the model, at the unknowns f->at. The derivatives are 0 if
 * no value near the number's makes a solid. Returns false when interrupted or failed. */
bool vs_fit_number_slopes(vs_fit_search *f, size_t j, double *out);

/* ---- fitting ---- */

/* How long to fit. `points`: number of points. `rounds`: greatest number of rounds. `most`: greatest number of
 * evaluations in a round. `tolerance`: a round ends when the loss or the unknowns change by less than this fraction. */
typedef struct {
  size_t points;
  unsigned rounds, most;
  double tolerance;
} vs_fit_effort;

/* Fits all unknowns, starting from the given values, with Tukey's loss. It works in rounds, each with a new spread
 * (usual size) of the distances. Returns false when interrupted or failed. */
bool vs_fit_improve(vs_fit_search *f, const vs_fit_effort *effort, double *unknowns);
/* Moves f->motion by the unknowns of the motion, and sets these unknowns to 0. */
void vs_fit_settle(vs_fit_search *f, double *unknowns);

#endif
