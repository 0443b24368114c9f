/* Owns small pieces of a store's memory, of which there may be millions. */
#ifndef VS_MODEL_STORE_PIECE_H
#define VS_MODEL_STORE_PIECE_H

#include "model/store/store.h"

/* Freed with the size they were asked for. NULL: out of memory. */
void *vs_store_piece(vs_store *s, size_t bytes);
/* Its bytes are among those counted. */
void vs_store_piece_free(vs_store *s, void *piece, size_t bytes);

void vs_store_slabs_free(vs_store *s); /* piece.c */

#endif
