/* Declares the fit of a model to the points of a scan. It determines the model's numbers and the scan's position
 * together.
 *
 * The residual of a point p is the signed distance d(m(p), x) of its image m(p) from the model's surface. m is a rigid
 * motion (six unknowns, unless the scan is already placed), and x are the model's numbers. The derivative by m is
 * exact: it is the gradient of the distance. The derivative by x is a difference of two models.
 *
 * Step 1 evaluates possible places of the scan with some hundred points. These are the scan's own place, rotations
 * about the vertical axis, rotations that align principal axes, and shifts that align the boxes. It improves the best
 * places with the model unchanged. It repeats this with the model's numbers scaled by the ratio of the sizes, and with
 * the core of the scan, which has no stray points.
 *
 * Step 2 fits all unknowns from the best places, with few points and Tukey's loss. The score of a result is the mean
 * loss of all points, relative to the least spread. If the best result has many outliers, its numbers are changed one
 * by one.
 *
 * Step 3 continues the best result with more points, then with all requested points.
 *
 * Step 4 computes each number's interval from the derivatives at the end, or finds that the scan does not determine the
 * number. It also decides whether the result can be trusted. */
#ifndef VS_GEOMETRY_FITTING_MODEL_FIT_H
#define VS_GEOMETRY_FITTING_MODEL_FIT_H

#include "geometry/fitting/rigid_motion.h"
#include "geometry/measure/mesh_distance.h"
#include "model/node.h"

#include <stdint.h>

typedef struct {
  double start, low, high; /* A number of the model. start: value with which the fit begins; low, high: bounds, where
                            * -INFINITY and INFINITY mean no bound. */
} vs_fit_number;

typedef struct {
  void *context;
  /* Makes the solid with the given numbers as a mesh whose facets are within the tolerance; 0: the tolerance of
   * drawings. Returns false with VS_ERROR_MODEL if the numbers do not make a solid. Any other error ends the fit. */
  bool (*make)(void *context, const double *numbers, double tolerance, vs_mesh *out, vs_error *e);
  bool (*going)(void *context); /* returns false to stop the fit, which keeps its result so far */
  void (*progress)(void *context, unsigned iteration, double spread);
} vs_fit_model;

typedef struct {
  const vs_fit_model *model;
  const vs_fit_number *numbers;
  size_t number_count;
  const vs_vec3 *points; /* points of the scan, in random order */
  size_t count;
  bool placed;       /* true if the scan already has the model's coordinates, so that the fit does not move the scan */
  bool near;         /* true if the scan is already near its place, so that no other place is evaluated */
  bool any_pose;     /* true if the scan's upward direction may differ from the model's */
  size_t most;       /* greatest number of scan points that the last steps of the fit use */
  double confidence; /* confidence (between 0 and 1) of the intervals that the fit computes for the model's numbers */
} vs_fit_problem;

typedef enum {
  VS_FIT_NUMBER_FITTED,
  VS_FIT_NUMBER_LOOSE /* the scan does not determine the number: many values fit equally well */,
  VS_FIT_NUMBER_BOUND /* the fitted number is at one of its bounds */
} vs_fit_verdict;

/* The reason why the result of a fit cannot be trusted. */
typedef enum {
  VS_FIT_DOUBT_NONE,
  VS_FIT_DOUBT_FAR,    /* half of the scan's points lie far from the model */
  VS_FIT_DOUBT_TILTED, /* the fitted model lies on its side or upside down, although any_pose is false */
  VS_FIT_DOUBT_STRAYS, /* more than a fifth of the scan's points are outliers */
  VS_FIT_DOUBT_SHAPE,  /* the distances of neighbouring points are correlated, so the model has another shape */
  VS_FIT_DOUBT_RIVAL   /* value: the fitted number; error: its standard error; low, high: its interval at the requested
                        * confidence. error, low and high are infinite if the scan does not determine the number. */
} vs_fit_doubt;

typedef struct {
  double value, error, low, high; /* value: the fitted number; error: its standard error; low, high: its interval at the
                                   * requested confidence; INFINITY if the number is not determined */
  double rival;                   /* value of the number in the second best fit (vs_model_fit.rival) */
  vs_fit_verdict verdict;
} vs_fitted_number;

typedef struct {
  vs_fitted_number *numbers;
  vs_rigid_motion motion;  /* rigid motion from the scan's coordinates to the model's */
  vs_mesh_distance *field; /* data for computing distances from the fitted model */
  double *distances;       /* distances[i]: signed distance of point i of the scan from the fitted model */
  size_t used;             /* number of scan points in the last step of the fit */
  double spread; /* spread of the distances: 1.4826 times the median of their absolute values, which is the standard
                  * deviation for a normal distribution */
  double root_mean_square, median;
  double correlation;      /* correlation of the distances of neighbouring points, without outliers; near 0 if the
                            * distances are pure noise */
  size_t outliers;         /* number of the scan's points whose distance has no influence on the fit (beyond Tukey's
                            * limit) */
  double size;             /* size of the scan: root of the mean square distance from its centre */
  double model_size;       /* size of the model at the start: root of the mean square distance from its centre */
  bool converged, stopped; /* converged: true if the solver converged in the last step of the fit; stopped: true if the
                            * caller's function `going` ended the fit */
  bool rival;              /* true if another start led to an equally good fit with other numbers */
  bool rival_unlike;       /* true if the equally good fit from another start (`rival`) also has another shape */
  vs_fit_doubt doubt;
  unsigned iterations, models; /* iterations: number of times that the distances of all points were computed; models:
                                * number of solids that were made from numbers */
} vs_model_fit;

/* Fits the model and fills *out, which the caller frees, even after a failure. Returns false if nothing was fitted:
 * there are too few points, the start numbers make no model, memory is out, or the solver's library is missing. */
bool vs_model_fit_solve(const vs_fit_problem *p, vs_model_fit *out, vs_error *e);
void vs_model_fit_free(vs_model_fit *f);

#endif
