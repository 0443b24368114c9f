/* Owns the allocation of the command's large blocks: see large_blocks.c. */
#ifndef VS_CLI_LARGE_BLOCKS_H
#define VS_CLI_LARGE_BLOCKS_H

#include <stddef.h>

/* A vs_alloc_fn: works as realloc; new_size 0 frees, NULL is failure, old_size is the size of the last request. It has
 * no state: any thread may call it. */
void *cli_memory(void *context, void *old, size_t old_size, size_t new_size);

#endif
