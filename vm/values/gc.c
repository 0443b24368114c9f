/* Implements the garbage collector.
 *
 * Old space contains the objects that have survived a collection. It consists of blocks of BLOCK bytes. Each block has
 * cells of one size class. Blocks are parts of chunks, which have CHUNK_BLOCKS blocks, or more in a large heap (the
 * host may then use huge pages). A size class has a list of free cells, and one block from which new cells are taken in
 * sequence. Objects larger than the largest class are separate allocations in a list. Old objects never move.
 *
 * A minor collection copies the live objects of the nursery (new objects) to old space. It must not fail before it is
 * complete. gc_reserve therefore reserves the blocks that it might need before the nursery is used again. Its worklist
 * needs no memory: the old copy of a promoted object links to the next. A major collection marks with a stack of
 * (object, next slot). If that stack cannot grow, the collector walks over the heap again for the objects that it could
 * not push.
 *
 * The time of a minor collection is proportional to the surviving bytes. The time of a major one is proportional to the
 * live bytes, plus one access for each old cell. */
#include "vm/values/gc.h"

#include <stdlib.h>

#include "vm/front/ast.h"
#include "vm/machine/poll.h"
#include "vm/values/layout.h"
#include "vm/machine/native.h"

enum {
  BLOCK = 16 << 10,
  BLOCK_DATA = BLOCK - 32,
  CHUNK_BLOCKS = 64,
  CHUNK_LEAST = 2 << 20, CHUNK_MOST = 4 << 20,      /* bounds of the size of a chunk in a large heap, in bytes */
  /* STARVED: if the host refuses memory, a major collection runs. Before the next collection for this reason, 1/STARVED
   * of the heap must have been allocated. */
  STARVED = 64,
  GC_MARK = 1, GC_REMEMBERED = 2, GC_FREE = 4, GC_MOVED = 8, GC_LARGE = 16
};
/* For VS_DEBUG_STRESS. If a minor collection visits more than STRESS_VISITS slots, some later collections are skipped.
 * A whole collection runs once in (heap bytes / STRESS_BYTES) allocations. */
enum { STRESS_VISITS = 2048, STRESS_BYTES = 256 };
#if VS_DEBUG_SMALL
enum { NURSERY = 32 << 10, FIRST_MAJOR = 256 << 10 };
#else
enum { NURSERY = 1 << 20, FIRST_MAJOR = 16 << 20 };
#endif

static const uint16_t class_words[] = { 2,  3,  4,  5,  6,  7,  8,  10, 12,  14,  16, 20,
                                        24, 28, 32, 40, 48, 64, 80, 96, 128, 170, 255 };
/* CLASS_MAX: greatest size in words of objects in blocks. Larger objects are allocated separately in the old space. */
enum { CLASSES = sizeof class_words / sizeof class_words[0], CLASS_MAX = 255 };

struct vs_gc_block {
  struct vs_gc_block *next;
  uint32_t words;                     /* size in words of the cells of this class */
  uint32_t used;                      /* number of bytes at the start of the block that were already divided into
                                       * cells */
  struct vs_gc_chunk *chunk;
  uint64_t unused;
  uint64_t data[];
};
struct vs_gc_chunk {
  struct vs_gc_chunk *next, *open;    /* next: next chunk in the list; open: next chunk that has unused blocks */
  uint32_t fresh, live;               /* fresh: number of the chunk's blocks that were never used; live: number of the
                                       * chunk's blocks in use, as counted by the last major collection */
  uint32_t count, leaving;            /* count: number of the chunk's blocks; leaving: whether the chunk is about to be
                                       * freed */
};
struct vs_gc_large { _Alignas(8) struct vs_gc_large *next; size_t bytes; };

struct free_cell { vs_object h; struct free_cell *next; };
struct mark_entry { vs_object *o; size_t next; };

struct vs_gc {
  struct vs_gc_block *blocks, *spare;           /* blocks: list of blocks in use; spare: list of blocks without cells in
                                                 * use */
  size_t spares;
  struct vs_gc_chunk *chunks, *open;
  size_t chunk_bytes;                           /* size of all chunks together, in bytes */
  struct { struct free_cell *free; struct vs_gc_block *bump; } of[CLASSES];
  uint8_t class_of[CLASS_MAX + 1];              /* class_of[n]: size class of objects with n words */
  struct vs_gc_large *large;
  /* The actual end of the nursery. vm->end is set to a lower address when every allocation must call vs_gc_alloc. */
  char *nursery_end;
  bool minor;                                   /* whether a minor collection is running */
  bool ready;                                   /* whether blocks are reserved for the copies of the next minor
                                                 * collection */
  size_t old_bytes, major_at;                   /* old_bytes: size of all old objects in bytes; major_at: value of
                                                 * old_bytes at which a major collection begins */
  /* Bytes allocated for old objects since the last major collection that ran because the host refused memory. */
  size_t granted;
  size_t external, external_minor;              /* external: bytes of host memory that objects keep in use;
                                                 * external_minor: value of `external` at which a minor collection
                                                 * begins */
  vs_object **remembered; size_t remembered_count, remembered_room; bool remembered_lost;
  vs_object **young_foreign; size_t young_count, young_room;
  vs_object **tracing; size_t tracing_count, tracing_room;     /* old foreign objects with a trace function */
  vs_object *grey;                              /* worklist of the minor collection: linked list of the objects that
                                                 * were copied to old space and whose references were not yet visited */
  struct mark_entry *marks; size_t mark_count, mark_room; bool mark_lost;
  char *image; size_t image_bytes;              /* the objects of a loaded heap image, image_bytes long */
  void (*release_image)(vs_scheme *vm, void *image, size_t bytes);
  /* For VS_DEBUG_STRESS. visits: number of slots that the last minor collection has visited. minor_in, whole_in: number
   * of allocations until the next minor collection and until the next collection of the whole heap. */
  size_t visits, minor_in, whole_in;
};

/* ---- memory of the host ---- */
static void *default_memory(void *user, void *p, size_t old_bytes, size_t bytes) {
  (void)user; (void)old_bytes;
  if (bytes == 0) { free(p); return NULL; }
  return realloc(p, bytes);
}

static void gc_fail_limit(vs_scheme *vm) {
  vs_fail_memory(vm);
  vm->over_limit = true;
}

void *vs_mem(vs_scheme *vm, void *p, size_t old_bytes, size_t bytes) {
  VS_ASSERT(vm->bytes >= old_bytes);
  void *(*memory)(void *, void *, size_t, size_t) = vm->config.memory ? vm->config.memory : default_memory;
  if (bytes > old_bytes) {
    if (vm->fail_after && --vm->fail_after == 0) { vs_fail_memory(vm); return NULL; }
    if (vm->config.memory_limit && vm->bytes + (bytes - old_bytes) > vm->config.memory_limit) {
      gc_fail_limit(vm);
      return NULL;
    }
  }
  void *q = memory(vm->config.user, p, old_bytes, bytes);
  if (bytes && !q) { vs_fail_memory(vm); return NULL; }
  vm->bytes += bytes - old_bytes;
  if (vm->bytes > vm->peak_bytes) vm->peak_bytes = vm->bytes;
  return q;
}

/* Grows a C array of elements of `size` bytes so that element number `count` fits. Returns false when memory is out. */
static bool gc_grow(vs_scheme *vm, void *array, size_t *room, size_t count, size_t size) {
  if (count < *room) return true;
  size_t more = *room ? *room * 2 : 64;
  void **p = array, *q = vs_mem(vm, *p, *room * size, more * size);
  if (!q) return false;
  *p = q; *room = more;
  return true;
}

/* ---- chunks, blocks and cells of the old space ---- */
static size_t chunk_size(size_t blocks) {
  return blocks > CHUNK_BLOCKS ? (blocks + 1) * BLOCK : sizeof(struct vs_gc_chunk) + blocks * BLOCK;
}

/* Adds a chunk to the old space. It has CHUNK_BLOCKS blocks. In a larger heap, its size is the largest power of two
 * from CHUNK_LEAST to CHUNK_MOST bytes that does not exceed a quarter of the heap. */
static bool gc_add_chunk(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  size_t blocks = CHUNK_BLOCKS;
  for (size_t bytes = CHUNK_LEAST; bytes <= CHUNK_MOST && bytes <= gc->chunk_bytes / 4; bytes *= 2)
    blocks = bytes / BLOCK - 1;
  struct vs_gc_chunk *c = vs_mem(vm, NULL, 0, chunk_size(blocks));
  if (!c) return false;
  c->next = gc->chunks; gc->chunks = c;
  c->open = gc->open; gc->open = c;
  c->fresh = c->count = (uint32_t)blocks;
  c->leaving = 0;
  gc->spares += blocks;
  gc->chunk_bytes += chunk_size(blocks);
  return true;
}

static void gc_drop_chunk(vs_scheme *vm, struct vs_gc_chunk *c) {
  size_t bytes = chunk_size(c->count);
  vm->gc->chunk_bytes -= bytes;
  vs_mem(vm, c, bytes, 0);
}

/* Returns the number of spare blocks that suffice to copy the whole nursery to old space. */
static size_t gc_blocks_needed(const vs_scheme *vm) {
  return vm->nursery_bytes / (BLOCK_DATA - BLOCK_DATA / 4) + CLASSES + 1;
}

static bool gc_reserve(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  while (gc->spares < gc_blocks_needed(vm))
    if (!gc_add_chunk(vm)) return false;
  return true;
}

static struct vs_gc_block *gc_block(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  struct vs_gc_block *b = gc->spare;
  if (!b && !gc->open && !gc_add_chunk(vm)) return NULL;
  if (b) {
    gc->spare = b->next;
  } else {
    struct vs_gc_chunk *c = gc->open;
    b = (struct vs_gc_block *)(void *)((char *)(c + 1) + (size_t)(c->count - c->fresh) * BLOCK);
    if (--c->fresh == 0) gc->open = c->open;
    b->chunk = c;
  }
  gc->spares--;
  b->next = gc->blocks; gc->blocks = b;
  return b;
}

/* Returns a free cell for an object of `words` words (at most CLASS_MAX), or NULL if no block is left. */
static vs_object *gc_cell(vs_scheme *vm, size_t words) {
  struct vs_gc *gc = vm->gc;
  unsigned k = gc->class_of[words];
  size_t bytes = class_words[k] * sizeof(uint64_t);
  struct free_cell *f = gc->of[k].free;
  VS_ASSERT(words <= CLASS_MAX);
  if (f) {
    gc->of[k].free = f->next;
  } else {
    struct vs_gc_block *b = gc->of[k].bump;
    if (!b || b->used + bytes > BLOCK_DATA) {
      b = gc_block(vm);
      if (!b) return NULL;
      b->words = class_words[k]; b->used = 0;
      gc->of[k].bump = b;
    }
    f = (struct free_cell *)(void *)((char *)b->data + b->used);
    b->used += (uint32_t)bytes;
  }
  gc->old_bytes += bytes;
  return &f->h;
}

/* Returns a cell for a new object in old space, or NULL when memory is out. Does not use the blocks that are reserved
 * for the next minor collection. */
static vs_object *gc_born_old(vs_scheme *vm, size_t words) {
  struct vs_gc *gc = vm->gc;
  unsigned k = gc->class_of[words];
  const struct vs_gc_block *b = gc->of[k].bump;
  if (!gc->of[k].free && (!b || b->used + class_words[k] * sizeof(uint64_t) > BLOCK_DATA))
    while (gc->spares <= gc_blocks_needed(vm))
      if (!gc_add_chunk(vm)) return NULL;
  return gc_cell(vm, words);
}

/* Allocates a large object separately, zeroed. Returns NULL when memory is out. Zeroing a gigabyte takes so long that
 * the function polls for an interrupt; if an interrupt is the reason for NULL, sets *stopped to true. */
static vs_object *gc_large(vs_scheme *vm, size_t words, bool *stopped) {
  struct vs_gc *gc = vm->gc;
  size_t bytes = words * sizeof(uint64_t);
  struct vs_gc_large *l = vs_mem(vm, NULL, 0, sizeof *l + bytes);
  if (!l) return NULL;
  if (!vs_poll_set(vm, l + 1, 0, bytes)) {
    *stopped = true;
    vs_mem(vm, l, sizeof *l + bytes, 0);
    return NULL;
  }
  l->next = gc->large; l->bytes = bytes; gc->large = l;
  gc->old_bytes += bytes;
  return (vs_object *)(void *)(l + 1);
}

/* ---- allocating objects ---- */
static void gc_hold_down(vs_scheme *vm) {      /* for debugging: makes every allocation call vs_gc_alloc */
  vm->end = VS_DEBUG_STRESS || vm->fail_after ? vm->nursery : vm->gc->nursery_end;
}

/* Initialises the header of an object of the type VS_T_..., and zeroes the other words. */
static vs_object *gc_init(vs_object *o, int type, unsigned gc, size_t words) {
  VS_ASSERT(type >= 0 && type < VS_T_COUNT);
  if (!(gc & GC_LARGE)) memset(o, 0, words * sizeof(uint64_t));       /* a large object was already zeroed by
                                                                       * gc_large */
  o->type = (uint8_t)type; o->gc = (uint8_t)gc; o->words = (uint32_t)words;
  return o;
}

/* For VS_DEBUG_STRESS: runs the collections that are due at this allocation. */
static void gc_stress(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  if (gc->whole_in-- == 0) {
    vs_gc_major(vm);
    if (!vs_gc_check(vm)) __builtin_trap();
    /* The period of whole collections varies, so that it does not coincide with the period of a loop in the program. */
    gc->whole_in = (gc->old_bytes + gc->image_bytes) / STRESS_BYTES + vm->collections % 7;
  } else if (gc->minor_in-- == 0) {
    vs_gc_minor(vm);
    if (gc->old_bytes + gc->external > gc->major_at) vs_gc_major(vm);
    gc->minor_in = gc->visits / STRESS_VISITS;
  }
}

static bool gc_over_limit(const vs_scheme *vm, size_t more) {
  return vm->config.memory_limit && vm->bytes + vm->gc->external + more > vm->config.memory_limit;
}

vs_object *vs_gc_alloc_old(vs_scheme *vm, int type, size_t words) {
  struct vs_gc *gc = vm->gc;
  if (words < 2) words = 2;
  if (words > UINT32_MAX) { vs_fail_memory(vm); return NULL; }
  if (vm->fail_after && --vm->fail_after == 0) { gc_hold_down(vm); vs_fail_memory(vm); return NULL; }
  if (VS_DEBUG_STRESS && gc->whole_in-- == 0) { gc->whole_in = 0; gc_stress(vm); }
  if (gc->old_bytes + gc->external + words * 8 > gc->major_at || (words > CLASS_MAX && gc_over_limit(vm, words * 8)))
    vs_gc_major(vm);
  /* Reserves an entry of the remembered set for the object, so that adding the object cannot fail later. */
  if (!gc_grow(vm, &gc->remembered, &gc->remembered_room, gc->remembered_count, sizeof *gc->remembered)) return NULL;
  bool stopped = false;
  vs_object *o = words <= CLASS_MAX ? gc_born_old(vm, words) : gc_large(vm, words, &stopped);
  /* If memory was refused, a collection may free memory, unless one has just run. */
  if (!o) {
    if (stopped || gc->granted < gc->old_bytes / STARVED) return NULL;
    gc->granted = 0;
    vs_gc_major(vm);
    o = words <= CLASS_MAX ? gc_born_old(vm, words) : gc_large(vm, words, &stopped);
    if (!o) return NULL;
  }
  gc->granted += words * 8;
  gc_init(o, type, words > CLASS_MAX ? GC_LARGE : 0, words);
  if (vs_layout[type].first) vs_gc_remember(vm, o);     /* the caller will set the object's fields without the write
                                                         * barrier, so the object is remembered now */
  return o;
}

static vs_object *gc_alloc_slow(vs_scheme *vm, int type, size_t words) {
  struct vs_gc *gc = vm->gc;
  size_t bytes = words * sizeof(uint64_t);
  if (words > CLASS_MAX) {
    if (VS_DEBUG_STRESS) gc_stress(vm);
    return vs_gc_alloc_old(vm, type, words);
  }
  if (vm->fail_after && --vm->fail_after == 0) { gc_hold_down(vm); vs_fail_memory(vm); return NULL; }
  if (VS_DEBUG_STRESS) gc_stress(vm);
  if (!gc->ready || (size_t)(gc->nursery_end - vm->free) < bytes) {
    if (gc->ready) vs_gc_minor(vm);
    if (gc->old_bytes + gc->external > gc->major_at || gc_over_limit(vm, 0)) vs_gc_major(vm);
    if (!gc->ready) {
      if (!gc_reserve(vm)) {
        vs_gc_major(vm);
        if (!gc_reserve(vm)) return NULL;
      }
      gc->ready = true;
    }
    if (gc_over_limit(vm, 0)) { gc_fail_limit(vm); return NULL; }
  }
  gc_hold_down(vm);
  vs_object *o = (vs_object *)(void *)vm->free;
  vm->free += bytes;
  return gc_init(o, type, 0, words);
}

vs_object *vs_gc_alloc(vs_scheme *vm, int type, size_t words) {
  if (words < 2) words = 2;
  if (words <= CLASS_MAX && (ptrdiff_t)(words * sizeof(uint64_t)) <= vm->end - vm->free) {
    vs_object *o = (vs_object *)(void *)vm->free;
    vm->free += words * sizeof(uint64_t);
    return gc_init(o, type, 0, words);
  }
  return gc_alloc_slow(vm, type, words);
}

void vs_gc_remember(vs_scheme *vm, vs_object *o) {
  struct vs_gc *gc = vm->gc;
  VS_ASSERT(!vs_gc_is_young(vm, o));
  if (o->gc & GC_REMEMBERED) return;
  o->gc |= GC_REMEMBERED;
  if (gc->remembered_count == gc->remembered_room) {
    /* If the remembered set cannot grow, the flag in the object suffices: the next minor collection then walks over the
     * heap to find flagged objects. */
    vs_value was = vm->condition;
    bool grown = gc_grow(vm, &gc->remembered, &gc->remembered_room, gc->remembered_count, sizeof *gc->remembered);
    vm->condition = was;
    if (!grown) { gc->remembered_lost = true; return; }
  }
  gc->remembered[gc->remembered_count++] = o;
}

void vs_gc_forget(vs_object *o) { o->gc &= (uint8_t)~GC_REMEMBERED; }

void vs_gc_external(vs_scheme *vm, int64_t bytes) {
  struct vs_gc *gc = vm->gc;
  if (bytes < 0 && gc->external < (size_t)-bytes) gc->external = 0;
  else gc->external = (size_t)((int64_t)gc->external + bytes);
}

/* The number of bytes that a host's object keeps in use is stored in 16 bits of the Scheme object's header: a number of
 * CHARGE_DIGITS bits, rounded up, and a shift. */
enum { CHARGE_DIGITS = 11, CHARGE_MASK = (1 << CHARGE_DIGITS) - 1 };
static uint16_t gc_charge(size_t bytes) {
  unsigned shift = 0;
  for (; bytes > CHARGE_MASK && shift < 31; shift++) bytes = bytes / 2 + bytes % 2;
  return (uint16_t)(shift << CHARGE_DIGITS | (bytes & CHARGE_MASK)); /* the shift has 5 bits, which suffice for objects
                                                                      * below 4 TB */
}
static size_t gc_charged(uint16_t charge) { return (size_t)(charge & CHARGE_MASK) << (charge >> CHARGE_DIGITS); }

bool vs_make_foreign(vs_scheme *vm, const struct vs_foreign_type *type, void *object, size_t bytes, vs_value *out) {
  struct vs_gc *gc = vm->gc;
  uint16_t charge = gc_charge(bytes);
  vs_gc_external(vm, (int64_t)gc_charged(charge));
  if (gc->external > gc->external_minor || gc_over_limit(vm, 0)) {
    vs_gc_minor(vm);
    if (gc->old_bytes + gc->external > gc->major_at || gc_over_limit(vm, 0)) vs_gc_major(vm);
    gc->external_minor = gc->external + (32u << 20);
  }
  vs_foreign *f = NULL;
  if (gc_over_limit(vm, 0)) gc_fail_limit(vm);
  else if (gc_grow(vm, &gc->young_foreign, &gc->young_room, gc->young_count, sizeof *gc->young_foreign) &&
           (!type->trace ||
            gc_grow(vm, &gc->tracing, &gc->tracing_room, gc->tracing_count + gc->young_count, sizeof *gc->tracing)))
    f = (vs_foreign *)(void *)vs_gc_alloc(vm, VS_T_FOREIGN, VS_WORDS(vs_foreign));
  if (!f) {
    vs_gc_external(vm, -(int64_t)gc_charged(charge));
    if (type->release) type->release(object);
    return false;
  }
  f->h.flags = charge;
  f->type = type; f->object = object; f->with = NULL;
  gc->young_foreign[gc->young_count++] = &f->h;
  *out = vs_from_object(f);
  return true;
}

static void gc_finalize(vs_scheme *vm, vs_object *o) {
  vs_foreign *f = (vs_foreign *)(void *)o;
  vs_gc_external(vm, -(int64_t)gc_charged(f->h.flags));
  if (f->type->release && f->object) f->type->release(f->object);
  f->object = NULL;
}

/* ---- visiting the roots, for both kinds of collection ---- */
typedef vs_gc_visit gc_visit;

static inline void gc_visit_range(vs_scheme *vm, vs_value *at, size_t n, gc_visit *visit) {
  for (size_t i = 0; i < n; i++) visit(vm, &at[i]);
}

static void gc_visit_roots(vs_scheme *vm, gc_visit *visit) {
  if (vm->stack) {
    gc_visit_range(vm, vm->stack, (size_t)(vm->top - vm->stack), visit);
    /* Zeroes the unused slots of the stack above vm->top. A later activation may include them before it writes them,
     * and their old contents would then count as live. */
    memset(vm->top, 0, (size_t)((char *)vm->stack_end - (char *)vm->top));
  }
  visit(vm, &vm->under);
  visit(vm, &vm->winders); visit(vm, &vm->handlers); visit(vm, &vm->parameters);
  visit(vm, &vm->call_procedure); visit(vm, &vm->condition); visit(vm, &vm->value);
  gc_visit_range(vm, vm->call_args, vm->call_count, visit);
  gc_visit_range(vm, (vs_value *)(void *)&vm->sym, sizeof vm->sym / sizeof(vs_value), visit);
  gc_visit_range(vm, (vs_value *)(void *)&vm->at, sizeof vm->at / sizeof(vs_value), visit);
  for (struct vs_roots *r = vm->roots; r; r = r->next) gc_visit_range(vm, r->slots, r->count, visit);
  vs_gc_visit_trees(vm, visit);
}

/* ---- minor collections ---- */
static void minor_visit(vs_scheme *vm, vs_value *slot) {
  vs_value v = *slot;
  if (VS_DEBUG_STRESS) vm->gc->visits++;
  if (!vs_is_object(v) || !vs_gc_is_young(vm, vs_object_of(v))) return;
  vs_object *o = vs_object_of(v);
  uint64_t *corpse = (uint64_t *)(void *)o;
  if (!(o->gc & GC_MOVED)) {
    vs_object *copy = gc_cell(vm, o->words);      /* gc_cell cannot fail in a minor collection, since blocks are
                                                   * reserved */
    uint64_t *to = (uint64_t *)(void *)copy;
    bool traced = vs_layout[o->type].first != 0;
    size_t words = o->words;
    for (size_t i = 0; i < words; i++) to[i] = corpse[i];     /* most objects have a few words, for which a loop is
                                                               * faster than a call of memcpy */
    /* The header of the moved object now contains GC_MOVED, and above it the address of the next copy in the worklist.
     * Word 1 is the object's new address. */
    corpse[0] = (uint64_t)GC_MOVED << 8;
    corpse[1] = (uint64_t)(uintptr_t)copy;
    if (traced) {
      corpse[0] |= (uint64_t)(uintptr_t)vm->gc->grey << 16;
      vm->gc->grey = o;
    }
  }
  *slot = vs_from_object((void *)(uintptr_t)corpse[1]);
}

static void minor_trace(vs_scheme *vm, vs_object *o) {
  size_t n;
  vs_value *slots = vs_layout_slots(o, &n);
  for (size_t i = 0; i < n; i++) minor_visit(vm, &slots[i]);
}

/* A function that is called with every old object, in no particular order. */
typedef void gc_each(vs_scheme *vm, vs_object *o);
static void gc_walk_old(vs_scheme *vm, gc_each *f) {
  struct vs_gc *gc = vm->gc;
  for (struct vs_gc_block *b = gc->blocks; b; b = b->next)
    for (uint32_t at = 0; at < b->used; at += b->words * 8u) {
      vs_object *o = (vs_object *)(void *)((char *)b->data + at);
      if (!(o->gc & GC_FREE)) f(vm, o);
    }
  for (struct vs_gc_large *l = gc->large; l; l = l->next) f(vm, (vs_object *)(void *)(l + 1));
  for (size_t at = 0; at < gc->image_bytes;) {
    vs_object *o = (vs_object *)(void *)(gc->image + at);
    at += (size_t)o->words * 8;
    f(vm, o);
  }
}

static void minor_remembered(vs_scheme *vm, vs_object *o) {
  if (o->gc & GC_REMEMBERED) {
    o->gc &= (uint8_t)~GC_REMEMBERED;
    minor_trace(vm, o);
  }
}

static void gc_trace_foreign(vs_scheme *vm, void (*visit)(vs_scheme *, vs_value *)) {
  for (size_t i = 0; i < vm->gc->tracing_count; i++) {
    vs_foreign *f = (vs_foreign *)(void *)vm->gc->tracing[i];
    if (f->object) f->type->trace(vm, f->object, visit);
  }
}

bool vs_gc_is_minor(const vs_scheme *vm) { return vm->gc->minor; }

/* Returns the host's time in seconds, or 0 without a clock. */
static double gc_clock(vs_scheme *vm) { return vm->config.clock ? vm->config.clock(vm->config.user) : 0; }
/* Notes the end of a collection that began at `since`. */
static void gc_note_pause(vs_scheme *vm, double since) {
  double pause = gc_clock(vm) - since;
  if (pause > vm->pause) vm->pause = pause;
}

void vs_gc_minor(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  double since = gc_clock(vm);
  if (!gc->ready) return;      /* the nursery could not be opened for lack of reserved blocks, so it contains no
                                * objects */
  gc->grey = NULL;
  gc->visits = (size_t)(vm->stack_end - vm->top) / 16;      /* zeroing the stack above vm->top counts as visits of these
                                                             * slots */
  gc->minor = true;
  gc_visit_roots(vm, minor_visit);
  if (gc->remembered_lost) gc_walk_old(vm, minor_remembered);
  else for (size_t i = 0; i < gc->remembered_count; i++) minor_remembered(vm, gc->remembered[i]);
  gc->remembered_count = 0; gc->remembered_lost = false;
  gc_trace_foreign(vm, minor_visit);
  /* Young foreign objects that were moved are live; their trace functions pass their values to the collector. These
   * values may keep further objects alive, so the loop repeats until there are no new ones. */
  bool again = true;
  while (again) {
    while (gc->grey) {
      uint64_t *corpse = (uint64_t *)(void *)gc->grey;
      gc->grey = (vs_object *)(uintptr_t)(corpse[0] >> 16);
      minor_trace(vm, (vs_object *)(void *)(uintptr_t)corpse[1]);
    }
    again = false;
    for (size_t i = 0; i < gc->young_count; i++) {
      vs_object *o = gc->young_foreign[i];
      if (!o || !(o->gc & GC_MOVED)) continue;
      vs_foreign *f = (vs_foreign *)(void *)(uintptr_t)((uint64_t *)(void *)o)[1];
      gc->young_foreign[i] = NULL;
      if (f->type->trace) {
        gc->tracing[gc->tracing_count++] = &f->h;
        f->type->trace(vm, f->object, minor_visit);
        again = true;
      }
    }
  }
  for (size_t i = 0; i < gc->young_count; i++)
    if (gc->young_foreign[i]) gc_finalize(vm, gc->young_foreign[i]);
  gc->young_count = 0;
  gc->minor = false;
  if (VS_DEBUG_STRESS || VS_DEBUG_CHECK) memset(vm->nursery, 0xAB, (size_t)(vm->free - vm->nursery));
  vm->free = vm->nursery;
  vm->collections++;
  gc->external_minor = gc->external + (32u << 20);
  vs_value was = vm->condition;
  gc->ready = gc_reserve(vm);
  vm->condition = was;
  /* If memory for the reserved blocks is refused, the nursery remains closed, and the next allocation tries again. */
  if (gc->ready) gc_hold_down(vm); else vm->end = vm->free;
  gc_note_pause(vm, since);
  if (VS_DEBUG_CHECK && !vs_gc_check(vm)) __builtin_trap();
}

/* ---- major collections ---- */
static void major_push(vs_scheme *vm, vs_object *o, size_t next) {
  struct vs_gc *gc = vm->gc;
  if (gc->mark_count == gc->mark_room) {
    vs_value was = vm->condition;
    bool grown = gc_grow(vm, &gc->marks, &gc->mark_room, gc->mark_count, sizeof *gc->marks);
    vm->condition = was;
    if (!grown) { gc->mark_lost = true; return; }
  }
  gc->marks[gc->mark_count++] = (struct mark_entry){o, next};
}

static void major_visit(vs_scheme *vm, vs_value *slot) {
  if (!vs_is_object(*slot)) return;
  vs_object *o = vs_object_of(*slot);
  if (o->gc & GC_MARK) return;
  o->gc |= GC_MARK;
  if (vs_layout[o->type].first) major_push(vm, o, 0);
}

static void major_drain(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  while (gc->mark_count) {
    struct mark_entry e = gc->marks[--gc->mark_count];
    size_t n;
    vs_value *slots = vs_layout_slots(e.o, &n);
    size_t stop = n;
    if (n - e.next > 64) {                     /* a long object is visited in pieces of 64 slots, so that the mark stack
                                                * remains small */
      stop = e.next + 64;
      major_push(vm, e.o, stop);
      if (gc->mark_lost) stop = n;
    }
    for (size_t i = e.next; i < stop; i++) major_visit(vm, &slots[i]);
  }
}

static void major_rescan(vs_scheme *vm, vs_object *o) {
  if (!(o->gc & GC_MARK)) return;
  size_t n;
  vs_value *slots = vs_layout_slots(o, &n);
  for (size_t i = 0; i < n; i++) major_visit(vm, &slots[i]);
  major_drain(vm);
}

/* Frees chunks that have no block in use, as long as the remaining chunks have enough spare blocks. */
static void major_give_back(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  size_t keep = gc_blocks_needed(vm), leaving = 0;
  for (struct vs_gc_chunk *c = gc->chunks; c; c = c->next) c->live = 0;
  for (struct vs_gc_block *b = gc->blocks; b; b = b->next) b->chunk->live++;
  for (struct vs_gc_chunk *c = gc->chunks; c; c = c->next) {
    c->leaving = c->live == 0 && gc->spares - leaving >= keep + c->count;
    if (c->leaving) leaving += c->count;
  }
  if (!leaving) return;
  gc->spares -= leaving;
  for (struct vs_gc_block **b = &gc->spare; *b;)
    if ((*b)->chunk->leaving) *b = (*b)->next; else b = &(*b)->next;
  for (struct vs_gc_chunk **c = &gc->open; *c;)
    if ((*c)->leaving) *c = (*c)->open; else c = &(*c)->open;
  for (struct vs_gc_chunk **link = &gc->chunks, *c; (c = *link);)
    if (c->leaving) { *link = c->next; gc_drop_chunk(vm, c); }
    else link = &c->next;
}

static void major_sweep(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  size_t live = 0;
  for (unsigned k = 0; k < CLASSES; k++) { gc->of[k].free = NULL; gc->of[k].bump = NULL; }
  struct vs_gc_block **link = &gc->blocks;
  for (struct vs_gc_block *b; (b = *link);) {
    unsigned k = gc->class_of[b->words];
    struct free_cell *head = gc->of[k].free;
    size_t cells = 0, step = b->words * 8u;
    bool stays = false;                        /* stays: whether the block remains in use; cells of a block that becomes
                                                * spare are not added to the free list */
    for (size_t at = 0; at < b->used && !stays; at += step)
      stays = (((vs_object *)(void *)((char *)b->data + at))->gc & GC_MARK) != 0;
    for (size_t at = 0; at < b->used; at += step) {
      vs_object *o = (vs_object *)(void *)((char *)b->data + at);
      if (o->gc & GC_MARK) { o->gc &= (uint8_t)~GC_MARK; cells++; continue; }
      if (!(o->gc & GC_FREE)) {
        if (o->type == VS_T_FOREIGN) gc_finalize(vm, o);
        if (VS_DEBUG_STRESS || VS_DEBUG_CHECK) memset(o, 0xAB, step);
        o->gc = GC_FREE;
      }
      if (!stays) continue;
      struct free_cell *f = (struct free_cell *)(void *)o;
      f->next = head; head = f;
    }
    if (cells == 0) {                          /* removes an empty block's cells from the free list */
      *link = b->next;
      b->next = gc->spare; gc->spare = b; gc->spares++;
    } else {
      gc->of[k].free = head;
      live += cells * step;
      if (b->used + step <= BLOCK_DATA) gc->of[k].bump = b;
      link = &b->next;
    }
  }
  struct vs_gc_large **at = &gc->large;
  for (struct vs_gc_large *l; (l = *at);) {
    vs_object *o = (vs_object *)(void *)(l + 1);
    if (o->gc & GC_MARK) {
      o->gc &= (uint8_t)~GC_MARK;
      live += l->bytes;
      at = &l->next;
    } else {
      *at = l->next;
      vs_mem(vm, l, sizeof *l + l->bytes, 0);
    }
  }
  for (size_t i = 0; i < gc->image_bytes;) {
    vs_object *o = (vs_object *)(void *)(gc->image + i);
    size_t slots = 0;
    /* Dead objects of the heap image are not freed. For debugging, their references are cleared, so that the check of
     * the heap does not follow them. */
    if (VS_DEBUG_STRESS || VS_DEBUG_CHECK) {
      vs_value *slot = vs_layout_slots(o, &slots);
      while (!(o->gc & GC_MARK) && slots > 0) slot[--slots] = VS_FALSE;
    }
    o->gc &= (uint8_t)~GC_MARK;
    i += (size_t)o->words * 8;
  }
  gc->old_bytes = live;
  major_give_back(vm);
}

void vs_gc_major(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  double since = gc_clock(vm);
  vs_gc_minor(vm);
  if (vm->free != vm->nursery) return;         /* the minor collection could not empty the nursery, because memory was
                                                * refused */
  gc->mark_lost = false;
  gc_visit_roots(vm, major_visit);
  major_drain(vm);
  for (;;) {
    /* Foreign objects with trace functions may contain references that only these functions can find. */
    size_t before = gc->mark_count;
    for (size_t i = 0; i < gc->tracing_count; i++) {
      vs_foreign *f = (vs_foreign *)(void *)gc->tracing[i];
      if (f->h.gc & GC_MARK) f->type->trace(vm, f->object, major_visit);
    }
    if (gc->mark_count == before && !gc->mark_lost) break;
    major_drain(vm);
    while (gc->mark_lost) {
      gc->mark_lost = false;
      gc_walk_old(vm, major_rescan);
    }
  }
  size_t kept = 0;
  for (size_t i = 0; i < gc->tracing_count; i++)
    if (gc->tracing[i]->gc & GC_MARK) gc->tracing[kept++] = gc->tracing[i];
  gc->tracing_count = kept;
  /* The minor collection has emptied the remembered set, but trace functions may have stored addresses of young objects
   * in old objects since. */
  kept = 0;
  for (size_t i = 0; i < gc->remembered_count; i++)
    if (gc->remembered[i]->gc & GC_MARK) gc->remembered[kept++] = gc->remembered[i];
  gc->remembered_count = kept;
  major_sweep(vm);
  size_t live = gc->old_bytes + gc->external;
  gc->major_at = live * 2 > FIRST_MAJOR ? live * 2 : FIRST_MAJOR;
  if (gc->mark_room > 1 << 16) {
    vs_mem(vm, gc->marks, gc->mark_room * sizeof *gc->marks, 0);
    gc->marks = NULL; gc->mark_room = 0;
  }
  gc_note_pause(vm, since);
  if (VS_DEBUG_CHECK && !vs_gc_check(vm)) __builtin_trap();
}

/* ---- checking the heap ---- */
static void check_object(vs_scheme *vm, vs_object *o) {
  size_t n;
  bool good = o->type < VS_T_COUNT && o->words >= 2 && !(o->gc & (GC_FREE | GC_MOVED));
  if (good) {
    vs_value *slots = vs_layout_slots(o, &n);
    for (size_t i = 0; good && i < n; i++) {
      if (!vs_is_object(slots[i])) continue;
      vs_object *to = vs_object_of(slots[i]);
      good = vs_gc_is_young(vm, to) ? (char *)to < vm->free && (o->gc & GC_REMEMBERED) : !(to->gc & GC_FREE);
      good = good && to->type < VS_T_COUNT && to->words >= 2;
    }
  }
  if (!good) vm->gc->mark_lost = true;         /* mark_lost serves as the result of this check: true if the heap is
                                                * inconsistent */
}

bool vs_gc_check(vs_scheme *vm) {
  vm->gc->mark_lost = false;
  gc_walk_old(vm, check_object);
  bool good = !vm->gc->mark_lost;
  vm->gc->mark_lost = false;
  return good;
}

void vs_gc_fail_after(vs_scheme *vm, size_t n) {
  vm->fail_after = n;
  if (vm->gc->ready) gc_hold_down(vm);
}

/* ---- opening and closing the heap ---- */
bool vs_gc_open(vs_scheme *vm) {
  struct vs_gc *gc = vs_mem(vm, NULL, 0, sizeof *gc);
  VS_ASSERT(!vm->gc);
  if (!gc) return false;
  memset(gc, 0, sizeof *gc);
  vm->gc = gc;
  gc->major_at = FIRST_MAJOR;
  gc->granted = SIZE_MAX / 2;
  gc->external_minor = 32u << 20;
  for (unsigned w = 0, k = 0; w <= CLASS_MAX; w++) {
    if (w > class_words[k]) k++;
    gc->class_of[w] = (uint8_t)k;
  }
  vm->nursery = vs_mem(vm, NULL, 0, NURSERY);
  if (!vm->nursery) return false;
  vm->nursery_bytes = NURSERY;
  vm->free = vm->end = vm->nursery;
  gc->nursery_end = vm->nursery + NURSERY;
  gc->ready = gc_reserve(vm);
  if (gc->ready) gc_hold_down(vm);
  return gc->ready;
}

void vs_gc_adopt(vs_scheme *vm, void *image, size_t bytes, void (*release)(vs_scheme *vm, void *image, size_t bytes)) {
  vm->gc->image = image;
  vm->gc->image_bytes = bytes;
  vm->gc->release_image = release;
}

static void close_object(vs_scheme *vm, vs_object *o) {
  if (o->type == VS_T_FOREIGN) gc_finalize(vm, o);
}

void vs_gc_close(vs_scheme *vm) {
  struct vs_gc *gc = vm->gc;
  if (!gc) return;
  for (size_t i = 0; i < gc->young_count; i++) gc_finalize(vm, gc->young_foreign[i]);
  gc_walk_old(vm, close_object);
  while (gc->large) {
    struct vs_gc_large *l = gc->large;
    gc->large = l->next;
    vs_mem(vm, l, sizeof *l + l->bytes, 0);
  }
  while (gc->chunks) {
    struct vs_gc_chunk *c = gc->chunks;
    gc->chunks = c->next;
    gc_drop_chunk(vm, c);
  }
  if (gc->marks) vs_mem(vm, gc->marks, gc->mark_room * sizeof *gc->marks, 0);
  if (gc->remembered) vs_mem(vm, gc->remembered, gc->remembered_room * sizeof *gc->remembered, 0);
  if (gc->young_foreign) vs_mem(vm, gc->young_foreign, gc->young_room * sizeof *gc->young_foreign, 0);
  if (gc->tracing) vs_mem(vm, gc->tracing, gc->tracing_room * sizeof *gc->tracing, 0);
  if (gc->image) gc->release_image(vm, gc->image, gc->image_bytes);
  if (vm->nursery) vs_mem(vm, vm->nursery, vm->nursery_bytes, 0);
  vs_mem(vm, gc, sizeof *gc, 0);
  vm->gc = NULL;
}
