/* Declares the writing of a million similar items. Several threads make the bytes of spans of items, and the writer
 * receives the spans in order. */
#ifndef VS_BACKENDS_SPANS_H
#define VS_BACKENDS_SPANS_H

#include "backends/writer.h"

/* Writes the items [begin, end) to `to`, and returns the position after them. It may omit items. */
typedef char *vs_span_fn(const void *context, size_t begin, size_t end, char *to);

/* Writes `count` items with `fn`. `most` is the greatest number of bytes that writing an item changes from its
 * beginning, including bytes after its text. Returns false if the writer has failed, or if memory was out; w->failed is
 * then unset. */
bool vs_put_spans(vs_writer *w, size_t count, size_t most, vs_span_fn *fn, const void *context);

/* Counts the items for which the test returns true. Returns false if memory is out. */
typedef bool vs_span_test_fn(const void *context, size_t item);
bool vs_count_spans(size_t count, vs_span_test_fn *fn, const void *context, size_t *sum);

#endif
