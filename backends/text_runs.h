/* Declares the runs of a drawing: sequences of shapes whose text is cached (text_runs.c). */
#ifndef VS_BACKENDS_TEXT_RUNS_H
#define VS_BACKENDS_TEXT_RUNS_H

#include "backends/backend.h"

void vs_drive_find_short(vs_drive *d); /* sets the members brief and facets_at of d, which say for each kind whether its
                                        * text is short */
void vs_drive_weigh(vs_emitter *e); /* sets the weights of the plan's entries, which estimate the length of their
                                     * text */

/* A row of neighbours among which the driver finds runs: the operands of an operation, or the drawn objects. */
typedef struct {
  const vs_node *parent; /* operation that contains the neighbours; NULL: the drawing itself */
  const vs_ref *refs;
  size_t count;
  bool body;             /* whether the row is a single reference to a template, whose contents are the run */
} vs_run_row;

typedef struct {
  size_t until;          /* index of the neighbour before which the run ends */
  size_t shown;          /* number of nodes in the run that draw something */
  bool found;            /* whether the run's text was found in the cache and written */
} vs_run;

/* Finds the run (sequence of shapes whose text is cached) that begins at neighbour `from` of the row. If its text is in
 * the cache, writes it; otherwise, if it is worth caching, records it until vs_drive_run_end. Returns false, with e's
 * error set, on failure. */
bool vs_drive_run(vs_emitter *e, const vs_run_row *row, size_t from, vs_run *run);
void vs_drive_run_end(vs_emitter *e);

#endif
