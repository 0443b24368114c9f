/* Declares the writing of a million similar items. Several threads produce the text of spans (sequences of items), and
 * the writer receives the spans in order. */
#ifndef VS_BACKENDS_SPANS_H
#define VS_BACKENDS_SPANS_H

#include "backends/writer.h"

/* Writes the text of the items [begin, end) to `to`, and returns the position after the text. It may omit items. */
typedef char *vs_span_fn(const void *context, size_t begin, size_t end, char *to);

/* Writes `count` items with the function `fn`. most: greatest number of bytes that `fn` may change for one item, from
 * the beginning of its text on, including bytes after the text. Returns false if the writer has failed, or if memory
 * was out; w->failed is then not set. */
bool vs_put_spans(vs_writer *w, size_t count, size_t most, vs_span_fn *fn, const void *context);

/* Counts the items for which the test returns true. Returns false if memory is out. */
typedef bool vs_span_test_fn(const void *context, size_t item);
bool vs_count_spans(size_t count, vs_span_test_fn *fn, const void *context, size_t *sum);

#endif
