/* Declares the functions for the fit of a model to the points of a scan: of the model's numbers and the scan's position
 * together.
 *
 * The residual of a point p is the signed distance d(m(p), x) of its image from the model's surface, where m is a rigid
 * motion (six unknowns, unless the scan is already placed) and x are the model's numbers. The derivative by m is exact,
 * the slope of the distance; that by x is a difference of two models.
 *
 * Plan. Step 1 tries places on some hundred points: the scan's own place, rotations about the vertical axis and those
 * that lay principal axes on principal axes, and shifts that align the boxes. It improves the best with the model
 * unchanged. It does the same with the model's numbers scaled by the ratio of the sizes, and again with the core of the
 * scan, without strays. Step 2 fits all unknowns from the best few of these, on few points, by Tukey's loss; the score
 * of each is the mean loss of all points by the least spread. If the best has many outliers, its numbers are changed
 * one by one. Step 3 continues the best with more points, then with all requested points. Step 4 derives from the
 * derivatives at the end each number's interval, or that the scan does not determine it, and whether the result can be
 * trusted. */
#ifndef VS_GEOMETRY_FITTING_MODEL_FIT_H
#define VS_GEOMETRY_FITTING_MODEL_FIT_H

#include "geometry/fitting/rigid_motion.h"
#include "geometry/measure/mesh_distance.h"
#include "model/node.h"

#include <stdint.h>

typedef struct {
  double start, low, high; /* low -INFINITY, high INFINITY: no such bound */
} vs_fit_number;

typedef struct {
  void *context;
  /* Makes the solid with these numbers as a mesh whose facets are within tolerance (0: the drawing's own). Returns
   * false with VS_ERROR_MODEL if these numbers make none, which the fit treats as too long a step; any other error ends
   * it. */
  bool (*make)(void *context, const double *numbers, double tolerance, vs_mesh *out, vs_error *e);
  bool (*going)(void *context); /* false: stop, and keep the result so far */
  void (*progress)(void *context, unsigned iteration, double spread);
} vs_fit_model;

typedef struct {
  const vs_fit_model *model;
  const vs_fit_number *numbers;
  size_t number_count;
  const vs_vec3 *points; /* of the scan, in random order */
  size_t count;
  bool placed;       /* the scan has the model's coordinates */
  bool near;         /* the scan is near its place: no other place is tried */
  bool any_pose;     /* up in the scan may differ from up in the model */
  size_t most;       /* the largest number of points in the last steps */
  double confidence; /* of the intervals, between 0 and 1 */
} vs_fit_problem;

typedef enum {
  VS_FIT_NUMBER_FITTED,
  VS_FIT_NUMBER_LOOSE /* the scan does not determine it */,
  VS_FIT_NUMBER_BOUND /* it is at a bound */
} vs_fit_verdict;

/* The reason for which the result of a fit cannot be trusted. */
typedef enum {
  VS_FIT_DOUBT_NONE,
  VS_FIT_DOUBT_FAR,    /* half of the points lie far from the model */
  VS_FIT_DOUBT_TILTED, /* the model lies on its side, or upside down, without any_pose */
  VS_FIT_DOUBT_STRAYS, /* more than a fifth of the points are outliers */
  VS_FIT_DOUBT_SHAPE,  /* neighbouring points lie on the same side */
  VS_FIT_DOUBT_RIVAL   /* another start gave as good a fit, with another shape */
} vs_fit_doubt;

typedef struct {
  double value, error, low, high; /* error: standard; low, high: the interval at the requested confidence; INFINITY if
                                   * loose */
  double rival;                   /* the value in the second best fit (vs_model_fit.rival) */
  vs_fit_verdict verdict;
} vs_fitted_number;

typedef struct {
  vs_fitted_number *numbers;
  vs_rigid_motion motion;  /* from the scan to the model */
  vs_mesh_distance *field; /* of the fitted model */
  double *distances;       /* of all points, signed */
  size_t used;             /* points in the last step */
  double spread; /* of the distances: 1.4826 times their median size, the standard deviation of a normal distribution */
  double root_mean_square, median;
  double correlation;      /* of neighbouring points' distances, without outliers: near 0 for pure noise */
  size_t outliers;         /* points beyond Tukey's limit */
  double size;             /* of the scan: root of the mean square distance from its centre */
  double model_size;       /* of the model at the start, the same */
  bool converged, stopped; /* stopped: `going` ended it */
  bool rival;              /* another start gave as good a fit, with other numbers */
  bool rival_unlike;       /* and its shape differs */
  vs_fit_doubt doubt;
  unsigned iterations, models; /* evaluations of the distances; models made */
} vs_model_fit;

/* Fills *out, which the caller frees, also after a failure. Returns false if nothing was fitted: too few points, the
 * model cannot be made at the start, no memory, no solver. */
bool vs_model_fit_solve(const vs_fit_problem *p, vs_model_fit *out, vs_error *e);
void vs_model_fit_free(vs_model_fit *f);

#endif
