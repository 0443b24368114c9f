/* Declares systems of linear equations whose matrix is sparse, symmetric and positive definite. CHOLMOD, which is
 * loaded at the first use, orders and factors the matrix. */
#ifndef VS_GEOMETRY_STRUCTURE_SPARSE_SYSTEM_H
#define VS_GEOMETRY_STRUCTURE_SPARSE_SYSTEM_H

#include <stdbool.h>
#include <stddef.h>

#include "model/model_error.h"

typedef struct vs_sparse vs_sparse;

/* Returns an empty matrix of n rows (n is above 0) with room for `entries` calls of vs_sparse_add. The caller frees the
 * matrix by vs_sparse_free. Returns NULL and sets *e when memory is out or CHOLMOD is missing; purpose is the feature
 * that the message names. */
vs_sparse *vs_sparse_new(size_t n, size_t entries, const char *purpose, vs_error *e);
void vs_sparse_free(vs_sparse *s); /* s may be NULL */

/* Adds v to the entries (i, j) and (j, i). Entries may be added to several times. */
void vs_sparse_add(vs_sparse *s, size_t i, size_t j, double v);
/* Ends the adding. If `scaled`, the matrix is kept as D A D with the diagonal 1, which all functions below hide. All
 * diagonal entries are then above 0. Returns false when memory is out. */
bool vs_sparse_close(vs_sparse *s, bool scaled, vs_error *e);

/* Factors a closed, scaled matrix. *least: the smallest pivot of D A D, or 0 if the matrix is singular; *at: its row.
 * Returns false when memory is out. */
bool vs_sparse_factor(vs_sparse *s, double *least, size_t *at, vs_error *e);
/* Replaces `sides` columns of n numbers each, the right sides, by the solutions, with one step of refinement. The
 * matrix has been factored. Returns false when memory is out. */
bool vs_sparse_solve(vs_sparse *s, double *x, size_t sides, vs_error *e);
/* Sets v to the n numbers of a vector that the matrix nearly maps to 0, for a matrix whose smallest pivot, in row `at`,
 * is nearly 0. Returns false when memory is out. */
bool vs_sparse_softest(vs_sparse *s, size_t at, double *v, vs_error *e);
/* Sets y to the product of the closed matrix and x. Returns false when memory is out. */
bool vs_sparse_times(vs_sparse *s, const double *x, double *y);

#endif
