/* Implements the store. It allocates and counts every byte of a model and, in tests, makes allocations fail. It interns
 * texts, origins and materials: equal values have one address, and nodes refer to them without reference counts.
 *
 * Interned values lie in blocks of 16 KB that are freed with the store, because a session has few different values.
 * Finding an interned value costs a hash and a probe. */
#include "model/store/store.h"

#include <stdlib.h>
#include <string.h>

#include "model/job.h"
#include "model/store/hashes.h"
#include "model/store/piece.h"
#include "model/store/store_inside.h"
#include "model/assert.h"

enum { BLOCK_SIZE = 16 * 1024 };
struct vs_block {
  vs_block *next;
  size_t size, used;
  _Alignas(16) unsigned char data[];
};

typedef struct { uint64_t hash; size_t length; char text[]; } vs_interned_text;

/* ---- memory ---- */

static void *store_libc_alloc(void *context, void *old, size_t old_size, size_t new_size) {
  (void)context;
  (void)old_size;
  if (!new_size) {
    free(old);
    return NULL;
  }
  return realloc(old, new_size);
}

vs_store *vs_store_new(vs_alloc_fn *alloc, void *context) {
  if (!alloc) alloc = store_libc_alloc;
  vs_store *s = alloc(context, NULL, 0, sizeof *s);
  if (!s) return NULL;
  *s = (vs_store){ .refs = 1, .alloc = alloc, .context = context };
  return s;
}

vs_store *vs_store_retain(vs_store *s) {
  VS_ASSERT(s->refs > 0);
  s->refs++;
  return s;
}

void vs_store_release(vs_store *s) {
  if (!s || --s->refs) return;
  if (s->kept) s->let_go(s, s->kept);
  vs_intern *tables[] = { &s->texts, &s->origins, &s->materials };
  for (int i = 0; i < 3; i++) vs_store_realloc(s, tables[i]->slots, tables[i]->room * sizeof(void *), 0);
  for (vs_block *b = s->blocks, *next; b; b = next) {
    next = b->next;
    vs_store_realloc(s, b, sizeof *b + b->size, 0);
  }
  vs_store_slabs_free(s);
  s->alloc(s->context, s, sizeof *s, 0);
}

void **vs_store_kept(vs_store *s, void (*let_go)(vs_store *s, void *kept)) {
  s->let_go = let_go;
  return &s->kept;
}

void vs_store_on_ticket(vs_store *s, void (*gone)(void *context, uint32_t id), void *context) {
  s->ticket_gone = gone;
  s->ticket_context = context;
}

bool vs_store_going(vs_store *s, uint32_t work, vs_error *e) {
  enum { MANY = 1 << 20 };
  if (!s || !s->job || (s->work += work < MANY ? work : MANY) < MANY) return true;
  s->work = 0;
  if (vs_job_going(s->job, NULL, -1)) return true;
  return vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
}

void vs_store_abandon(vs_store *s) { s->abandoned = true; }
bool vs_store_is_abandoned(const vs_store *s) { return s && s->abandoned; }

size_t vs_store_bytes(const vs_store *s) { return s->bytes; }

void vs_store_fail_at(vs_store *s, size_t n) {
  s->fail_at = n;
  s->failing = false;
}

void *vs_store_realloc(vs_store *s, void *old, size_t old_size, size_t new_size) {
  VS_ASSERT(s->bytes >= old_size);
  if (!new_size) {
    if (old) s->alloc(s->context, old, old_size, 0);
    if (old) s->bytes -= old_size;
    return NULL;
  }
  if (s->fail_at && !--s->fail_at) s->failing = true;
  if (s->failing && new_size > old_size) return NULL;
  void *new = s->alloc(s->context, old, old_size, new_size);
  if (new) s->bytes += new_size - (old ? old_size : 0);
  return new;
}

static void *store_keep(vs_store *s, size_t size) {
  size = (size + 15) & ~(size_t)15;
  vs_block *b = s->blocks;
  if (!b || b->size - b->used < size) {
    size_t room = size > BLOCK_SIZE / 4 ? size : BLOCK_SIZE;
    b = vs_store_realloc(s, NULL, 0, sizeof *b + room);
    if (!b) return NULL;
    b->size = room;
    b->used = 0;
    if (room == size && s->blocks) { /* a large item gets a block of its own, which is inserted after the block that is
                                      * being filled */
      b->next = s->blocks->next;
      s->blocks->next = b;
    } else {
      b->next = s->blocks;
      s->blocks = b;
    }
  }
  void *p = b->data + b->used;
  b->used += size;
  return p;
}

/* ---- interning ---- */

typedef uint64_t vs_intern_hash_fn(const void *item);
typedef bool vs_intern_same_fn(const void *item, const void *key);

/* Returns the slot of the hash table t that contains an item equal to `key`, or the free slot for it; NULL when memory
 * is out. The table's room is 0 or a power of two. */
static void **intern_find(vs_store *s, vs_intern *t, uint64_t hash, const void *key, vs_intern_same_fn *same,
                          vs_intern_hash_fn *hash_of) {
  VS_ASSERT((t->room & (t->room - 1)) == 0);
  if (t->count * 4 >= t->room * 3) {
    size_t room = t->room ? t->room * 2 : 64;
    void **slots = vs_store_realloc(s, NULL, 0, room * sizeof *slots);
    if (!slots) return NULL;
    memset(slots, 0, room * sizeof *slots);
    for (size_t i = 0; i < t->room; i++) {
      if (!t->slots[i]) continue;
      size_t at = hash_of(t->slots[i]) & (room - 1);
      while (slots[at]) at = (at + 1) & (room - 1);
      slots[at] = t->slots[i];
    }
    vs_store_realloc(s, t->slots, t->room * sizeof *slots, 0);
    t->slots = slots;
    t->room = room;
  }
  size_t at = hash & (t->room - 1);
  while (t->slots[at] && !same(t->slots[at], key)) at = (at + 1) & (t->room - 1);
  return &t->slots[at];
}

typedef struct { uint64_t hash; const char *text; size_t length; } vs_text_key;

static uint64_t text_slot_hash(const void *item) { return ((const vs_interned_text *)item)->hash; }

static bool text_same(const void *item, const void *key) {
  const vs_interned_text *t = item;
  const vs_text_key *k = key;
  return t->hash == k->hash && t->length == k->length && !memcmp(t->text, k->text, k->length);
}

const char *vs_store_text(vs_store *s, const char *text, size_t length) {
  vs_text_key key = { vs_hash_bytes(1, text, length), text, length };
  void **slot = intern_find(s, &s->texts, key.hash, &key, text_same, text_slot_hash);
  if (!slot) return NULL;
  if (!*slot) {
    vs_interned_text *t = length < SIZE_MAX - 64 ? store_keep(s, sizeof *t + length + 1) : NULL;
    if (!t) return NULL;
    t->hash = key.hash;
    t->length = length;
    memcpy(t->text, text, length);
    t->text[length] = '\0';
    *slot = t;
    s->texts.count++;
  }
  return ((vs_interned_text *)*slot)->text;
}

uint64_t vs_text_hash(const char *interned) {
  return ((const vs_interned_text *)(const void *)(interned - offsetof(vs_interned_text, text)))->hash;
}

static uint64_t origin_hash(const void *item) {
  const vs_origin *o = item; /* The hash contains addresses, which differ from run to run. Only this table uses it, so
                              * no output depends on it. */
  uint64_t h = vs_hash_mix((uintptr_t)o->file, (uint64_t)o->line << 32 | o->column);
  return vs_hash_mix(h, (uintptr_t)o->caller);
}

static bool origin_same(const void *item, const void *key) {
  const vs_origin *a = item, *b = key;
  return a->line == b->line && a->column == b->column && a->file == b->file && a->caller == b->caller;
}

const vs_origin *vs_store_origin(vs_store *s, const char *file, uint32_t line, uint32_t column,
                                 const vs_origin *caller) {
  vs_origin key = { vs_store_text(s, file, strlen(file)), line, column, caller };
  if (!key.file) return NULL;
  void **slot = intern_find(s, &s->origins, origin_hash(&key), &key, origin_same, origin_hash);
  if (!slot) return NULL;
  if (!*slot) {
    vs_origin *o = store_keep(s, sizeof *o);
    if (!o) return NULL;
    *o = key;
    *slot = o;
    s->origins.count++;
  }
  return *slot;
}

static uint64_t material_slot_hash(const void *item) { return vs_material_hash(item); }

static bool same_pattern(const vs_material_pattern *a, const vs_material_pattern *b) {
  return a->kind == b->kind && a->red == b->red && a->green == b->green && a->blue == b->blue && a->size == b->size &&
         a->angle == b->angle && a->picture == b->picture;
}

static bool material_same(const void *item, const void *key) {
  const vs_material *a = item, *b = key;
  return a->red == b->red && a->green == b->green && a->blue == b->blue && a->roughness == b->roughness &&
         a->metallic == b->metallic && a->transparency == b->transparency && a->ior == b->ior && a->name == b->name &&
         same_pattern(&a->pattern, &b->pattern);
}

const vs_material *vs_store_material(vs_store *s, const vs_material *m) {
  vs_material key = *m;
  key.name = vs_store_text(s, m->name ? m->name : "", m->name ? strlen(m->name) : 0);
  if (!key.name) return NULL;
  void **slot = intern_find(s, &s->materials, vs_material_hash(&key), &key, material_same, material_slot_hash);
  if (!slot) return NULL;
  if (!*slot) {
    vs_material *kept = store_keep(s, sizeof *kept);
    if (!kept) return NULL;
    *kept = key;
    *slot = kept;
    s->materials.count++;
  }
  return *slot;
}

const vs_picture *vs_store_picture(vs_store *s, const vs_picture *p) {
  vs_picture key = *p;
  key.path = vs_store_text(s, p->path, strlen(p->path));
  if (!key.path) return NULL;
  key.hash = vs_hash_bytes(vs_hash_bytes(3, p->path, strlen(p->path)), p->bytes, p->size);
  for (const vs_picture *i = s->pictures; i; i = i->next)
    if (i->hash == key.hash && i->path == key.path && i->size == key.size && !memcmp(i->bytes, p->bytes, p->size))
      return i;
  vs_picture *kept = store_keep(s, sizeof *kept);
  unsigned char *bytes = kept ? store_keep(s, p->size) : NULL;
  if (!bytes) return NULL;
  memcpy(bytes, p->bytes, p->size);
  key.bytes = bytes, key.next = s->pictures;
  *kept = key;
  return s->pictures = kept;
}

bool vs_store_grow(vs_store *s, void *slot, size_t *room, size_t need, size_t size) {
  VS_ASSERT(size > 0);
  if (need <= *room) return true;
  size_t more = *room + *room / 2 + 16;
  if (more < need) more = need;
  void *old, *fresh;
  memcpy(&old, slot, sizeof old); /* slot is the address of a pointer whose type is unknown here, so the pointer's bytes
                                   * are copied */
  fresh = more <= SIZE_MAX / size ? vs_store_realloc(s, old, *room * size, more * size) : NULL;
  if (fresh == NULL) return false;
  memcpy(slot, &fresh, sizeof fresh);
  *room = more;
  return true;
}
