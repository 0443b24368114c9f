/* Owns the writing of a million equal items: threads make the bytes of a span of them, and the writer gets the spans in
 * order. */
#ifndef VS_BACKENDS_SPANS_H
#define VS_BACKENDS_SPANS_H

#include "backends/writer.h"

/* Writes the items [begin, end) to `to`, and returns the position after them; it may omit some. */
typedef char *vs_span_fn(const void *context, size_t begin, size_t end, char *to);

/* most: the greatest number of bytes that an item takes, with those that writing it touches after it. Returns false
 * when the writer has failed; with w->failed unset, memory was out. */
bool vs_put_spans(vs_writer *w, size_t count, size_t most, vs_span_fn *fn, const void *context);

/* Counts the items for which the test returns true. Returns false when memory is out. */
typedef bool vs_span_test_fn(const void *context, size_t item);
bool vs_count_spans(size_t count, vs_span_test_fn *fn, const void *context, size_t *sum);

#endif
