/* Owns the heap: allocation, roots, the write barrier, collection, and every byte the interpreter asks of its host.

   Plan. New objects come from a bump nursery; what survives a minor collection is copied once into the old space, which
   never moves: blocks of one size class, swept into free lists, and large objects on a list. Minor collections start
   from the roots, the working stack and the remembered set (old objects that a store made point at young ones). Major
   collections mark with an explicit stack, never by recursion, when the old space has doubled, host objects' bytes
   included.

   Rules for C code.
   - Any function here that takes `vs_scheme *` and can allocate may move young objects. Values needed afterwards live
   in roots:
       VS_ROOTS(vm, r, 3);            three slots r[0..2], #unspecific at first, dropped at the end of the block
     A native's args[] and *result are roots already. Values passed by value to the constructors below are safe inside
     them.
   - Constructors return false when memory is out; the error is then in vm->condition and is passed on like any other:
       return vs_cons(vm, args[0], VS_NIL, &r[0]) && vs_cons(vm, args[1], r[0], result);
   - Stores into existing objects go through vs_gc_store(vm, object, &field, value). */
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
/* Roots are dropped in the reverse order of their linking. */
static inline void vs_gc_unlink(struct vs_roots *r) {
  VS_ASSERT(r->vm->roots == r);
  r->vm->roots = r->next;
}
#define VS_ROOTS(VM, NAME, N)                                                                           \
  vs_value NAME[N];                                                                                     \
  __attribute__((cleanup(vs_gc_unlink))) struct vs_roots NAME##_link = {NULL, VM, NAME, N};             \
  vs_gc_link(&NAME##_link)

/* ---- objects ---- */
/* An object of `words` words, header filled, the rest zero bytes (which read as the double 0.0), in the nursery if
   small. NULL when memory is out. */
vs_object *vs_gc_alloc(vs_scheme *vm, int type, size_t words);
vs_object *vs_gc_alloc_old(vs_scheme *vm, int type, size_t words);      /* never moves */

static inline bool vs_gc_is_young(const vs_scheme *vm, const void *o) {
  return (uintptr_t)o - (uintptr_t)vm->nursery < vm->nursery_bytes;
}
/* Notes an old object that may hold the address of a young one. */
void vs_gc_remember(vs_scheme *vm, vs_object *o);
/* The object holds no addresses: the next minor collection need not look through it, until one is stored. */
void vs_gc_forget(vs_object *o);
/* The field is one of the object's. */
static inline void vs_gc_store(vs_scheme *vm, void *object, vs_value *field, vs_value v) {
  VS_ASSERT((vs_value *)object < field && field < (vs_value *)object + ((const vs_object *)object)->words);
  *field = v;
  if (vs_is_object(v) && vs_gc_is_young(vm, vs_object_of(v)) && !vs_gc_is_young(vm, object)) vs_gc_remember(vm, object);
}

bool vs_cons(vs_scheme *vm, vs_value car, vs_value cdr, vs_value *out);
bool vs_make_vector(vs_scheme *vm, size_t n, vs_value fill, vs_value *out);
/* `at` in roots or args; n = 1 gives at[0] */
bool vs_make_values(vs_scheme *vm, const vs_value *at, size_t n, vs_value *out);
/* takes the one reference to `object` over; also when it fails (it is then released) */
bool vs_make_foreign(vs_scheme *vm, const struct vs_foreign_type *type, void *object, size_t bytes, vs_value *out);
/* The symbol of these UTF-8 bytes. */
bool vs_intern(vs_scheme *vm, const char *name, size_t bytes, vs_value *out);

/* Plain objects with traced fields (environment, macro, alias, promise, parameter, record type, ratio ...): allocate
   with vs_gc_alloc(vm, VS_T_X, VS_WORDS(vs_x)) and set the fields before the next allocation. */
#define VS_WORDS(ctype) ((sizeof(ctype) + 7) / 8)

/* ---- memory that is not objects: counted against the limit; `old_bytes` as given before. NULL when refused (no error
   set when bytes is 0) ---- */
/* The old bytes are among those counted. */
void *vs_mem(vs_scheme *vm, void *p, size_t old_bytes, size_t bytes);

void vs_gc_minor(vs_scheme *vm);
/* Is a minor collection under way? Values that it has visited are old when it ends: an owner of values that do not
 * change need not hand them to the next one. */
bool vs_gc_is_minor(const vs_scheme *vm);
void vs_gc_major(vs_scheme *vm);                     /* both generations */
void vs_gc_external(vs_scheme *vm, int64_t bytes);   /* host memory held by objects grew or shrank */
bool vs_gc_check(vs_scheme *vm);                     /* walk the heap; true when sound */

void vs_gc_fail_after(vs_scheme *vm, size_t n);      /* tests: refuse the n-th allocation from now; 0 stops that */

/* ---- between the parts of vm/ ---- */
typedef void vs_gc_visit(vs_scheme *vm, vs_value *slot);
/* image.c: objects made elsewhere; release takes them back when the heap is closed */
void vs_gc_adopt(vs_scheme *vm, void *image, size_t bytes, void (*release)(vs_scheme *vm, void *image, size_t bytes));
/* The interpreter has no heap yet. */
bool vs_gc_open(vs_scheme *vm);
void vs_gc_close(vs_scheme *vm);
#endif
