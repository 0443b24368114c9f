/* Owns, for fitting/ alone, a fit under way: its unknowns, and the distances of the points at them. */
#ifndef VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H
#define VS_GEOMETRY_FITTING_FIT_UNKNOWNS_H

#include "geometry/fitting/model_fit.h"
#include "geometry/fitting/robust_squares.h"

enum {
  VS_FIT_UNKNOWNS_MOST = 200,
  VS_FIT_FIRST = 1000 /* points of step 2 */
};
#define VS_FIT_UPRIGHT .7 /* cosine of the angle by which up may differ */

/* ---- a number of the model as an unknown without bounds ---- */

double vs_fit_number_scale(const vs_fit_number *n); /* by which its changes are measured */
double vs_fit_number_outer(const vs_fit_number *n, double unknown); /* the number of an unknown */
double vs_fit_number_inner(const vs_fit_number *n, double number);  /* and back */

/* ---- the state of a fit ---- */

typedef struct {
  const vs_fit_problem *p;
  vs_model_fit *out;
  vs_error *e;
  size_t numbers, unknowns; /* unknowns: with the motion's */
  double diagonal;          /* of the model at the start */
  double tolerance;         /* of the facets in this step */
  vs_rigid_motion motion;   /* where the motion's unknowns are 0 */
  size_t count;             /* points in this step */
  bool failed;              /* with an error that is not the model's */
  vs_vec3 *core;            /* points of the scan without strays, in the same order */
  size_t core_count;
  const vs_vec3 *points;    /* of this step: all, or the core */
  size_t point_count;
  bool level;               /* places turn only about what is up */
  /* what was computed last, and where */
  vs_mesh_distance *field;
  double *at, *made_at, *trial; /* unknowns of it; numbers of the field; numbers to be tried */
  bool known;
  double *begin[2]; /* numbers to start from: the caller's, and those times the scan's size by the model's */
  vs_vec3 *places, *slopes;
  double *distances, *other;
} vs_fit_search;

/* Asks whether to go on. False: it was stopped just now. After that it is true: what comes then is little, and is
 * done. */
bool vs_fit_going(vs_fit_search *f);
/* Measures by the core, or by all points. */
void vs_fit_take_points(vs_fit_search *f, bool core);

/* ---- distances ---- */

/* False: stopped, failed, or these numbers make no solid; then *refused. */
bool vs_fit_make_field(vs_fit_search *f, const double *numbers, vs_mesh_distance **out, bool *refused);
/* The distances of the step's points, at f->places, from a field; slopes may be NULL. False: stopped. */
bool vs_fit_measure(vs_fit_search *f, const vs_mesh_distance *field, double *distances, vs_vec3 *slopes);
void vs_fit_numbers_at(const vs_fit_search *f, const double *unknowns, double *out);
/* Distances and slopes at these unknowns. *refused: they make no solid. False: stopped or failed, or refused. */
bool vs_fit_evaluate(vs_fit_search *f, const double *unknowns, bool *refused);
/* The median size of the distances, one or more; scratch is as large. */
double vs_fit_median_size(const double *distances, size_t count, double *scratch);
/* The spread of the last evaluation: 1.4826 medians, and not less than the facets are off. */
double vs_fit_spread(vs_fit_search *f);
int vs_fit_compare(const void *p, const void *q); /* doubles, for qsort */

/* ---- derivatives, by rows of f->count ---- */

/* By the six unknowns of the motion: the slope, carried by how the point moves. */
void vs_fit_motion_slopes(const vs_fit_search *f, const double *unknowns, double *out);
/* By number j, at the unknowns of f->at. Where neither side makes a solid it is 0. False: stopped or failed. */
bool vs_fit_number_slopes(vs_fit_search *f, size_t j, double *out);

/* ---- fitting ---- */

/* How many points are used, in how many rounds at most, each of so many evaluations; tolerance: the relative change of
 * loss or unknowns at which a round ends. */
typedef struct {
  size_t points;
  unsigned rounds, most;
  double tolerance;
} vs_fit_effort;

/* Fits all unknowns from those in place by Tukey's loss, in rounds with the spread measured anew; the first of three
 * or more has three times the spread, lest a part that is a little off has no say. False: failed, or stopped. */
bool vs_fit_improve(vs_fit_search *f, const vs_fit_effort *effort, double *unknowns);
/* Moves what the motion's unknowns say into the motion, and makes them 0. */
void vs_fit_settle(vs_fit_search *f, double *unknowns);

#endif
