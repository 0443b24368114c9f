/* Owns the interface of squeezing: bytes on their way to a page get shorter where they repeat what came before. */
#ifndef VS_BACKENDS_SQUEEZE_H
#define VS_BACKENDS_SQUEEZE_H

#include "backends/writer.h"

#define VS_SQUEEZED "VSL1" /* The text begins with it; the caller writes it. */

enum { VS_SQUEEZE_WINDOW = 1 << 18, VS_SQUEEZE_HEADS = 1 << 16 };

/* The caller owns it, and clears it before the first byte. */
typedef struct {
  vs_writer *to;   /* gets the sequences; not owned */
  size_t filled;   /* bytes of `at` */
  size_t squeezed; /* of these, how many are written */
  uint32_t head[VS_SQUEEZE_HEADS];          /* by a hash of four bytes: where they stood last, from 1; 0: nowhere */
  unsigned char at[2 * VS_SQUEEZE_WINDOW];  /* bytes that matches reach, and those that wait */
} vs_squeeze;

bool vs_squeeze_put(void *context /* a vs_squeeze */, const void *bytes, size_t count); /* a vs_sink_fn */
bool vs_squeeze_end(vs_squeeze *s); /* Writes what waits. */

#endif
