/* Owns the interface of text_runs.c: the runs of a drawing whose text is kept. */
#ifndef VS_BACKENDS_TEXT_RUNS_H
#define VS_BACKENDS_TEXT_RUNS_H

#include "backends/backend.h"

void vs_drive_find_short(vs_drive *d); /* sets brief and facets_at */
void vs_drive_weigh(vs_emitter *e); /* sets the weights of the entries, after the plan */

/* The neighbours among which the driver looks for runs: operands, or the drawn objects. */
typedef struct {
  const vs_node *parent; /* the operation; NULL: the drawing itself */
  const vs_ref *refs;
  size_t count;
  bool body;             /* the only reference is a template's, and its contents are meant */
} vs_run_row;

typedef struct {
  size_t until;          /* the run ends before that neighbour */
  size_t shown;          /* the number of nodes in it that are not vain */
  bool found;            /* its text has been written */
} vs_run;

/* Finds the run of the row that begins with neighbour `from`, and writes its text if that was kept. A run without
 * kept text stays open until vs_drive_run_end if it is worth keeping. Fails with e's error set; run->until is set
 * even then. */
bool vs_drive_run(vs_emitter *e, const vs_run_row *row, size_t from, vs_run *run);
void vs_drive_run_end(vs_emitter *e);

#endif
