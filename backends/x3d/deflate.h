/* Declares the compression of bytes on their way to a page. It uses zlib, which is loaded at the first compression. */
#ifndef VS_BACKENDS_X3D_DEFLATE_H
#define VS_BACKENDS_X3D_DEFLATE_H

#include "backends/writer.h"
#include "model/node.h"
#include "model/store/store.h"

typedef struct vs_deflate vs_deflate;

/* Returns a compressor that writes into `to`. The caller owns `to`, and ends the compressor with vs_deflate_end.
 * Returns NULL if there is no zlib or memory is out, with the reason in e. The store contains the compressor's working
 * memory, about 270 KB. */
vs_deflate *vs_deflate_begin(vs_store *store, vs_writer *to, vs_error *e);
bool vs_deflate_put(void *context /* points to a vs_deflate */, const void *bytes, size_t count); /* the function is a
                                                                                         * vs_sink_fn */
bool vs_deflate_finish(vs_deflate *d); /* Writes the remaining bytes and the end of the stream. */
void vs_deflate_end(vs_deflate *d /* may be NULL */);

#endif
