/* Declares the evaluation of tapes (numerical expressions) in doubles, for many points at a time. Derivatives by some
 * inputs (slopes) can be computed, too. */
#ifndef VS_GEOMETRY_FUNCTIONS_SAMPLING_H
#define VS_GEOMETRY_FUNCTIONS_SAMPLING_H

#include "geometry/functions/tape.h"

enum { VS_SAMPLE_BATCH = 128, VS_SAMPLE_SLOPES = 3 };

/* Working memory for the evaluation of one tape. The tape must live as long as the sampler. Only one thread at a time
 * may use a sampler. */
typedef struct vs_sampler vs_sampler;

/* Returns a new sampler for tape t. slopes: number of inputs, beginning with the first, by which derivatives are
 * computed; 0 to VS_SAMPLE_SLOPES. Returns NULL when memory is out. */
vs_sampler *vs_sampler_new(const vs_tape *t, int slopes);
void vs_sampler_free(vs_sampler *s);

/* Evaluates the tape at n points. in[k][i]: input k of point i; out[k][i]: receives output k of point i, or NaN if that
 * output has no value. */
void vs_sample(vs_sampler *s, const double *const *in, size_t n, double *const *out);
/* Evaluates n points as vs_sample does, and computes the derivatives of the first output: slope[j][i] receives its
 * derivative by input j at point i. At a kink it is the derivative on one side. */
void vs_sample_slopes(vs_sampler *s, const double *const *in, size_t n, double *const *out, double *const *slope);

/* A range: the values of one coordinate of a grid of points, n equally spaced numbers from a to b, both included. at:
 * index of the current number. */
enum { VS_SAMPLE_KNOWN = 256 };
typedef struct {
  double a, b;
  int64_t n, at;
  double known[VS_SAMPLE_KNOWN]; /* the first VS_SAMPLE_KNOWN values of the range, computed in advance */
} vs_sample_range;
/* Moves the range r to its first value. r->a, b and n must be set, and n > 0. */
void vs_sample_begin(vs_sample_range *r);

/* Stores the next `count` points of a grid, at most VS_SAMPLE_BATCH, and advances: in[k][i] is coordinate k of point i.
 * r: the ranges of the coordinates; the last changes fastest. */
void vs_sample_points(vs_sample_range *r, uint32_t inputs, double (*in)[VS_SAMPLE_BATCH], int count);
/* Returns true if one of the `count` numbers is NaN. */
bool vs_sample_nan(const double *at, int count);

#endif
