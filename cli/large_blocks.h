/* Owns where the command's large blocks come from: see large_blocks.c. */
#ifndef VS_CLI_LARGE_BLOCKS_H
#define VS_CLI_LARGE_BLOCKS_H

#include <stddef.h>

/* As realloc, a vs_alloc_fn: new_size 0 frees, NULL is failure, old_size is what was asked for. Has no state: any
 * thread may call it. */
void *cli_memory(void *context, void *old, size_t old_size, size_t new_size);

#endif
