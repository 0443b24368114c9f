/* Owns what a caller of the kernel says and is told besides meshes: limits, progress, counts, errors. */
#ifndef VS_KERNEL_KERNEL_OPTIONS_H
#define VS_KERNEL_KERNEL_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/node.h"
#include "model/tally.h"

typedef struct {
  size_t clusters;   /* of solids that touch; of those: */
  size_t combined;   /* worked out */
  size_t copied;     /* as another of the same problem, elsewhere */
  size_t remembered; /* found in the cache */
  size_t peak;       /* the most bytes held at a time */
  size_t coarse;     /* leaves whose volume the grid has changed by more than a hundredth: too small for what they
                      * touch; and of the first of them: */
  uint32_t coarse_leaf;
  size_t straightened; /* bends that were left out; see `straight` */
  double coarse_step, coarse_by; /* how wide a step is; how much it changed the volume, as a part of that */
  double seconds[VS_STEP_COUNT]; /* of its steps */
} vs_kernel_counts;

enum { VS_ON_THE_WAY = 8 };
#define VS_SHAPES_OVER "the shapes have more than %zu triangles, %d times the limit of %zu for the result"

typedef struct {
  /* done in 0..1; false stops the work; may be NULL. Called some hundred times a second */
  bool (*progress)(void *context, double done);
  void *context;
  size_t max_bytes;     /* of the kernel's own memory; 0: no limit */
  size_t max_triangles; /* of the result; 0: no limit. On the way to it there may be VS_ON_THE_WAY times as many, of
                         * shapes and of what they are cut into */
  vs_cache *cache;   /* where clusters are looked up and kept (model/store/cache.h); NULL: nowhere */
  /* of what is done all the same, by vs_solid_evaluate; may be NULL */
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  vs_kernel_counts *counts; /* added to, but for the peak, which only rises; NULL: nobody asks */
  bool in_levels;       /* for tests: every cluster goes the way of crowded ones (arrange/levels.c), as far as it can */
  bool straight;        /* cuts through a planar facet of which the grid has made several planes may lose their bends.
                         * For callers who look for contacts afterwards (round/rounding.h) and, where there are any, ask
                         * again without this */
  uint32_t threads;     /* 0: as many as there are processors; the result is the same. progress is called from the
                         * caller's alone */
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
  uint32_t leaf;        /* OPEN, INSIDE_OUT, NOT_FINITE: which one; INTERNAL: one of those concerned */
  char message[200];    /* plain English without a place */
} vs_kernel_error;

#endif
