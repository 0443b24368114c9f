/* Declares the allocation of small pieces of a store's memory, of which there may be millions. */
#ifndef VS_MODEL_STORE_PIECE_H
#define VS_MODEL_STORE_PIECE_H

#include "model/store/store.h"

/* Returns a piece of memory of `bytes` bytes, or NULL when memory is out. The caller frees it by vs_store_piece_free
 * with the same number of bytes. */
void *vs_store_piece(vs_store *s, size_t bytes);
/* Frees a piece of `bytes` bytes, and subtracts them from the store's count. */
void vs_store_piece_free(vs_store *s, void *piece, size_t bytes);

void vs_store_slabs_free(vs_store *s); /* Frees all slabs, the large blocks from which pieces are cut; defined in
                                        * piece.c. */

#endif
