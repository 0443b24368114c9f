/* Declares the account of a run: the time and memory of each phase, and other counts. A job contains the address of the
 * account, for all code that works on nodes (vs_store_tally in job.h). No result of the run depends on the account. */
#ifndef VS_MODEL_TALLY_H
#define VS_MODEL_TALLY_H

#include <stddef.h>
#include <stdint.h>

#include "model/node.h"

typedef enum {
#define VS_PHASE(upper, lower, doc) VS_WORK_##upper,
#include "model/tally.def"
  VS_WORK_NONE, /* phase in which no work is done, or work for which nobody waits */
  VS_WORK_COUNT
} vs_work_phase;

typedef enum {
#define VS_STEP(upper, lower, doc) VS_STEP_##upper,
#include "model/steps.def"
  VS_STEP_COUNT
} vs_step;

typedef struct {
  double seconds;
  double growth; /* sum over all times the phase was active: bytes in use at its end minus bytes in use at its
                  * beginning */
  size_t peak;   /* greatest number of bytes that all phases together used while this phase was active */
} vs_phase_use;

typedef struct vs_tally {
  const size_t *held;             /* address of the number of bytes that the program currently uses */
  vs_work_phase now;
  double since;
  size_t peak;                    /* greatest number of bytes that were in use during the finished phases */
  size_t from, high;              /* from: number of bytes in use when the current phase began; high: greatest number
                                   * since then, updated by each allocator */
  vs_phase_use of[VS_WORK_COUNT];
  uint64_t written;               /* number of bytes written to output files */
  uint64_t clusters, combined, copied, remembered; /* clusters: number of groups of touching solids; combined, copied,
                                                    * remembered: how many of them were evaluated, copied from equal
                                                    * ones, or found in the cache */
  uint64_t triangles;             /* number of triangles in outputs, as their formats write them */
  double steps[VS_STEP_COUNT];    /* steps[s]: seconds that step s of meshing took */
  /* Counts of pieces of output text in the world cache: how many were searched, how many were found, and the bytes of
   * the found ones. */
  uint64_t texts, texts_found, bytes_found;
} vs_tally;

double vs_clock(void); /* returns the time in seconds of a clock that never goes back */
/* Begins phase p of the account t and returns the previous phase, to which the caller later returns. If t is NULL,
 * nothing is counted. */
vs_work_phase vs_tally_enter(vs_tally *t, vs_work_phase p);
void vs_tally_also(vs_tally *t, size_t bytes); /* Counts `bytes` bytes that the current phase used temporarily and that
                                                * t->held does not contain. */
size_t vs_tally_peak(const vs_tally *t);       /* Returns the greatest number of bytes that were in use in any phase,
                                                * without the bytes counted by vs_tally_also. */

#endif
