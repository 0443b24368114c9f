/* Declares the choice of a sweep's sets: every combination of the axes, or a sample of them. */
#ifndef VS_CLI_SWEEP_SAMPLES_H
#define VS_CLI_SWEEP_SAMPLES_H

#include "cli/sweep/parameter_axes.h"

/* The kinds of --sample. A Latin hypercube of n points has one point in each of n equal parts of every axis. A Sobol
 * sequence fills the space evenly. */
typedef enum { SWEEP_ALL, SWEEP_LATIN, SWEEP_SOBOL } sweep_sampling;
typedef struct { sweep_sampling how; size_t count; uint64_t seed; } sweep_sample;

/* Reads "lhs:500" or "sobol:500". Returns false if the text is neither. */
bool sweep_sample_read(const char *text, sweep_sample *out);
/* Sets *sets to the sets of parameters to run, in order. They live as long as a->memory. Returns false after a
 * message. */
bool sweep_choose(const sweep_axes *a, const sweep_sample *s, sweep_set **sets, size_t *count);

#endif
