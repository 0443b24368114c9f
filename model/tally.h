/* Owns the account of a run: the time and memory of each phase, and other counts. The store carries it to all who work
 * on nodes (vs_store_tally); no result depends on it. */
#ifndef VS_MODEL_TALLY_H
#define VS_MODEL_TALLY_H

#include <stddef.h>
#include <stdint.h>

#include "model/node.h"

typedef enum {
#define VS_PHASE(upper, lower, doc) VS_WORK_##upper,
#include "model/tally.def"
  VS_WORK_NONE, /* nothing runs, or only work that no one waits for */
  VS_WORK_COUNT
} vs_work_phase;

typedef enum {
#define VS_STEP(upper, lower, doc) VS_STEP_##upper,
#include "model/steps.def"
  VS_STEP_COUNT
} vs_step;

typedef struct {
  double seconds;
  double growth; /* the bytes held at the ends of the phase minus those at its beginnings */
  size_t peak;   /* the most bytes held during the phase, by all phases */
} vs_phase_use;

typedef struct vs_tally {
  double (*clock)(void *context); /* seconds, monotonic */
  void *context;
  const size_t *held;             /* bytes held now */
  vs_work_phase now;
  double since;
  size_t peak;                    /* of finished phases */
  size_t from, high;              /* the bytes held at the begin of this phase; the most since: each allocator updates
                                   * it */
  vs_phase_use of[VS_WORK_COUNT];
  uint64_t written;               /* bytes of outputs */
  uint64_t clusters, combined, copied, remembered; /* of solids that touch (kernel/cluster.h) */
  uint64_t triangles;             /* written: those of outputs, in the form of their formats */
  double steps[VS_STEP_COUNT];    /* seconds, steps of MESH */
  /* runs of text that were looked for in the world cache; of those, found; their bytes */
  uint64_t texts, texts_found, bytes_found;
} vs_tally;

/* Begins phase p, and returns the previous one, for the return. t NULL: nothing is counted. */
vs_work_phase vs_tally_enter(vs_tally *t, vs_work_phase p);
void vs_tally_also(vs_tally *t, size_t bytes); /* counts bytes that this phase held for a time outside of `held` */
size_t vs_tally_peak(const vs_tally *t);       /* the most of all phases, without those of vs_tally_also */
vs_tally *vs_store_tally(const vs_store *s);   /* NULL: there is none */
void vs_store_set_tally(vs_store *s, vs_tally *t); /* the caller owns it, and sets NULL before it frees it */

#endif
