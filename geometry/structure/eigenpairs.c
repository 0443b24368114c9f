/* Implements the search for eigenvectors by subspace iteration (eigenpairs.h).
 *
 * In each step, a block of vectors x is replaced by the solutions y of K y = A x. This strengthens the eigenvectors
 * whose eigenvalues have the greatest absolute values. LAPACK then finds the best combinations of the block's vectors,
 * and vectors that have become dependent are replaced. For a small problem, the block has as many vectors as the matrix
 * has rows; one step is then exact. */
#include "geometry/structure/eigenpairs.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "geometry/dynamic.h"
#include "model/store/array.h"

enum { WHOLE = 150 /* greatest number of rows for which the block contains as many vectors as rows */, STEPS = 300 };
#define SETTLED 1e-11 /* greatest relative change of the wanted eigenvalues in a step at which the iteration ends */

typedef void dsyev(const char *job, const char *half, const int *n, double *a, const int *lda, double *w, double *work,
                   const int *room, int *info, size_t job_length, size_t half_length);
typedef struct { dsyev *solve; } lapack;

static bool load(lapack *out, vs_error *e) {
  static const vs_dynamic_name names[] = { { "dsyev_", offsetof(lapack, solve) } };
  return vs_dynamic_load(VS_LIBRARY_LAPACK, "modes of frames", names, sizeof names / sizeof *names, out, e);
}

typedef struct {
  vs_sparse *k, *a;
  size_t n, q;        /* n: number of rows of the matrices; q: number of vectors in the block */
  double *x, *kx, *y; /* x: the block of vectors; kx: K times x; y: working memory; each has q columns of n numbers */
  double *small, *values, *before, *room;
  uint64_t random;
  lapack call;
} block;

static double some(block *b) {
  b->random = b->random * 6364136223846793005u + 1442695040888963407u;
  return (double)(b->random >> 11) / (double)(1ull << 53) - 0.5;
}

static double product(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/* Makes the columns of x orthogonal and of length 1, in the scalar product of K. Replaces a column that depends on
 * others by a random one. Returns false on failure. */
static bool orthogonalise(block *b, vs_error *e) {
  size_t n = b->n;
  for (size_t j = 0; j < b->q; j++) {
    double *x = b->x + j * n, *kx = b->kx + j * n;
    for (int tries = 0;; tries++) {
      if (!vs_sparse_times(b->k, x, kx)) return vs_error_memory(e, NULL);
      double size = sqrt(fmax(0, product(x, kx, n))), rest = size;
      for (int turn = 0; turn < 2; turn++)
        for (size_t i = 0; i < j; i++) {
          double part = product(b->kx + i * n, x, n);
          for (size_t r = 0; r < n; r++) x[r] -= part * b->x[i * n + r];
        }
      if (!vs_sparse_times(b->k, x, kx)) return vs_error_memory(e, NULL);
      rest = sqrt(fmax(0, product(x, kx, n)));
      if (rest > 1e-10 * size && rest > 0) {
        for (size_t r = 0; r < n; r++) x[r] /= rest, kx[r] /= rest;
        break;
      }
      if (tries == 8) return vs_error_set(e, VS_ERROR_MODEL, NULL, "the modes cannot be told apart");
      for (size_t r = 0; r < n; r++) x[r] = some(b);
      if (b->q < n && !vs_sparse_solve(b->k, x, 1, e)) return false;
    }
  }
  return true;
}

/* Replaces the columns of x by combinations that best approximate eigenvectors; those with the greatest eigenvalues
 * come first. y is overwritten. Returns false on failure. */
static bool combine(block *b, vs_error *e) {
  size_t n = b->n, q = b->q;
  for (size_t j = 0; j < q; j++)
    if (!vs_sparse_times(b->a, b->x + j * n, b->y + j * n)) return vs_error_memory(e, NULL);
  for (size_t i = 0; i < q; i++)
    for (size_t j = 0; j < q; j++) b->small[i * q + j] = product(b->x + i * n, b->y + j * n, n);
  int order = (int)q, room = (int)(4 * q + 8), info = 0;
  b->call.solve("V", "U", &order, b->small, &order, b->values, b->room, &room, &info, 1, 1);
  if (info) return vs_error_set(e, VS_ERROR_MODEL, NULL, "the modes cannot be told apart");
  memset(b->y, 0, q * n * sizeof *b->y);
  for (size_t j = 0; j < q; j++) /* LAPACK returns the eigenvalues in ascending order, so the loop reads the vectors
                                  * from the last to the first */
    for (size_t i = 0; i < q; i++)
      for (size_t r = 0; r < n; r++) b->y[j * n + r] += b->small[(q - 1 - j) * q + i] * b->x[i * n + r];
  memcpy(b->x, b->y, q * n * sizeof *b->x);
  return true;
}

static bool settled(const block *b, size_t want) {
  for (size_t i = 0; i < want; i++) {
    double v = b->values[b->q - 1 - i];
    if (!(fabs(v - b->before[b->q - 1 - i]) <= SETTLED * fabs(v))) return false;
  }
  return true;
}

static vs_eigen_outcome iterate(block *b, size_t want, vs_long_work work, vs_error *e) {
  size_t n = b->n, q = b->q;
  bool whole = q == n;
  for (size_t i = 0; i < q * n; i++) b->x[i] = whole ? i / n == i % n : some(b);
  for (size_t i = 0; i < q; i++) b->before[i] = HUGE_VAL;
  for (int step = 0; step < STEPS; step++) {
    if (work.going && !work.going(work.context, (double)step / STEPS)) return VS_EIGEN_STOPPED;
    if (!orthogonalise(b, e) || !combine(b, e)) return VS_EIGEN_FAILED;
    if (whole || settled(b, want)) return VS_EIGEN_DONE;
    memcpy(b->before, b->values, q * sizeof *b->before);
    for (size_t j = 0; j < q; j++) {
      if (!vs_sparse_times(b->a, b->x + j * n, b->y + j * n)) return vs_error_memory(e, NULL), VS_EIGEN_FAILED;
    }
    if (!vs_sparse_solve(b->k, b->y, q, e)) return VS_EIGEN_FAILED;
    memcpy(b->x, b->y, q * n * sizeof *b->x);
  }
  return VS_EIGEN_SLOW;
}

vs_eigen_outcome vs_eigenpairs(vs_sparse *k, vs_sparse *a, size_t n, size_t want, vs_long_work work, double *values,
                               double *vectors, size_t *found, vs_error *e) {
  block b = { .k = k, .a = a, .n = n, .random = 63 };
  vs_eigen_outcome outcome = VS_EIGEN_FAILED;
  VS_ASSERT(n > 0 && want > 0);
  if (!load(&b.call, e)) return VS_EIGEN_FAILED;
  *found = want < n ? want : n;
  b.q = 2 * *found + 14;
  if (b.q > n || n <= WHOLE) b.q = n;
  size_t q = b.q;
  if (VS_FRESH(b.x, q * n) && VS_FRESH(b.kx, q * n) && VS_FRESH(b.y, q * n) && VS_FRESH(b.small, q * q) &&
      VS_FRESH(b.values, q) && VS_FRESH(b.before, q) && VS_FRESH(b.room, 4 * q + 8))
    outcome = iterate(&b, *found, work, e);
  else
    vs_error_memory(e, NULL);
  for (size_t i = 0; outcome == VS_EIGEN_DONE && i < *found; i++) {
    values[i] = b.values[q - 1 - i];
    memcpy(vectors + i * n, b.x + i * n, n * sizeof *vectors);
  }
  free(b.x), free(b.kx), free(b.y), free(b.small), free(b.values), free(b.before), free(b.room);
  return outcome;
}
