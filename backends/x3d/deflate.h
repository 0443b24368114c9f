/* Owns the interface of deflating: bytes on their way to a page are compressed by zlib, which is loaded for it. */
#ifndef VS_BACKENDS_X3D_DEFLATE_H
#define VS_BACKENDS_X3D_DEFLATE_H

#include "backends/writer.h"
#include "model/node.h"
#include "model/store/store.h"

typedef struct vs_deflate vs_deflate;

/* Returns what compresses into `to`, which is not owned; the caller ends it. NULL: no zlib, or no memory; e says
 * which. Its working memory, some 270 KB, is the store's. */
vs_deflate *vs_deflate_begin(vs_store *store, vs_writer *to, vs_error *e);
bool vs_deflate_put(void *context /* a vs_deflate */, const void *bytes, size_t count); /* a vs_sink_fn */
bool vs_deflate_finish(vs_deflate *d); /* Writes what waits. */
void vs_deflate_end(vs_deflate *d /* or NULL */);

#endif
