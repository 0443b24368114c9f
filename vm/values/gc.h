/* Declares the heap: allocation, roots, the write barrier, collection, and all memory that the interpreter requests
 * from its host.
 *
 * Plan. New objects are allocated in sequence in the nursery. A minor collection copies the surviving objects once into
 * the old space, where objects never move: blocks of one size class, swept into free lists, and large objects in a
 * list. It starts from the roots, the working part of the stack and the remembered set: the old objects in which a
 * store put a young object's address. A major collection runs when the old space, with the host objects' bytes, has
 * doubled. It marks with an explicit stack, never by recursion.
 *
 * Rules for C code. - Any function here that takes `vs_scheme *` and can allocate may move young objects. Values needed
 * afterwards must be in roots:
 *       VS_ROOTS(vm, r, 3);            three slots r[0..2], first #unspecific, unlinked at the end of the block
 *   A native's args[] and *result are roots already. Values passed by value to the constructors below are safe there.
 * - Constructors return false when memory is out. The error is then in vm->condition, and callers pass it on like any
 * other:
 *       return vs_cons(vm, args[0], VS_NIL, &r[0]) && vs_cons(vm, args[1], r[0], result);
 * - Stores into existing objects use vs_gc_store(vm, object, &field, value). */
#ifndef VS_VM_VALUES_GC_H
#define VS_VM_VALUES_GC_H

#include "vm/machine/vs.h"

/* ---- roots ---- */
struct vs_roots { struct vs_roots *next; vs_scheme *vm; vs_value *slots; size_t count; };
static inline struct vs_roots *vs_gc_link(struct vs_roots *r) {
  for (size_t i = 0; i < r->count; i++) r->slots[i] = VS_UNSPECIFIC;
  r->next = r->vm->roots;
  return r->vm->roots = r;
}
/* Unlinks roots of the garbage collector, in the reverse order of their linking. */
static inline void vs_gc_unlink(struct vs_roots *r) {
  VS_ASSERT(r->vm->roots == r);
  r->vm->roots = r->next;
}
#define VS_ROOTS(VM, NAME, N)                                                                           \
  vs_value NAME[N];                                                                                     \
  __attribute__((cleanup(vs_gc_unlink))) struct vs_roots NAME##_link = {NULL, VM, NAME, N};             \
  vs_gc_link(&NAME##_link)

/* ---- allocating objects ---- */
/* Returns a new object of `words` words (8 bytes each). Its header is set, and all other bytes are zero (which read as
 * the double 0.0). Small objects are in the nursery. Returns NULL when memory is out. */
vs_object *vs_gc_alloc(vs_scheme *vm, int type, size_t words);
vs_object *vs_gc_alloc_old(vs_scheme *vm, int type, size_t words);      /* allocates a new object in the old space,
                                                                         * where objects never move */

static inline bool vs_gc_is_young(const vs_scheme *vm, const void *o) {
  return (uintptr_t)o - (uintptr_t)vm->nursery < vm->nursery_bytes;
}
/* Adds an old object, which may contain the address of a young one, to the remembered set. */
void vs_gc_remember(vs_scheme *vm, vs_object *o);
/* Removes an object from the remembered set; it must contain no addresses of young objects. The next minor collection
 * does not visit it, unless such an address is stored first. */
void vs_gc_forget(vs_object *o);
/* Stores v in a field of the object, with the write barrier: an old object that gets the address of a young object is
 * remembered. */
static inline void vs_gc_store(vs_scheme *vm, void *object, vs_value *field, vs_value v) {
  VS_ASSERT((vs_value *)object < field && field < (vs_value *)object + ((const vs_object *)object)->words);
  *field = v;
  if (vs_is_object(v) && vs_gc_is_young(vm, vs_object_of(v)) && !vs_gc_is_young(vm, object)) vs_gc_remember(vm, object);
}

bool vs_cons(vs_scheme *vm, vs_value car, vs_value cdr, vs_value *out);
bool vs_make_vector(vs_scheme *vm, size_t n, vs_value fill, vs_value *out);
/* Sets *out to an object of several values with the n values at `at`, which are roots of the garbage collector or
 * arguments. If n is 1, sets *out to at[0]. */
bool vs_make_values(vs_scheme *vm, const vs_value *at, size_t n, vs_value *out);
/* Sets *out to a new foreign object. It takes over the caller's reference to `object`; on failure, releases this
 * reference. bytes: size of the host memory that `object` keeps in use. */
bool vs_make_foreign(vs_scheme *vm, const struct vs_foreign_type *type, void *object, size_t bytes, vs_value *out);
/* Sets *out to the interned symbol with these UTF-8 bytes as its name. */
bool vs_intern(vs_scheme *vm, const char *name, size_t bytes, vs_value *out);

/* To create another object with value fields (environment, macro, alias, promise, parameter, record type, ratio ...),
 * call vs_gc_alloc(vm, VS_T_X, VS_WORDS(vs_x)), and set its fields before the next allocation. */
#define VS_WORDS(ctype) ((sizeof(ctype) + 7) / 8)

/* ---- memory outside objects, which counts towards the memory limit ---- */
/* Allocates (p NULL), frees (bytes 0) or resizes memory. */
void *vs_mem(vs_scheme *vm, void *p, size_t old_bytes, size_t bytes);

void vs_gc_minor(vs_scheme *vm);
/* Returns true during a minor collection. All values that this collection visits are in old space afterwards. A trace
 * function may therefore omit values that it has passed before and that have not changed since. */
bool vs_gc_is_minor(const vs_scheme *vm);
void vs_gc_major(vs_scheme *vm);                     /* Collects the nursery and the old space. */
void vs_gc_external(vs_scheme *vm, int64_t bytes);   /* Adds `bytes`, which may be negative, to the number of bytes of
                                                      * host memory that objects keep in use. */
bool vs_gc_check(vs_scheme *vm);                     /* Checks the whole heap; returns true if it is consistent. */

void vs_gc_fail_after(vs_scheme *vm, size_t n);      /* For tests: makes the n-th allocation from now fail; 0: none
                                                      * fails. */

/* ---- functions for other files of vm/ ---- */
typedef void vs_gc_visit(vs_scheme *vm, vs_value *slot);
/* Adds a block of objects that were created elsewhere (by image.c) to the heap. `release` frees the block when the heap
 * is closed. */
void vs_gc_adopt(vs_scheme *vm, void *image, size_t bytes, void (*release)(vs_scheme *vm, void *image, size_t bytes));
/* Opens the heap of an interpreter that has none. */
bool vs_gc_open(vs_scheme *vm);
void vs_gc_close(vs_scheme *vm);
#endif
