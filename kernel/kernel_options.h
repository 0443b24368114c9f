/* Defines the kernel's inputs and outputs other than meshes: the job that can interrupt it, limits, counts and
 * errors. */
#ifndef VS_KERNEL_KERNEL_OPTIONS_H
#define VS_KERNEL_KERNEL_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/job.h"
#include "model/node.h"

typedef struct {
  size_t clusters;   /* number of clusters (groups of solids that touch): the sum of `combined`, `copied` and
                      * `remembered` */
  size_t combined;   /* number of clusters that the kernel evaluated */
  size_t copied;     /* number of clusters for which the kernel copied the result of an equal cluster of the same
                      * problem */
  size_t remembered; /* number of clusters that the kernel found in the cache */
  size_t peak;       /* greatest number of bytes that the kernel had allocated at one time */
  size_t coarse;     /* Number of leaves whose volume the grid has changed by more than a hundredth, because they are
                      * only some grid steps wide. coarse_leaf, coarse_step and coarse_by describe the first such
                      * leaf. */
  uint32_t coarse_leaf; /* number of the first leaf whose volume the grid has changed by more than a hundredth */
  double coarse_step, coarse_by; /* coarse_step: width of a grid step at leaf coarse_leaf; coarse_by: change of the
                                  * leaf's volume, as a fraction of its exact volume */
  size_t straightened; /* number of bends that were removed: corners where a cut passes between two facets into which
                        * the grid has split one planar facet */
  double seconds[VS_STEP_COUNT]; /* seconds[s]: time that step s of the kernel took */
} vs_kernel_counts;

enum { VS_ON_THE_WAY = 8 };
#define VS_SHAPES_OVER "the shapes have more than %zu triangles, %d times the limit of %zu for the result"

typedef struct {
  vs_job *job;          /* job that the kernel calls some hundred times a second (vs_job_done) to learn whether it must
                         * stop; NULL: it never stops */
  size_t max_bytes;     /* greatest number of bytes that the kernel may allocate; 0: no limit */
  size_t max_triangles; /* greatest number of triangles of the result; 0: no limit. Intermediate steps may have
                         * VS_ON_THE_WAY times as many. */
  vs_cache *cache;      /* cache of evaluated clusters (model/store/cache.h); NULL: nothing is cached */
  bool warns;           /* true if vs_solid_evaluate may report faults that do not stop the kernel */
  vs_kernel_counts *counts; /* The kernel adds its counts to these; NULL: it counts nothing. The member `peak` becomes
                             * the greater of its old value and this call's. */
  bool in_levels;       /* for tests: true if the solids of every cluster are united two by two (arrange/levels.c) where
                         * possible */
  bool straight;        /* True if the kernel may straighten cuts through a planar facet that the grid has split. The
                         * caller must then search the result for contacts (round/rounding.h), and evaluate again with
                         * straight == false if there are any. */
  uint32_t threads;     /* Number of threads; 0: one for each processor. The result does not depend on it. Only the
                         * caller's thread calls vs_job_done. */
} vs_kernel_options;

typedef enum {
  VS_KERNEL_FINE,
  VS_KERNEL_OPEN,
  VS_KERNEL_INSIDE_OUT,
  VS_KERNEL_NOT_FINITE,
  VS_KERNEL_OUT_OF_MEMORY, /* malloc or the limit max_bytes refused a request */
  VS_KERNEL_LIMIT,         /* more triangles, parts or vertices than allowed */
  VS_KERNEL_INTERRUPTED,
  VS_KERNEL_INTERNAL /* a self-check of the kernel failed, so it returned no result */
} vs_kernel_status;
typedef struct {
  vs_kernel_status status;
  uint32_t leaf;        /* number of the faulty leaf for the statuses OPEN, INSIDE_OUT and NOT_FINITE; for the status
                         * INTERNAL: a leaf of the cluster whose evaluation failed */
  char message[200];    /* message in English, without the place of the fault in the user's file */
} vs_kernel_error;

#endif
