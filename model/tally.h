/* Owns the account of a run: which phase took how long and how much memory, and what was counted on the way. The store
 * carries it to whoever works on nodes (vs_store_tally); nobody decides anything by it. */
#ifndef VS_MODEL_TALLY_H
#define VS_MODEL_TALLY_H

#include <stddef.h>
#include <stdint.h>

#include "model/node.h"

typedef enum {
#define VS_PHASE(upper, lower, doc) VS_WORK_##upper,
#include "model/tally.def"
  VS_WORK_NONE, /* nothing runs, or what nobody waits for */
  VS_WORK_COUNT
} vs_work_phase;

typedef enum {
#define VS_STEP(upper, lower, doc) VS_STEP_##upper,
#include "model/steps.def"
  VS_STEP_COUNT
} vs_step;

typedef struct {
  double seconds;
  double growth; /* bytes held at its ends less those at its beginnings */
  size_t peak;   /* the most bytes held while it lasted: by everything, not by it alone */
} vs_phase_use;

typedef struct vs_tally {
  double (*clock)(void *context); /* seconds, monotonic */
  void *context;
  const size_t *held;             /* bytes held now */
  vs_work_phase now;
  double since;
  size_t peak;                    /* of phases that are over */
  size_t from, high;              /* held when this phase came; the most since: whoever hands out memory keeps it */
  vs_phase_use of[VS_WORK_COUNT];
  uint64_t written;               /* bytes of outputs */
  uint64_t clusters, combined, copied, remembered; /* of solids that touch (kernel/cluster.h) */
  uint64_t triangles;             /* written: those of outputs, as their formats have them */
  double steps[VS_STEP_COUNT];    /* seconds, of MESH's */
  /* runs of text that were looked for in the world cache; of those, found; their bytes */
  uint64_t texts, texts_found, bytes_found;
} vs_tally;

/* The phase becomes p; what it was, for the way back. t NULL: nothing is counted. */
vs_work_phase vs_tally_enter(vs_tally *t, vs_work_phase p);
void vs_tally_also(vs_tally *t, size_t bytes); /* so many were held besides, by this phase, for a time */
size_t vs_tally_peak(const vs_tally *t);       /* of all phases, without what was held besides */
vs_tally *vs_store_tally(const vs_store *s);   /* NULL: there is none */
void vs_store_set_tally(vs_store *s, vs_tally *t); /* the caller's; NULL before it goes */

#endif
