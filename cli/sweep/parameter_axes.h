/* Declares the reading of --set of `vs sweep`: the values over which parameters vary. */
#ifndef VS_CLI_SWEEP_PARAMETER_AXES_H
#define VS_CLI_SWEEP_PARAMETER_AXES_H

#include "cli/sweep/sweep_table.h"

/* The choices of one parameter, or the rows of a file, each of which sets several parameters. */
typedef struct {
  sweep_set *sets; size_t count, room;
  const char *range;     /* name of the parameter of a range without steps, from `from` to `to`; NULL: the axis has
                          * sets */
  double from, to;
} sweep_axis;
typedef struct {
  sweep_memory *memory;
  sweep_axis *at; size_t count, room;
} sweep_axes;

/* Appends the axes of a --set: "n=1..10:2", "x=0..1/8", "kind=round,square" or a .csv or .json file. sampled: whether
 * a range needs no steps. Returns false after a message. */
bool sweep_axes_add(sweep_axes *a, const char *text, bool sampled);
/* Appends a set to an axis. Returns false after a message when memory is out. */
bool sweep_axis_put(sweep_axis *axis, sweep_set set);
void sweep_axes_free(sweep_axes *a);

/* Writes a number as text for -D: a whole number as an integer, since a parameter may be exact. */
void sweep_write_number(double x, int digits, char out[40]);

#endif
