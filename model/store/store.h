/* Declares the store: the memory of a model, its interned values, and the job that may stop long computations. */
#ifndef VS_MODEL_STORE_STORE_H
#define VS_MODEL_STORE_STORE_H

#include <stddef.h>

#include "model/looks/material.h"
#include "model/model_error.h"

typedef struct vs_store vs_store;
typedef struct vs_cache vs_cache; /* the world cache, defined in cache.h */

/* A function that reallocates memory as realloc does. If new_size is 0, it frees the memory. Returns NULL when memory
 * is out. */
typedef void *vs_alloc_fn(void *context, void *old, size_t old_size, size_t new_size);
/* Returns a new store with one reference, or NULL when memory is out. If alloc is NULL, the store uses the C library's
 * allocator. */
vs_store *vs_store_new(vs_alloc_fn *alloc, void *context);
/* Adds a reference to the store s. Returns s. */
vs_store *vs_store_retain(vs_store *s);
void vs_store_release(vs_store *s);
size_t vs_store_bytes(const vs_store *s); /* Returns the number of bytes that the store's nodes and arrays currently
                                           * use. They count towards the interpreter's memory budget. */
/* Counts work, in units of about a nanosecond. After every million units, asks the store's job whether it must end
 * (vs_job_going in model/job.h). Returns false, with the error "interrupted" in e, if it must. If s is NULL, returns
 * true. */
bool vs_store_going(vs_store *s, uint32_t work, vs_error *e);
/* Reallocates memory of the store, as realloc does, and counts the bytes. If new_size is 0, frees the memory. old_size:
 * the size for which the memory was allocated. */
void *vs_store_realloc(vs_store *s, void *old, size_t old_size, size_t new_size);
/* Makes room for `need` elements of `size` bytes (above 0) in the array whose address is in *slot. *room: number of
 * elements for which the array has memory. Returns false when memory is out, and then changes nothing. */
bool vs_store_grow(vs_store *s, void *slot, size_t *room, size_t need, size_t size);
/* Ends the freeing of nodes: from now on releasing a node frees nothing. For a process that ends soon, whose memory the
 * system frees faster than this code does. */
void vs_store_abandon(vs_store *s);
bool vs_store_is_abandoned(const vs_store *s); /* Returns true after vs_store_abandon. s may be NULL. */
/* For tests: makes the n-th allocation from now on fail, and all later ones. If n is 0, no allocation fails. */
void vs_store_fail_at(vs_store *s, size_t n);
/* Returns the address of a pointer, NULL at first, in which geometry/ keeps data that is slow to make (fonts). When the
 * store is freed, it calls let_go with this data. */
void **vs_store_kept(vs_store *s, void (*let_go)(vs_store *s, void *kept));
/* Returns an interned, NUL-terminated copy of the text, or NULL when memory is out. */
const char *vs_store_text(vs_store *s, const char *text, size_t length);
/* Returns the interned origin (place of a call) with these members, or NULL when memory is out. */
const vs_origin *vs_store_origin(vs_store *s, const char *file, uint32_t line, uint32_t column,
                                 const vs_origin *caller);
/* Returns an interned copy of the material, or NULL when memory is out. */
const vs_material *vs_store_material(vs_store *s, const vs_material *m);
/* Returns an interned copy of the picture and its bytes, or NULL when memory is out. */
const vs_picture *vs_store_picture(vs_store *s, const vs_picture *p);
uint64_t vs_text_hash(const char *interned); /* Returns the hash of an interned text, which the store keeps beside the
                                              * text. */
/* Sets the callback `gone`, which is called when the last reference to a ticket is released; NULL: there is no
 * callback. It must not use nodes. */
void vs_store_on_ticket(vs_store *s, void (*gone)(void *context, uint32_t id), void *context);

#endif
