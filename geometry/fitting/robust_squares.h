/* Owns least squares with a robust loss: residuals that are many spreads large count less, or not at all. */
#ifndef VS_GEOMETRY_FITTING_ROBUST_SQUARES_H
#define VS_GEOMETRY_FITTING_ROBUST_SQUARES_H

#include "model/node.h"

#include <stddef.h>

/* HUBER: as a square up to 1.345 spreads, and linear beyond: convex, for the way to the solution. TUKEY: the biweight
 * with 4.685 spreads, past which a residual has no say: for the solution itself (both have 95 % of the efficiency of
 * squares where errors are normal). */
typedef enum { VS_LOSS_HUBER, VS_LOSS_TUKEY } vs_loss;
#define VS_TUKEY_REACH 4.685

/* Of a residual r in spreads: the loss is f * f / 2; *slope is df/dr, *weight (may be NULL) psi(r) / r. */
double vs_loss_root(vs_loss loss, double r, double *slope, double *weight);
/* psi'(r), of Huber's covariance. */
double vs_loss_curvature(vs_loss loss, double r);

/* Fills residuals in count lengths and, where slopes is not NULL, their derivatives: slopes[j * count + i] of residual
 * i by unknown j. Residuals at the same unknowns were asked for before slopes are. False: stop. */
typedef bool vs_residuals_fn(void *context, const double *unknowns, double *residuals, double *slopes);

typedef struct {
  size_t count, unknowns;
  vs_residuals_fn *residuals;
  void *context;
  vs_loss loss;
  double spread;    /* of the residuals, by which the loss measures them; > 0 */
  unsigned most;    /* evaluations of the residuals */
  double tolerance; /* relative change of loss or unknowns at which it ends */
} vs_robust_problem;
typedef enum {
  VS_ROBUST_DONE /* it converged */,
  VS_ROBUST_SPENT /* `most` was not enough */,
  VS_ROBUST_STOPPED
} vs_robust_end;

/* Improves the unknowns in place. *loss: the mean loss at them. Stopped, they are the best so far. False: no memory, or
 * no solver in the system (VS_ERROR_WORKER). The spread is above 0. */
bool vs_robust_solve(const vs_robust_problem *p, double *unknowns, double *loss, vs_robust_end *end, vs_error *e);

#endif
