/* Declares the allocation of the large blocks of memory of the command vs, implemented in large_blocks.c. */
#ifndef VS_CLI_LARGE_BLOCKS_H
#define VS_CLI_LARGE_BLOCKS_H

#include <stddef.h>

/* Reallocates like realloc: new_size 0 frees, and NULL means failure. old_size is the size last requested. Any thread
 * may call it, since it has no state. Its type is vs_alloc_fn. */
void *cli_memory(void *context, void *old, size_t old_size, size_t new_size);

#endif
