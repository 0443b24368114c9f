/* Declares the results of a sweep: its table as CSV, its contact sheet, and the lines for the best rows. */
#ifndef VS_CLI_SWEEP_SWEEP_RESULTS_H
#define VS_CLI_SWEEP_SWEEP_RESULTS_H

#include "cli/sweep/sweep_table.h"

/* Writes a row for each of the parts: its parameters, its numbers, done or failed, and its outputs. */
void sweep_write_table(FILE *to, const sweep_table *t, const size_t *rows, size_t count);
/* Writes a page with the pictures, or the names, of the parts. path: the page's own path, to which links are
 * relative. */
void sweep_write_sheet(FILE *to, const sweep_table *t, const size_t *rows, size_t count, const char *path);
/* Writes the names and numbers of the first parts. */
void sweep_write_best(FILE *to, const sweep_table *t, const size_t *rows, size_t count);

#endif
