/* Compresses bytes with zlib. The packed scene of a page compresses well, because equal parts differ only by their
 * places. The format is zlib's (RFC 1950), which every platform can expand; backends/page/packed.js does this. */
#include "backends/x3d/deflate.h"

#include <stddef.h>
#include <string.h>
#include <zlib.h>

#include "geometry/dynamic.h"

#define ZLIB_FUNCTIONS(X) X(deflateInit_) X(deflate) X(deflateEnd)

struct vs_deflate {
#define ZLIB_MEMBER(name) __typeof__(&name) name;
  ZLIB_FUNCTIONS(ZLIB_MEMBER)
#undef ZLIB_MEMBER
  z_stream stream;
  vs_store *store;
  vs_writer *to;
  unsigned char out[1 << 14];
};

static bool zlib_load(vs_deflate *d, vs_error *e) {
  static const vs_dynamic_name names[] = {
#define ZLIB_NAME(name) { #name, offsetof(vs_deflate, name) },
    ZLIB_FUNCTIONS(ZLIB_NAME)
#undef ZLIB_NAME
  };
  return vs_dynamic_load(VS_LIBRARY_ZLIB, "writing .html", names, sizeof names / sizeof *names, d, e);
}

/* zlib's memory comes from the store, so that the memory limit includes it. A head before each block contains the
 * block's size; its 16 bytes keep the alignment of malloc. */
enum { BLOCK_HEAD = 16 };

static voidpf zlib_alloc(voidpf store, uInt items, uInt size) {
  size_t bytes = (size_t)items * size + BLOCK_HEAD;
  unsigned char *block = vs_store_realloc(store, NULL, 0, bytes);
  if (!block) return NULL;
  memcpy(block, &bytes, sizeof bytes);
  return block + BLOCK_HEAD;
}

static void zlib_free(voidpf store, voidpf address) {
  size_t bytes;
  unsigned char *block = (unsigned char *)address - BLOCK_HEAD;
  memcpy(&bytes, block, sizeof bytes);
  vs_store_realloc(store, block, bytes, 0);
}

vs_deflate *vs_deflate_begin(vs_store *store, vs_writer *to, vs_error *e) {
  vs_deflate *d = vs_store_realloc(store, NULL, 0, sizeof *d);
  if (!d) return vs_error_memory(e, NULL), NULL;
  memset(d, 0, offsetof(vs_deflate, out));
  d->store = store;
  d->to = to;
  d->stream.zalloc = zlib_alloc, d->stream.zfree = zlib_free, d->stream.opaque = store;
  bool loaded = zlib_load(d, e);
  if (loaded && d->deflateInit_(&d->stream, Z_DEFAULT_COMPRESSION, ZLIB_VERSION, (int)sizeof d->stream) == Z_OK)
    return d;
  if (loaded) vs_error_memory(e, NULL);
  vs_store_realloc(store, d, sizeof *d, 0);
  return NULL;
}

/* Compresses the stream's input and writes the result. With Z_FINISH it also ends the stream. */
static bool run(vs_deflate *d, int flush) {
  do {
    d->stream.next_out = d->out;
    d->stream.avail_out = sizeof d->out;
    if (d->deflate(&d->stream, flush) == Z_STREAM_ERROR) return false;
    if (!vs_put(d->to, (const char *)d->out, sizeof d->out - d->stream.avail_out)) return false;
  } while (d->stream.avail_out == 0);
  return true;
}

bool vs_deflate_put(void *context, const void *bytes, size_t count) {
  enum { AT_ONCE = 1 << 30 };
  vs_deflate *d = context;
  for (const unsigned char *at = bytes; count;) {
    size_t n = count < AT_ONCE ? count : AT_ONCE;
    d->stream.next_in = (z_const Bytef *)(uintptr_t)at;
    d->stream.avail_in = (uInt)n;
    if (!run(d, Z_NO_FLUSH)) return false;
    at += n, count -= n;
  }
  return !d->to->failed;
}

bool vs_deflate_finish(vs_deflate *d) { return run(d, Z_FINISH); }

void vs_deflate_end(vs_deflate *d) {
  if (!d) return;
  d->deflateEnd(&d->stream);
  vs_store_realloc(d->store, d, sizeof *d, 0);
}
