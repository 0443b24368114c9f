/* Declares the search for the eigenvectors of A x = m K x with the greatest m, for sparse symmetric matrices. */
#ifndef VS_GEOMETRY_STRUCTURE_EIGENPAIRS_H
#define VS_GEOMETRY_STRUCTURE_EIGENPAIRS_H

#include "geometry/structure/sparse_system.h"
#include "model/long_work.h"

typedef enum {
  VS_EIGEN_DONE,
  VS_EIGEN_SLOW, /* the iteration has not converged */
  VS_EIGEN_STOPPED,
  VS_EIGEN_FAILED
} vs_eigen_outcome;

/* Finds the `want` greatest eigenvalues, in descending order, and their vectors: vectors[i * n + row], of length 1 in
 * the scalar product of K. `k` has been factored; n is the number of rows of k and a. `*found`: number of pairs, at
 * most n. */
vs_eigen_outcome vs_eigenpairs(vs_sparse *k, vs_sparse *a, size_t n, size_t want, vs_long_work work, double *values,
                               double *vectors, size_t *found, vs_error *e);

#endif
