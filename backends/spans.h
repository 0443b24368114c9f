/* Owns what is written in a million equal pieces: threads make the bytes of a span of them, and the writer gets the
 * spans in order. */
#ifndef VS_BACKENDS_SPANS_H
#define VS_BACKENDS_SPANS_H

#include "backends/writer.h"

/* Writes the items [begin, end) from `to` on and returns the place behind them; may leave some out. */
typedef char *vs_span_fn(const void *context, size_t begin, size_t end, char *to);

/* most: the bytes that an item takes at most, and those that are touched behind it. False: the writer has failed; or,
 * with w->failed unset, memory was out. */
bool vs_put_spans(vs_writer *w, size_t count, size_t most, vs_span_fn *fn, const void *context);

/* How many of the items are such; false: out of memory. */
typedef bool vs_span_test_fn(const void *context, size_t item);
bool vs_count_spans(size_t count, vs_span_test_fn *fn, const void *context, size_t *sum);

#endif
