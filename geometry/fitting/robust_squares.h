/* Declares least squares with a robust loss: residuals of many times the usual size (spread) have less influence, or
 * none. */
#ifndef VS_GEOMETRY_FITTING_ROBUST_SQUARES_H
#define VS_GEOMETRY_FITTING_ROBUST_SQUARES_H

#include "model/node.h"

#include <stddef.h>

/* The loss functions. HUBER: quadratic up to 1.345 spreads (usual sizes of a residual), linear above; it leads near
 * the solution. TUKEY: the biweight, in which a residual above 4.685 spreads has no influence; it determines the
 * solution. */
typedef enum { VS_LOSS_HUBER, VS_LOSS_TUKEY } vs_loss;
#define VS_TUKEY_REACH 4.685

/* Returns f, the root of twice the loss, for a residual r in units of the spread. *slope: df/dr. *weight: psi(r) / r,
 * where psi is the derivative of the loss; weight may be NULL. */
double vs_loss_root(vs_loss loss, double r, double *slope, double *weight);
/* Returns the second derivative psi'(r) of the loss, which Huber's covariance needs. */
double vs_loss_curvature(vs_loss loss, double r);

/* Computes `count` residuals. If slopes is not NULL, computes their derivatives instead: slopes[j * count + i] is the
 * derivative of residual i by unknown j. Returns false to stop the solver. */
typedef bool vs_residuals_fn(void *context, const double *unknowns, double *residuals, double *slopes);

typedef struct {
  size_t count, unknowns;
  vs_residuals_fn *residuals;
  void *context;
  vs_loss loss;
  double spread;    /* spread of the residuals, the unit of the loss; above 0 */
  unsigned most;    /* greatest number of evaluations of the residuals that the solver may make */
  double tolerance; /* the solver ends when the loss or the unknowns change by less than this fraction */
} vs_robust_problem;
typedef enum {
  VS_ROBUST_DONE /* the solver has converged */,
  VS_ROBUST_SPENT /* the solver has used all its evaluations without converging */,
  VS_ROBUST_STOPPED
} vs_robust_end;

/* Improves the unknowns in place; if the solver is stopped, they are the best so far. *loss: mean loss for these
 * unknowns. p->spread is above 0. Returns false when memory is out, or the solver's library is not installed
 * (VS_ERROR_WORKER). */
bool vs_robust_solve(const vs_robust_problem *p, double *unknowns, double *loss, vs_robust_end *end, vs_error *e);

#endif
