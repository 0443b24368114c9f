/* Declares least squares with a robust loss: residuals of many spreads count less, or not at all. */
#ifndef VS_GEOMETRY_FITTING_ROBUST_SQUARES_H
#define VS_GEOMETRY_FITTING_ROBUST_SQUARES_H

#include "model/node.h"

#include <stddef.h>

/* HUBER: quadratic up to 1.345 spreads, and linear beyond: convex, for the way to the solution. TUKEY: the biweight
 * with 4.685 spreads, beyond which a residual has no influence: for the solution itself. Both have 95 % of the
 * efficiency of squares if errors are normal. */
typedef enum { VS_LOSS_HUBER, VS_LOSS_TUKEY } vs_loss;
#define VS_TUKEY_REACH 4.685

/* For a residual r in spreads, returns f; the loss is f * f / 2. *slope: df/dr; *weight (may be NULL): psi(r) / r. */
double vs_loss_root(vs_loss loss, double r, double *slope, double *weight);
/* Returns psi'(r), for Huber's covariance. */
double vs_loss_curvature(vs_loss loss, double r);

/* Computes count residuals and, if slopes is not NULL, their derivatives: slopes[j * count + i] of residual i by
 * unknown j. The residuals at the same unknowns are requested before the slopes. Returns false to stop. */
typedef bool vs_residuals_fn(void *context, const double *unknowns, double *residuals, double *slopes);

typedef struct {
  size_t count, unknowns;
  vs_residuals_fn *residuals;
  void *context;
  vs_loss loss;
  double spread;    /* of the residuals, the unit of the loss; > 0 */
  unsigned most;    /* the largest number of evaluations of the residuals */
  double tolerance; /* relative change of loss or unknowns at which it ends */
} vs_robust_problem;
typedef enum {
  VS_ROBUST_DONE /* it converged */,
  VS_ROBUST_SPENT /* it used up `most` */,
  VS_ROBUST_STOPPED
} vs_robust_end;

/* Improves the unknowns in place; after a stop they are the best so far. *loss: the mean loss at them. The spread is
 * above 0. Returns false when memory is out, or the system has no solver (VS_ERROR_WORKER). */
bool vs_robust_solve(const vs_robust_problem *p, double *unknowns, double *loss, vs_robust_end *end, vs_error *e);

#endif
