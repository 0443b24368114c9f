/* Owns the interface of text_runs.c: the runs of a drawing whose text is kept. */
#ifndef VS_BACKENDS_TEXT_RUNS_H
#define VS_BACKENDS_TEXT_RUNS_H

#include "backends/backend.h"

void vs_drive_find_short(vs_drive *d); /* sets brief and facets_at */
void vs_drive_weigh(vs_emitter *e); /* after the plan */
/* Which of refs from `from` on are a run: up to *until, `shown` of them not vain. found: its text has been put out.
 * Else, where it is worth keeping, it is open until vs_drive_run_end. body: the one reference is a template's, whose
 * inside is meant. parent NULL: what is drawn itself. */
bool vs_drive_run(vs_emitter *e, const vs_node *parent, const vs_ref *refs, size_t count, size_t from, bool body,
                  size_t *until, size_t *shown, bool *found);
void vs_drive_run_end(vs_emitter *e);

#endif
