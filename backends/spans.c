/* Implements the writing of many items by several threads (spans.h), each of which makes the text of a span of
 * consecutive items. */
#include "backends/spans.h"

#include "kernel/memory.h"
#include "kernel/threads.h"

enum { SPAN = 1 << 16 /* bytes of text in a span */, TESTS = 1 << 14, SERIAL = 1 << 12 /* with fewer items,
                                                                                                  * one thread writes
                                                                                                  * all of them */ };

typedef struct {
  vs_writer *writer;
  vs_span_fn *fn;
  vs_span_test_fn *test;
  const void *context;
  size_t count, items; /* count: number of all items; items: number of items in each span */
  _Atomic size_t sum;
  struct { char *at, *end; size_t room; } made[VS_PIPELINE_WINDOW];
} spans;

static vs_kernel workers(size_t count, vs_kernel_error *error) {
  *error = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
  return (vs_kernel){ .error = error, .threads = count < SERIAL ? 1 : vs_kernel_threads(NULL) };
}

static bool make_span(vs_kernel *k, void *context, size_t index) {
  spans *s = context;
  size_t at = index % VS_PIPELINE_WINDOW, begin = index * s->items,
         end = s->count - begin < s->items ? s->count : begin + s->items;
  if (!VS_ROOM(k, s->made[at].at, s->made[at].room, SPAN)) return false;
  s->made[at].end = s->fn(s->context, begin, end, s->made[at].at);
  return vs_kernel_report(k, 1);
}

static bool put_span(vs_kernel *k, void *context, size_t index) {
  spans *s = context;
  size_t at = index % VS_PIPELINE_WINDOW;
  (void)k;
  return vs_put(s->writer, s->made[at].at, (size_t)(s->made[at].end - s->made[at].at));
}

bool vs_put_spans(vs_writer *w, size_t count, size_t most, vs_span_fn *fn, const void *context) {
  vs_kernel_error error;
  vs_kernel k = workers(count, &error);
  spans s = { .writer = w, .fn = fn, .context = context, .count = count, .items = SPAN / most };
  bool ok = !w->failed && vs_kernel_pipeline(&k, (count + s.items - 1) / s.items, make_span, put_span, &s);
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) VS_FREE(&k, s.made[i].at, s.made[i].room);
  return ok;
}

static bool count_span(vs_kernel *k, void *context, size_t index) {
  spans *s = context;
  size_t begin = index * TESTS, end = s->count - begin < TESTS ? s->count : begin + TESTS, sum = 0;
  for (size_t i = begin; i < end; i++) sum += s->test(s->context, i);
  atomic_fetch_add(&s->sum, sum);
  return vs_kernel_report(k, 1);
}

bool vs_count_spans(size_t count, vs_span_test_fn *fn, const void *context, size_t *sum) {
  vs_kernel_error error;
  vs_kernel k = workers(count, &error);
  spans s = { .test = fn, .context = context, .count = count };
  bool ok = vs_kernel_run(&k, (count + TESTS - 1) / TESTS, count_span, &s);
  *sum = atomic_load(&s.sum);
  return ok;
}
