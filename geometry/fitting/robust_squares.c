/* Implements the robust losses, and calls the Levenberg-Marquardt solver of cminpack (robust_squares.h).
 *
 * The solver minimizes a sum of squares. Therefore each residual r is replaced by f, the root of twice its loss with
 * the sign of r, and its derivatives are multiplied by df/dr. */
#include "geometry/fitting/robust_squares.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "geometry/dynamic.h"
#include "model/store/array.h"

#define HUBER_REACH 1.345

double vs_loss_root(vs_loss loss, double r, double *slope, double *weight) {
  double size = fabs(r), f = size, psi = size;
  if (loss == VS_LOSS_HUBER && size > HUBER_REACH) {
    psi = HUBER_REACH;
    f = sqrt(2 * HUBER_REACH * size - HUBER_REACH * HUBER_REACH);
  } else if (loss == VS_LOSS_TUKEY) {
    double u = size / VS_TUKEY_REACH, rest = u < 1 ? 1 - u * u : 0;
    psi = size * rest * rest;
    /* The expression under the root equals 1 - (1 - u^2)^3. It is written so that no digits are lost for small u. */
    f = u < 1 ? size * sqrt(1 - u * u + u * u * u * u / 3) : VS_TUKEY_REACH / sqrt(3);
  }
  *slope = f > 0 ? psi / f : 1;
  if (weight) *weight = size > 0 ? psi / size : 1;
  return r < 0 ? -f : f;
}

double vs_loss_curvature(vs_loss loss, double r) {
  if (loss == VS_LOSS_HUBER) return fabs(r) <= HUBER_REACH;
  double u = r * r / (VS_TUKEY_REACH * VS_TUKEY_REACH);
  return u < 1 ? (1 - u) * (1 - 5 * u) : 0;
}

/* ---- the solver of cminpack ---- */

typedef int lm_function(void *p, int m, int n, const double *x, double *fvec, double *fjac, int ldfjac, int iflag);
typedef struct {
  int (*lmder)(lm_function *fcn, void *p, int m, int n, double *x, double *fvec, double *fjac, int ldfjac, double ftol,
               double xtol, double gtol, int maxfev, double *diag, int mode, double factor, int nprint, int *nfev,
               int *njev, int *ipvt, double *qtf, double *wa1, double *wa2, double *wa3, double *wa4);
} minpack;

static bool load(minpack *out, vs_error *e) {
  static const vs_dynamic_name names[] = { { "lmder", offsetof(minpack, lmder) } };
  return vs_dynamic_load(VS_LIBRARY_CMINPACK, "fitting", names, sizeof names / sizeof *names, out, e);
}

typedef struct {
  const vs_robust_problem *p;
  double *residuals;
} solving;

static int evaluate(void *context, int m, int n, const double *x, double *fvec, double *fjac, int ldfjac, int iflag) {
  solving *s = context;
  const vs_robust_problem *p = s->p;
  size_t count = (size_t)m;
  (void)ldfjac;
  if (iflag == 1) {
    if (!p->residuals(p->context, x, s->residuals, NULL)) return -1;
    for (size_t i = 0; i < count; i++) {
      double slope;
      fvec[i] = vs_loss_root(p->loss, s->residuals[i] / p->spread, &slope, NULL);
    }
    return 0;
  }
  if (!p->residuals(p->context, x, s->residuals, fjac)) return -1;
  for (size_t i = 0; i < count; i++) {
    double slope;
    vs_loss_root(p->loss, s->residuals[i] / p->spread, &slope, NULL);
    for (size_t j = 0; j < (size_t)n; j++) fjac[j * count + i] *= slope / p->spread;
  }
  return 0;
}

bool vs_robust_solve(const vs_robust_problem *p, double *unknowns, double *loss, vs_robust_end *end, vs_error *e) {
  minpack lm;
  size_t m = p->count, n = p->unknowns;
  VS_ASSERT(p->spread > 0);
  if (!load(&lm, e)) return false;
  if (m > INT_MAX / (n + 4)) return vs_error_memory(e, NULL);
  double *work = NULL;
  int *pivots = NULL;
  size_t work_room = 0, pivot_room = 0;
  bool ok = VS_GROW(work, work_room, m * (n + 3) + 6 * n) && VS_GROW(pivots, pivot_room, n);
  if (ok) {
    double *f = work, *last = f + m, *residuals = last + m, *jacobian = residuals + m, *diagonal = jacobian + m * n;
    solving s = { p, residuals };
    int evaluations, jacobians;
    int code = lm.lmder(evaluate, &s, (int)m, (int)n, unknowns, f, jacobian, (int)m, p->tolerance, p->tolerance, 0,
                        (int)p->most, diagonal, 1, 10, 0, &evaluations, &jacobians, pivots, diagonal + n,
                        diagonal + 2 * n, diagonal + 3 * n, diagonal + 4 * n, last);
    *end = code < 0 ? VS_ROBUST_STOPPED : code == 5 ? VS_ROBUST_SPENT : VS_ROBUST_DONE;
    *loss = 0;
    for (size_t i = 0; i < m; i++) *loss += f[i] * f[i] / 2;
    *loss /= (double)m;
  }
  free(work), free(pivots);
  return ok || vs_error_memory(e, NULL);
}
