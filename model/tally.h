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
  VS_WORK_NONE, /* no work is done, or work for which nobody waits */
  VS_WORK_COUNT
} vs_work_phase;

typedef enum {
#define VS_STEP(upper, lower, doc) VS_STEP_##upper,
#include "model/steps.def"
  VS_STEP_COUNT
} vs_step;

typedef struct {
  double seconds;
  double growth; /* change in the number of bytes in use from beginning to end of the phase, summed over all times that
                  * it was active */
  size_t peak;   /* greatest number of bytes that all phases together used while this phase was active */
} vs_phase_use;

typedef struct vs_tally {
  const size_t *held;             /* address of the number of bytes that the program uses now */
  vs_work_phase now;
  double since;
  size_t peak;                    /* greatest number of bytes that were in use during the finished phases */
  size_t from, high;              /* from: number of bytes in use when the current phase began; high: greatest number
                                   * since then, which each allocator updates */
  vs_phase_use of[VS_WORK_COUNT];
  uint64_t written;               /* number of bytes written to output files */
  uint64_t clusters, combined, copied, remembered; /* clusters: number of groups of touching solids. Of these, combined:
                                                    * number that were evaluated; copied: number copied from an equal
                                                    * one; remembered: number found in the cache. */
  uint64_t triangles;             /* number of triangles in outputs, as their formats write them */
  double steps[VS_STEP_COUNT];    /* steps[s]: seconds that step s of meshing took */
  /* Pieces of output text that were searched in the world cache. texts: number searched; texts_found: number found;
   * bytes_found: bytes of those that were found. */
  uint64_t texts, texts_found, bytes_found;
} vs_tally;

double vs_clock(void); /* returns the seconds of a clock that is never set back */
/* Begins phase p of the account t. Returns the phase that was active before, which the caller enters again later. If t
 * is NULL, nothing is counted. */
vs_work_phase vs_tally_enter(vs_tally *t, vs_work_phase p);
void vs_tally_also(vs_tally *t, size_t bytes); /* Adds `bytes` bytes to the memory of the current phase: memory that it
                                                * used temporarily and that t->held does not contain. */
size_t vs_tally_peak(const vs_tally *t);       /* Returns the greatest number of bytes that were in use in any phase,
                                                * without those added by vs_tally_also. */

#endif
