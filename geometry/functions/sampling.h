/* Declares the evaluation of tapes in doubles: for many points at a time, with or without slopes along some inputs. */
#ifndef VS_GEOMETRY_FUNCTIONS_SAMPLING_H
#define VS_GEOMETRY_FUNCTIONS_SAMPLING_H

#include "geometry/functions/tape.h"

enum { VS_SAMPLE_BATCH = 128, VS_SAMPLE_SLOPES = 3 };

/* Working memory for one tape, which must live as long. Only one thread at a time may use a sampler. */
typedef struct vs_sampler vs_sampler;

/* Returns a new sampler. `slopes`: the number of first inputs with slopes, 0 to VS_SAMPLE_SLOPES. NULL: out of
 * memory. */
vs_sampler *vs_sampler_new(const vs_tape *t, int slopes);
void vs_sampler_free(vs_sampler *s);

/* Evaluates n points. in[k][i] is input k of point i; out[k][i] becomes output k of it. A point without a value gives
 * NaN. */
void vs_sample(vs_sampler *s, const double *const *in, size_t n, double *const *out);
/* Does the same with slopes of the first output: slope[j][i] is that of point i along input j. At a kink it is one of
 * the slopes. */
void vs_sample_slopes(vs_sampler *s, const double *const *in, size_t n, double *const *out, double *const *slope);

/* The values of one parameter in a grid: n numbers from a to b, both included. `at` is the index of the current one. */
enum { VS_SAMPLE_KNOWN = 256 };
typedef struct {
  double a, b;
  int64_t n, at;
  double known[VS_SAMPLE_KNOWN]; /* the first values */
} vs_sample_range;
/* Begins the walk; a, b and n > 0 are set. */
void vs_sample_begin(vs_sample_range *r);

/* Fills in[i][0 ... count) with the parameters of the next points of the grid, the last range innermost, and advances.
 * There is a range, and count is at most VS_SAMPLE_BATCH. */
void vs_sample_points(vs_sample_range *r, uint32_t inputs, double (*in)[VS_SAMPLE_BATCH], int count);
/* Returns true if one of the numbers is NaN. */
bool vs_sample_nan(const double *at, int count);

#endif
