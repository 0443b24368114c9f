/* Defines the inputs and outputs of the kernel other than meshes: the job, limits, counts and errors. */
#ifndef VS_KERNEL_KERNEL_OPTIONS_H
#define VS_KERNEL_KERNEL_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/job.h"
#include "model/node.h"

typedef struct {
  size_t clusters;   /* number of groups of solids that touch; it is the sum of the next three members */
  size_t combined;   /* number of clusters that were evaluated */
  size_t copied;     /* number of clusters that were copied from an equal cluster of the same problem */
  size_t remembered; /* number of clusters that were found in the cache */
  size_t peak;       /* greatest number of bytes that were allocated at one time */
  size_t coarse;     /* number of leaves whose volume the grid has changed by more than a hundredth, because they are
                      * too small for its steps. The next three members describe the first such leaf */
  uint32_t coarse_leaf; /* number of the first leaf whose volume the grid has changed by more than a hundredth */
  double coarse_step, coarse_by; /* coarse_step: width of a grid step at this leaf; coarse_by: change of the leaf's
                                  * volume, relative to its exact volume */
  size_t straightened; /* number of bends that were removed from the result (see the option `straight`) */
  double seconds[VS_STEP_COUNT]; /* seconds that each step of the kernel took */
} vs_kernel_counts;

enum { VS_ON_THE_WAY = 8 };
#define VS_SHAPES_OVER "the shapes have more than %zu triangles, %d times the limit of %zu for the result"

typedef struct {
  vs_job *job;          /* job that the kernel calls some hundred times a second (vs_job_done) to learn whether it must
                         * stop; NULL: it never stops */
  size_t max_bytes;     /* limit on the kernel's memory in bytes; 0: no limit */
  size_t max_triangles; /* limit on the triangles of the result; 0: no limit. Intermediate steps may have VS_ON_THE_WAY
                         * times as many triangles and pieces of triangles */
  vs_cache *cache;      /* cache of evaluated clusters (model/store/cache.h); NULL: nothing is cached */
  bool warns;           /* true if vs_solid_evaluate may warn of a fault that does not stop it */
  vs_kernel_counts *counts; /* the kernel adds its counts to these counts; only the peak becomes the greater of the two;
                             * NULL: no counts */
  bool in_levels;       /* for tests: every cluster is arranged level by level (arrange/levels.c) if possible */
  bool straight;        /* true: the kernel may remove bends from cuts through a sheet, which is a planar facet that the
                         * grid has split into several planes. The caller must then search the result for contacts
                         * (round/rounding.h). If there are contacts, it must evaluate again with straight == false */
  uint32_t threads;     /* number of threads; 0: one for each processor. The result does not depend on it. Only the
                         * caller's thread asks the job */
} vs_kernel_options;

typedef enum {
  VS_KERNEL_FINE,
  VS_KERNEL_OPEN,
  VS_KERNEL_INSIDE_OUT,
  VS_KERNEL_NOT_FINITE,
  VS_KERNEL_OUT_OF_MEMORY,
  VS_KERNEL_LIMIT,
  VS_KERNEL_INTERRUPTED,
  VS_KERNEL_INTERNAL /* a self-check of the kernel failed, so it returned no result */
} vs_kernel_status;
typedef struct {
  vs_kernel_status status;
  uint32_t leaf;        /* number of the leaf at fault for OPEN, INSIDE_OUT and NOT_FINITE; for INTERNAL: a leaf of the
                         * cluster that failed */
  char message[200];    /* English text without the place of the fault */
} vs_kernel_error;

#endif
