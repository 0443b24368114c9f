/* Declares, for use in fitting/ alone, the state of a fit: its unknowns, and the distances of the points at them. */
#ifndef VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H
#define VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H

#include "geometry/fitting/model_fit.h"
#include "geometry/fitting/robust_squares.h"

enum {
  VS_FIT_UNKNOWNS_MOST = 200,
  VS_FIT_FIRST = 1000 /* points of step 2 */
};
#define VS_FIT_UPRIGHT .7 /* cosine of the largest angle between the two up directions */

/* ---- a number of the model as an unknown without bounds ---- */

double vs_fit_number_scale(const vs_fit_number *n); /* returns the unit in which its changes are measured */
double vs_fit_number_outer(const vs_fit_number *n, double unknown); /* returns the number of an unknown */
double vs_fit_number_inner(const vs_fit_number *n, double number);  /* returns the unknown of a number */

/* ---- the state of a fit ---- */

typedef struct {
  const vs_fit_problem *p;
  vs_model_fit *out;
  vs_error *e;
  size_t numbers, unknowns; /* unknowns: including the motion's */
  double diagonal;          /* of the model at the start */
  double tolerance;         /* facet tolerance in this step */
  vs_rigid_motion motion;   /* the motion at unknowns of 0 */
  size_t count;             /* points in this step */
  bool failed;              /* by an error that does not come from the model */
  vs_vec3 *core;            /* points of the scan without strays, in the same order */
  size_t core_count;
  const vs_vec3 *points;    /* of this step: all, or the core */
  size_t point_count;
  bool level;               /* places rotate only about the vertical axis */
  /* the last computed distances and their unknowns */
  vs_mesh_distance *field;
  double *at, *made_at, *trial; /* unknowns of the distances; numbers of the field; numbers to be tried */
  bool known;
  double *begin[2]; /* numbers to start from: the caller's, and those scaled by the ratio of the scan's size to the
                     * model's */
  vs_vec3 *places, *slopes;
  double *distances, *other;
} vs_fit_search;

/* Asks the caller whether to continue. Returns false once, when it was just stopped. After that it returns true: the
 * remaining work is small, and is completed. */
bool vs_fit_going(vs_fit_search *f);
/* Selects the core, or all points. */
void vs_fit_take_points(vs_fit_search *f, bool core);

/* ---- distances ---- */

/* Makes the field of these numbers. Returns false when stopped, failed, or the numbers make no solid; in the last case
 * *refused is set. */
bool vs_fit_make_field(vs_fit_search *f, const double *numbers, vs_mesh_distance **out, bool *refused);
/* Measures the distances of the step's points, at f->places, from a field; slopes may be NULL. Returns false when
 * stopped. */
bool vs_fit_measure(vs_fit_search *f, const vs_mesh_distance *field, double *distances, vs_vec3 *slopes);
void vs_fit_numbers_at(const vs_fit_search *f, const double *unknowns, double *out);
/* Computes distances and slopes at these unknowns. Returns false when stopped, failed or refused; *refused: they make
 * no solid. */
bool vs_fit_evaluate(vs_fit_search *f, const double *unknowns, bool *refused);
/* Returns the median size of the distances, one or more; scratch has the same size. */
double vs_fit_median_size(const double *distances, size_t count, double *scratch);
/* Returns the spread of the last evaluation: 1.4826 medians, and at least the facets' tolerance. */
double vs_fit_spread(vs_fit_search *f);
int vs_fit_compare(const void *p, const void *q); /* compares doubles, for qsort */

/* ---- derivatives, by rows of f->count ---- */

/* Computes the derivatives by the six unknowns of the motion: the slope times the point's velocity. */
void vs_fit_motion_slopes(const vs_fit_search *f, const double *unknowns, double *out);
/* Computes the derivatives by number j, at the unknowns of f->at; 0 if the numbers on neither side make a solid.
 * Returns false when stopped or failed. */
bool vs_fit_number_slopes(vs_fit_search *f, size_t j, double *out);

/* ---- fitting ---- */

/* The number of points, the largest number of rounds and of evaluations in a round; tolerance: the relative change of
 * loss or unknowns at which a round ends. */
typedef struct {
  size_t points;
  unsigned rounds, most;
  double tolerance;
} vs_fit_effort;

/* Fits all unknowns from their current values by Tukey's loss, in rounds with a newly measured spread. The first of
 * three or more rounds has three times the spread, so that slightly displaced parts count. Returns false when it failed
 * or was stopped. */
bool vs_fit_improve(vs_fit_search *f, const vs_fit_effort *effort, double *unknowns);
/* Applies the motion's unknowns to the motion, and sets them to 0. */
void vs_fit_settle(vs_fit_search *f, double *unknowns);

#endif
