/* Owns the inputs and outputs of the kernel besides meshes: limits, progress, counts and errors. */
#ifndef VS_KERNEL_KERNEL_OPTIONS_H
#define VS_KERNEL_KERNEL_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/node.h"
#include "model/tally.h"

typedef struct {
  size_t clusters;   /* groups of solids that touch; of these: */
  size_t combined;   /* evaluated */
  size_t copied;     /* copied from an equal cluster of the same problem */
  size_t remembered; /* found in the cache */
  size_t peak;       /* the most bytes allocated at a time */
  size_t coarse;     /* number of leaves whose volume the grid has changed by more than a hundredth: they are too small
                      * for the solids that they touch. The next three describe the first of them: */
  uint32_t coarse_leaf;
  size_t straightened; /* bends removed; see `straight` */
  double coarse_step, coarse_by; /* width of a grid step; relative change of the volume */
  double seconds[VS_STEP_COUNT]; /* of each step of the kernel */
} vs_kernel_counts;

enum { VS_ON_THE_WAY = 8 };
#define VS_SHAPES_OVER "the shapes have more than %zu triangles, %d times the limit of %zu for the result"

typedef struct {
  /* done is in 0..1; the call returns false to stop the work; may be NULL. The kernel calls it some hundred times a
   * second */
  bool (*progress)(void *context, double done);
  void *context;
  size_t max_bytes;     /* limit on the kernel's memory; 0: no limit */
  size_t max_triangles; /* limit on the result; 0: no limit. Intermediate steps may have VS_ON_THE_WAY times as many,
                         * both triangles of the shapes and pieces of them */
  vs_cache *cache;   /* the cache of clusters (model/store/cache.h); NULL: none */
  /* vs_solid_evaluate reports a fault in spite of which it continues; may be NULL */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  vs_kernel_counts *counts; /* the kernel adds to them; the peak only rises; NULL: no counts */
  bool in_levels;       /* for tests: every cluster is treated as a crowded one (arrange/levels.c), if possible */
  bool straight;        /* the kernel may remove bends from cuts through a sheet (a planar facet that the grid has split
                         * into several planes). Callers then look for contacts (round/rounding.h); if there are any,
                         * they evaluate again without this */
  uint32_t threads;     /* 0: one for each processor; the result is the same. Only the caller's thread calls progress */
} vs_kernel_options;

typedef enum {
  VS_KERNEL_FINE,
  VS_KERNEL_OPEN,
  VS_KERNEL_INSIDE_OUT,
  VS_KERNEL_NOT_FINITE,
  VS_KERNEL_OUT_OF_MEMORY,
  VS_KERNEL_LIMIT,
  VS_KERNEL_INTERRUPTED,
  VS_KERNEL_INTERNAL /* a self-check failed: a fault of the kernel, never a wrong result */
} vs_kernel_status;
typedef struct {
  vs_kernel_status status;
  uint32_t leaf;        /* OPEN, INSIDE_OUT, NOT_FINITE: the leaf at fault; INTERNAL: one of the leaves concerned */
  char message[200];    /* plain English without a place */
} vs_kernel_error;

#endif
