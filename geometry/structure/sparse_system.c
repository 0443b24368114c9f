/* Implements systems of linear equations by the library CHOLMOD (sparse_system.h).
 *
 * CHOLMOD factors a small permuted matrix as L D L', and a large one as L L' by its supernodal method. The pivots, the
 * entries of D or the squared diagonal of L, show whether the matrix is singular. The scaled matrix has the diagonal 1;
 * a pivot is then the share of a row that the rows before it do not determine. */
#include "geometry/structure/sparse_system.h"

#include <limits.h>
#include <math.h>
#include <string.h>
#include <suitesparse/cholmod.h>

#include "geometry/dynamic.h"
#include "model/store/array.h"

#define CHOLMOD_CALLS(X)                                                                                              \
  X(cholmod_start) X(cholmod_finish) X(cholmod_allocate_triplet) X(cholmod_free_triplet) X(cholmod_triplet_to_sparse) \
  X(cholmod_free_sparse) X(cholmod_analyze) X(cholmod_factorize_p) X(cholmod_free_factor) X(cholmod_solve)             \
  X(cholmod_sdmult) X(cholmod_allocate_dense) X(cholmod_free_dense)

enum { DISSECTED = 30000 }; /* number of rows from which nested dissection orders the matrix */

typedef struct {
#define X(name) __typeof__(&name) name;
  CHOLMOD_CALLS(X)
#undef X
} cholmod_calls;

struct vs_sparse {
  cholmod_calls call;
  cholmod_common common;
  cholmod_triplet *entries; /* entries that were added to the matrix; NULL after vs_sparse_close */
  cholmod_sparse *matrix;
  cholmod_factor *factor;
  double *scale; /* diagonal of D, by which the matrix A is scaled to D A D; NULL if it is not scaled */
  size_t n;
};

static bool load(cholmod_calls *out, const char *purpose, vs_error *e) {
  static const vs_dynamic_name names[] = {
#define X(name) { #name, offsetof(cholmod_calls, name) },
    CHOLMOD_CALLS(X)
#undef X
  };
  return vs_dynamic_load(VS_LIBRARY_CHOLMOD, purpose, names, sizeof names / sizeof *names, out, e);
}

vs_sparse *vs_sparse_new(size_t n, size_t entries, const char *purpose, vs_error *e) {
  VS_ASSERT(n > 0);
  vs_sparse *s = vs_zeros(1, sizeof *s);
  if (!s) return vs_error_memory(e, NULL), NULL;
  if (!load(&s->call, purpose, e)) return free(s), NULL;
  s->n = n;
  s->call.cholmod_start(&s->common);
  s->common.print = 0;
  s->common.try_catch = 1; /* prevents that CHOLMOD calls an error handler or prints messages */
  /* Orders a large matrix by nested dissection: it takes longer than minimum degree, but saves more time later. */
  s->common.nmethods = 1;
  s->common.method[0].ordering = n < DISSECTED ? CHOLMOD_AMD : CHOLMOD_METIS;
  if (n < INT_MAX && entries < INT_MAX)
    s->entries = s->call.cholmod_allocate_triplet(n, n, entries + 1, 1, CHOLMOD_REAL, &s->common);
  if (!s->entries) return vs_sparse_free(s), vs_error_memory(e, NULL), NULL;
  return s;
}

void vs_sparse_free(vs_sparse *s) {
  if (!s) return;
  s->call.cholmod_free_triplet(&s->entries, &s->common);
  s->call.cholmod_free_sparse(&s->matrix, &s->common);
  s->call.cholmod_free_factor(&s->factor, &s->common);
  s->call.cholmod_finish(&s->common);
  free(s->scale), free(s);
}

void vs_sparse_add(vs_sparse *s, size_t i, size_t j, double v) {
  cholmod_triplet *t = s->entries;
  VS_ASSERT(t && i < s->n && j < s->n && t->nnz < t->nzmax);
  ((int *)t->i)[t->nnz] = (int)(i < j ? i : j);
  ((int *)t->j)[t->nnz] = (int)(i < j ? j : i);
  ((double *)t->x)[t->nnz++] = v;
}

/* Scales the matrix A to D A D, whose diagonal is 1. Returns false when memory is out. */
static bool scale_to_one(vs_sparse *s) {
  const int *from = s->matrix->p, *row = s->matrix->i;
  double *x = s->matrix->x;
  if (!VS_FRESH(s->scale, s->n)) return false;
  for (size_t j = 0; j < s->n; j++) s->scale[j] = 1;
  for (size_t j = 0; j < s->n; j++)
    for (int k = from[j]; k < from[j + 1]; k++)
      if ((size_t)row[k] == j && x[k] > 0) s->scale[j] = 1 / sqrt(x[k]);
  for (size_t j = 0; j < s->n; j++)
    for (int k = from[j]; k < from[j + 1]; k++) x[k] *= s->scale[j] * s->scale[row[k]];
  return true;
}

bool vs_sparse_close(vs_sparse *s, bool scaled, vs_error *e) {
  VS_ASSERT(s->entries && !s->matrix);
  s->matrix = s->call.cholmod_triplet_to_sparse(s->entries, 0, &s->common);
  s->call.cholmod_free_triplet(&s->entries, &s->common);
  return (s->matrix && (!scaled || scale_to_one(s))) || vs_error_memory(e, NULL);
}

/* Factors the matrix D A D + shift * I. Returns false when memory is out. */
static bool factor_shifted(vs_sparse *s, double shift) {
  double beta[2] = { shift, 0 };
  if (!s->factor) s->factor = s->call.cholmod_analyze(s->matrix, &s->common);
  s->common.status = CHOLMOD_OK;
  return s->factor && s->call.cholmod_factorize_p(s->matrix, beta, NULL, 0, s->factor, &s->common) &&
         s->common.status >= CHOLMOD_OK;
}

typedef struct { double least; size_t row; } pivots;

static void note_pivot(const vs_sparse *s, size_t row, double pivot, pivots *out) {
  if (row >= s->factor->minor) pivot = 0; /* the factorization ended before this row, because the matrix is not positive
                                           * definite */
  if (pivot < out->least || pivot != pivot) *out = (pivots){ pivot > 0 ? pivot : 0, row };
}

bool vs_sparse_factor(vs_sparse *s, double *least, size_t *at, vs_error *e) {
  VS_ASSERT(s->matrix && s->scale);
  if (!factor_shifted(s, 0)) return vs_error_memory(e, NULL);
  const cholmod_factor *l = s->factor;
  const double *x = l->x;
  pivots found = { 1, 0 };
  if (l->is_super) {
    const int *first = l->super, *rows = l->pi, *from = l->px;
    for (size_t k = 0; k < l->nsuper; k++)
      for (int j = first[k]; j < first[k + 1]; j++) {
        double root = x[from[k] + (j - first[k]) * (rows[k + 1] - rows[k] + 1)];
        note_pivot(s, (size_t)j, root * root, &found);
      }
  } else {
    for (size_t j = 0; j < s->n; j++) {
      double pivot = x[((const int *)l->p)[j]];
      note_pivot(s, j, l->is_ll ? pivot * pivot : pivot, &found);
    }
  }
  *least = found.least, *at = (size_t)((const int *)l->Perm)[found.row];
  return true;
}

/* Computes out = a * out + b * matrix * in. in, out: `columns` columns of n numbers. */
static bool multiply(vs_sparse *s, double b, const double *in, double a, double *out, size_t columns) {
  double alpha[2] = { b, 0 }, beta[2] = { a, 0 };
  double *unchanged = (double *)(uintptr_t)in; /* cholmod_dense has no const member; the call does not change *in */
  cholmod_dense x = { s->n, columns, s->n * columns, s->n, unchanged, NULL, CHOLMOD_REAL, CHOLMOD_DOUBLE };
  cholmod_dense y = { s->n, columns, s->n * columns, s->n, out, NULL, CHOLMOD_REAL, CHOLMOD_DOUBLE };
  return s->call.cholmod_sdmult(s->matrix, 0, alpha, beta, &x, &y, &s->common);
}

/* Adds the solutions for several right sides b to x. sides: number of columns of b and of x. Returns false when memory
 * is out. */
static bool add_solution(vs_sparse *s, double *b, double *x, size_t sides) {
  size_t count = s->n * sides;
  cholmod_dense right = { s->n, sides, count, s->n, b, NULL, CHOLMOD_REAL, CHOLMOD_DOUBLE };
  cholmod_dense *found = s->call.cholmod_solve(CHOLMOD_A, s->factor, &right, &s->common);
  for (size_t i = 0; found && i < count; i++) x[i] += ((const double *)found->x)[i];
  bool ok = found != NULL;
  s->call.cholmod_free_dense(&found, &s->common);
  return ok;
}

bool vs_sparse_solve(vs_sparse *s, double *x, size_t sides, vs_error *e) {
  VS_ASSERT(s->factor && s->scale);
  size_t count = s->n * sides;
  double *b, *rest = NULL;
  bool ok = VS_FRESH(b, count) && VS_FRESH(rest, count);
  for (size_t i = 0; ok && i < count; i++) rest[i] = b[i] = x[i] * s->scale[i % s->n], x[i] = 0;
  ok = ok && add_solution(s, b, x, sides) && multiply(s, -1, x, 1, rest, sides) && add_solution(s, rest, x, sides);
  for (size_t i = 0; ok && i < count; i++) x[i] *= s->scale[i % s->n];
  free(b), free(rest);
  return ok || vs_error_memory(e, NULL);
}

/* Inverse iteration: solving with D A D + shift repeatedly leaves the vector that D A D nearly maps to 0. */
bool vs_sparse_softest(vs_sparse *s, size_t at, double *v, vs_error *e) {
  enum { TURNS = 12 };
  VS_ASSERT(s->matrix && s->scale && at < s->n);
  double *b;
  bool ok = VS_FRESH(b, s->n) && factor_shifted(s, 1e-10);
  /* The start vector is not symmetric, because a symmetric one could miss a motion without symmetry. */
  for (size_t i = 0; ok && i < s->n; i++) v[i] = 1e-3 * sin(1 + 1.7 * (double)i);
  if (ok) v[at] = 1;
  for (int turn = 0; ok && turn < TURNS; turn++) {
    double size = 0;
    for (size_t i = 0; i < s->n; i++) size += v[i] * v[i];
    for (size_t i = 0; i < s->n; i++) b[i] = v[i] / sqrt(size), v[i] = 0;
    ok = add_solution(s, b, v, 1);
  }
  for (size_t i = 0; ok && i < s->n; i++) v[i] *= s->scale[i];
  free(b);
  return ok || vs_error_memory(e, NULL);
}

bool vs_sparse_times(vs_sparse *s, const double *x, double *y) {
  VS_ASSERT(s->matrix);
  if (!s->scale) return multiply(s, 1, x, 0, y, 1);
  double *scaled;
  if (!VS_FRESH(scaled, s->n)) return false;
  for (size_t i = 0; i < s->n; i++) scaled[i] = x[i] / s->scale[i];
  bool ok = multiply(s, 1, scaled, 0, y, 1);
  for (size_t i = 0; i < s->n; i++) y[i] /= s->scale[i];
  free(scaled);
  return ok;
}
