/* Declares systems of linear equations whose matrix is sparse, symmetric and positive definite. The library CHOLMOD,
 * loaded at the first use, orders and factors the matrix. */
#ifndef VS_GEOMETRY_STRUCTURE_SPARSE_SYSTEM_H
#define VS_GEOMETRY_STRUCTURE_SPARSE_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

#include "model/model_error.h"

typedef struct vs_sparse vs_sparse;

/* Returns an empty matrix of n > 0 rows. entries: greatest number of calls of vs_sparse_add; purpose: the feature that
 * needs CHOLMOD, for the message. Returns NULL and sets *e when memory is out or CHOLMOD is missing. The caller frees
 * the matrix with vs_sparse_free. */
vs_sparse *vs_sparse_new(size_t n, size_t entries, const char *purpose, vs_error *e);
void vs_sparse_free(vs_sparse *s); /* frees s, which may be NULL */

/* Adds v to the entries (i, j) and (j, i) of the matrix. May be called several times for one entry. */
void vs_sparse_add(vs_sparse *s, size_t i, size_t j, double v);
/* Completes the matrix, to which no entries can then be added. If `scaled` is true, it is stored as D A D with the
 * diagonal 1; the functions below undo this scaling in their results. All diagonal entries must then be above 0.
 * Returns false when memory is out. */
bool vs_sparse_close(vs_sparse *s, bool scaled, vs_error *e);

/* Factors a completed, scaled matrix. *least: its smallest pivot (1 for a diagonal matrix), or 0 if the matrix is
 * singular; *at: row of this pivot. Returns false when memory is out. */
bool vs_sparse_factor(vs_sparse *s, double *least, size_t *at, vs_error *e);
/* Solves the equations: replaces the `sides` columns of x, right sides of n numbers each, by the solutions, with one
 * step of refinement. The matrix has been factored. Returns false when memory is out. */
bool vs_sparse_solve(vs_sparse *s, double *x, size_t sides, vs_error *e);
/* For a nearly singular matrix, sets v to a vector that it nearly maps to 0; v has n numbers. at: row of its smallest
 * pivot. Returns false when memory is out. */
bool vs_sparse_softest(vs_sparse *s, size_t at, double *v, vs_error *e);
/* Sets y to the product of the completed matrix and x. Returns false when memory is out. */
bool vs_sparse_times(vs_sparse *s, const double *x, double *y);

#endif
