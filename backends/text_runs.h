/* Owns the interface of text_runs.c: the runs of a drawing whose text is kept. */
#ifndef VS_BACKENDS_TEXT_RUNS_H
#define VS_BACKENDS_TEXT_RUNS_H

#include "backends/backend.h"

void vs_drive_find_short(vs_drive *d); /* sets brief and facets_at */
void vs_drive_weigh(vs_emitter *e); /* after the plan */

/* The neighbours among which runs are looked for: operands, or what is drawn. */
typedef struct {
  const vs_node *parent; /* the operation; NULL: what is drawn itself */
  const vs_ref *refs;
  size_t count;
  bool body;             /* the only reference is a template's, whose inside is meant */
} vs_run_row;

typedef struct {
  size_t until;          /* the run ends before that neighbour */
  size_t shown;          /* so many of it are not vain */
  bool found;            /* its text has been put out */
} vs_run;

/* Finds the run of the row that begins with neighbour `from`. A run without text stays open until vs_drive_run_end,
 * where it is worth keeping. Fails as e's error says; run->until is set even then. */
bool vs_drive_run(vs_emitter *e, const vs_run_row *row, size_t from, vs_run *run);
void vs_drive_run_end(vs_emitter *e);

#endif
