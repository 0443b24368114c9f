/* Owns the interface of deflating: zlib, which vs loads for this, compresses bytes on their way to a page. */
#ifndef VS_BACKENDS_X3D_DEFLATE_H
#define VS_BACKENDS_X3D_DEFLATE_H

#include "backends/writer.h"
#include "model/node.h"
#include "model/store/store.h"

typedef struct vs_deflate vs_deflate;

/* Returns a compressor that writes into `to`, which the caller owns; the caller ends it with vs_deflate_end. NULL: no
 * zlib, or memory is out; e says which. The store holds its working memory, some 270 KB. */
vs_deflate *vs_deflate_begin(vs_store *store, vs_writer *to, vs_error *e);
bool vs_deflate_put(void *context /* a vs_deflate */, const void *bytes, size_t count); /* a vs_sink_fn */
bool vs_deflate_finish(vs_deflate *d); /* Writes the rest. */
void vs_deflate_end(vs_deflate *d /* or NULL */);

#endif
