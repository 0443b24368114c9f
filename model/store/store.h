/* Owns the store: the memory of a model, what is interned in it, and who may stop what works long. */
#ifndef VS_MODEL_STORE_STORE_H
#define VS_MODEL_STORE_STORE_H

#include <stddef.h>

#include "model/looks/material.h"
#include "model/model_error.h"

typedef struct vs_store vs_store;
typedef struct vs_cache vs_cache; /* cache.h */

/* as realloc; new_size 0 frees; NULL: failed */
typedef void *vs_alloc_fn(void *context, void *old, size_t old_size, size_t new_size);
/* alloc NULL: the C library's. A reference. NULL: out of memory */
vs_store *vs_store_new(vs_alloc_fn *alloc, void *context);
/* The store is alive. */
vs_store *vs_store_retain(vs_store *s);
void vs_store_release(vs_store *s);
size_t vs_store_bytes(const vs_store *s); /* held now by nodes and arrays: counts towards the interpreter's memory
                                           * budget */
/* Who is asked in what works long whether to go on, the error's word then being that it was interrupted. NULL:
 * nobody. */
void vs_store_watch(vs_store *s, bool (*going)(void *context), void *context);
/* asks once a million steps of a nanosecond or some have come together; s NULL: goes on */
bool vs_store_going(vs_store *s, uint32_t work, vs_error *e);
/* The old bytes are among those counted. */
void *vs_store_realloc(vs_store *s, void *old, size_t old_size, size_t new_size); /* accounted; new_size 0 frees */
/* Makes room for `need` elements of `size` bytes in the store's array whose address stands in *slot; *room is in
 * elements. False: no memory, nothing is changed. size is not 0. */
bool vs_store_grow(vs_store *s, void *slot, size_t *room, size_t need, size_t size);
/* tests: the n-th allocation from now fails and so do those after it; 0: none */
void vs_store_fail_at(vs_store *s, size_t n);
/* A place for geometry/ to keep what took time to get (fonts) for as long as the store lives; NULL at first. let_go
 * frees it then. */
void **vs_store_kept(vs_store *s, void (*let_go)(vs_store *s, void *kept));
/* interned, NUL-terminated; NULL: out of memory */
const char *vs_store_text(vs_store *s, const char *text, size_t length);
/* interned; NULL: oom */
const vs_origin *vs_store_origin(vs_store *s, const char *file, uint32_t line, uint32_t column,
                                 const vs_origin *caller);
/* interned by value; NULL: out of memory */
const vs_material *vs_store_material(vs_store *s, const vs_material *m);
/* A copy of the picture and its bytes, interned by path and bytes; NULL: out of memory. */
const vs_picture *vs_store_picture(vs_store *s, const vs_picture *p);
uint64_t vs_text_hash(const char *interned); /* kept with the text */
/* gone(context, id) is called when the last reference to a ticket goes; NULL: nobody asks any more. It must not touch
 * nodes. */
void vs_store_on_ticket(vs_store *s, void (*gone)(void *context, uint32_t id), void *context);

#endif
