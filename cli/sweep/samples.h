/* Declares the choice of a sweep's sets: every combination of the axes, or a sample of them. */
#ifndef VS_CLI_SWEEP_SAMPLES_H
#define VS_CLI_SWEEP_SAMPLES_H

#include "cli/sweep/parameter_axes.h"

/* --sample. A Latin hypercube of `count` points has, on each axis, one point in each of `count` equal parts. A Sobol
 * sequence fills the space evenly, and a longer one begins with the same points. */
typedef enum { SWEEP_ALL, SWEEP_LATIN, SWEEP_SOBOL } sweep_sampling;
typedef struct { sweep_sampling how; size_t count; uint64_t seed; } sweep_sample;

/* Reads "lhs:500" or "sobol:500". Returns false if the text is neither. */
bool sweep_sample_read(const char *text, sweep_sample *out);
/* Sets *sets to the sets of the sweep, in order, which live as long as a->memory. Returns false after a message. */
bool sweep_choose(const sweep_axes *a, const sweep_sample *s, sweep_set **sets, size_t *count);

#endif
