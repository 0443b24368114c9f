/* Owns the store: the memory of a model, its interned values, and the callback that may stop long work. */
#ifndef VS_MODEL_STORE_STORE_H
#define VS_MODEL_STORE_STORE_H

#include <stddef.h>

#include "model/looks/material.h"
#include "model/model_error.h"

typedef struct vs_store vs_store;
typedef struct vs_cache vs_cache; /* cache.h */

/* As realloc; new_size 0 frees; returns NULL on failure. */
typedef void *vs_alloc_fn(void *context, void *old, size_t old_size, size_t new_size);
/* Returns a new store, as one reference; NULL: out of memory. alloc NULL: the C library's. */
vs_store *vs_store_new(vs_alloc_fn *alloc, void *context);
/* The store is alive. */
vs_store *vs_store_retain(vs_store *s);
void vs_store_release(vs_store *s);
size_t vs_store_bytes(const vs_store *s); /* bytes that nodes and arrays now hold: they count towards the interpreter's
                                           * memory budget */
/* Sets the callback of long work. If it returns false, the work stops with the error of an interrupt. NULL: it never
 * stops. */
void vs_store_watch(vs_store *s, bool (*going)(void *context), void *context);
/* Calls the callback once in a million steps, each of about a nanosecond. s NULL: returns true. */
bool vs_store_going(vs_store *s, uint32_t work, vs_error *e);
/* Reallocates and counts; new_size 0 frees. The old bytes are among those counted. */
void *vs_store_realloc(vs_store *s, void *old, size_t old_size, size_t new_size);
/* Makes room for `need` elements of `size` bytes in the store's array whose address is in *slot; *room is in elements.
 * Returns false when memory is out; nothing is then changed. size is not 0. */
bool vs_store_grow(vs_store *s, void *slot, size_t *room, size_t need, size_t size);
/* tests: the n-th allocation from now fails and so do those after it; 0: none */
void vs_store_fail_at(vs_store *s, size_t n);
/* Returns the address of a pointer, NULL at first, with which geometry/ keeps data that took time to make (fonts) as
 * long as the store lives. let_go frees the data then. */
void **vs_store_kept(vs_store *s, void (*let_go)(vs_store *s, void *kept));
/* interned, NUL-terminated; NULL: out of memory */
const char *vs_store_text(vs_store *s, const char *text, size_t length);
/* interned; NULL: oom */
const vs_origin *vs_store_origin(vs_store *s, const char *file, uint32_t line, uint32_t column,
                                 const vs_origin *caller);
/* interned by value; NULL: out of memory */
const vs_material *vs_store_material(vs_store *s, const vs_material *m);
/* Returns a copy of the picture and its bytes, interned by path and bytes; NULL: out of memory. */
const vs_picture *vs_store_picture(vs_store *s, const vs_picture *p);
uint64_t vs_text_hash(const char *interned); /* the store keeps it with the text */
/* Sets the callback that is called when the last reference to a ticket is released; NULL: none. It must not use
 * nodes. */
void vs_store_on_ticket(vs_store *s, void (*gone)(void *context, uint32_t id), void *context);

#endif
