/* Owns the fit of a model to the points of a scan: the numbers of the model and the place of the scan together.
 *
 * The residual of a point p is the signed distance d(m(p), x) of its place in the model from the model's surface, where
 * m is a rigid motion (six unknowns, unless the scan is placed already) and x are the model's numbers. By m the
 * derivative is exact, the slope of the distance; by x it is a difference of two models.
 *
 * Plan. 1: the scan as it lies, rotations about the upright axis and such as lay principal axes on principal axes, and
 * shifts that lay box on box, are tried on some hundred points; the best are improved with the model as it is. The same
 * holds in the model whose numbers are as many times larger as the scan is, and again with the core of the scan, from
 * which strays are gone. 2: from the best few of these all unknowns are fitted, few points, Tukey's loss; the score of
 * each is the mean loss of all points by the least spread. Where the best has many outliers, its numbers are moved one
 * by one. 3: the best goes on with more points, then with all that are asked for. 4: what the derivatives at the end
 * say of each number: its interval, or that the scan does not determine it; and whether the result is to be trusted. */
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
  /* The solid with these numbers as a mesh with facets that are at most tolerance off (0: the drawing's own). False:
   * VS_ERROR_MODEL where these numbers make none, which the fit takes for a step too far; any other error ends it. */
  bool (*make)(void *context, const double *numbers, double tolerance, vs_mesh *out, vs_error *e);
  bool (*going)(void *context); /* false: stop, and keep what there is */
  void (*progress)(void *context, unsigned iteration, double spread);
} vs_fit_model;

typedef struct {
  const vs_fit_model *model;
  const vs_fit_number *numbers;
  size_t number_count;
  const vs_vec3 *points; /* of the scan, in random order */
  size_t count;
  bool placed;       /* the scan lies where the model does */
  bool near;         /* it lies about there: no other place is tried */
  bool any_pose;     /* up in the scan need not be up in the model */
  size_t most;       /* points that the last steps use */
  double confidence; /* of the intervals, within 0 and 1 */
} vs_fit_problem;

typedef enum {
  VS_FIT_NUMBER_FITTED,
  VS_FIT_NUMBER_LOOSE /* the scan does not determine it */,
  VS_FIT_NUMBER_BOUND /* it stands at a bound */
} vs_fit_verdict;

/* Why the result of a fit cannot be trusted. */
typedef enum {
  VS_FIT_DOUBT_NONE,
  VS_FIT_DOUBT_FAR,    /* half of the points lie far from the model */
  VS_FIT_DOUBT_TILTED, /* the model lies on its side, or upside down, and any_pose was not said */
  VS_FIT_DOUBT_STRAYS, /* more than a fifth of the points are outliers */
  VS_FIT_DOUBT_SHAPE,  /* neighbouring points lie on the same side */
  VS_FIT_DOUBT_RIVAL   /* another start came as near, with another shape */
} vs_fit_doubt;

typedef struct {
  double value, error, low, high; /* error: standard; the interval: at the asked confidence; INFINITY where loose */
  double rival;                   /* the value in the second best fit (vs_model_fit.rival) */
  vs_fit_verdict verdict;
} vs_fitted_number;

typedef struct {
  vs_fitted_number *numbers;
  vs_rigid_motion motion;  /* from the scan to the model */
  vs_mesh_distance *field; /* of the fitted model */
  double *distances;       /* of all points, signed */
  size_t used;             /* points in the last step */
  double spread; /* of the distances: 1.4826 times their median size, a standard deviation where they are normal */
  double root_mean_square, median;
  double correlation;      /* of neighbouring points' distances, outliers left out: near 0 where they are mere noise */
  size_t outliers;         /* points past Tukey's reach */
  double size;             /* of the scan: root of the mean square distance from its centre */
  double model_size;       /* of the model at the start, the same */
  bool converged, stopped; /* stopped: `going` ended it */
  bool rival;              /* another start came as near, with other numbers */
  bool rival_unlike;       /* and its shape is another */
  vs_fit_doubt doubt;
  unsigned iterations, models; /* evaluations of the distances; models made */
} vs_model_fit;

/* Fills *out, which the caller frees, also after a failure. False: nothing was fitted (too few points, the model cannot
 * be made as it is, no memory, no solver). */
bool vs_model_fit_solve(const vs_fit_problem *p, vs_model_fit *out, vs_error *e);
void vs_model_fit_free(vs_model_fit *f);

#endif
