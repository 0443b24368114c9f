/* Declares the plan of a sweep: its sets, the names of their outputs, and the choices of the command line. */
#ifndef VS_CLI_SWEEP_SWEEP_PLAN_H
#define VS_CLI_SWEEP_SWEEP_PLAN_H

#include "cli/options.h"
#include "cli/sweep/parameter_axes.h"

/* An output of each part: the path is `before`, the part's name, and `after`. */
typedef struct { const char *before, *after, *format; } sweep_output;

typedef struct {
  const cli_options *options;
  sweep_memory memory;
  sweep_axes axes;
  sweep_table table;
  sweep_output *outputs; size_t output_count;
  const char *folder;      /* folder of the outputs, the manifest, the table and the sheet; NULL: there is none */
  const char *table_path;  /* path of the table; NULL: standard output */
  const char *sheet_path;  /* path of the contact sheet; NULL: there is none */
  size_t from, to;         /* the parts to run, from index `from` to before `to` */
  const char *only;        /* the range of --only as "1..10", or NULL */
} sweep_plan;

/* Makes the plan of the command line. Returns false after a message. Either way, sweep_plan_free frees it. */
bool sweep_plan_make(sweep_plan *p, const cli_options *o);
void sweep_plan_free(sweep_plan *p);

#endif
