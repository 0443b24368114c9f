/* Owns writing and loading of the heap image.

   Layout, in 64-bit words:
     magic, sum of the native tables, words of objects, then vm->sym, then vm->at, then the objects one after another.
   A pointer value keeps its tag; its payload is the byte offset of the object, + 8 so that it is never 0.
   A native's `def` is its number, counting through all tables.
   Loading is one copy and one pass over the traced words (vm/values/layout.h): about a millisecond a megabyte. Tables keyed by address are marked so
   that their first use inserts every entry anew. */
#include "vm/machine/image.h"

#include "vm/compiler/code.h"
#include "vm/values/gc.h"
#include "vm/values/layout.h"
#include "vm/machine/native.h"

#define MAGIC UINT64_C(0x31656D6865537356) /* "VsSheme1" read from the least byte */
enum {
  SYMBOLS = sizeof((vs_scheme *)0)->sym / sizeof(vs_value),
  ANCHORS = sizeof((vs_scheme *)0)->at / sizeof(vs_value),
  HEADER = 3 + SYMBOLS + ANCHORS
};

#define VS_NATIVES(name) extern const vs_native_table vs_##name##_natives;
#include "vm/machine/natives.def"
#undef VS_NATIVES

static const vs_native_table *const own_tables[] = {
#define VS_NATIVES(name) &vs_##name##_natives,
#include "vm/machine/natives.def"
#undef VS_NATIVES
};
enum { OWN_TABLES = sizeof own_tables / sizeof own_tables[0] };

/* ---- natives by number ---- */

/* the i-th table, the VM's own first, or NULL past the last */
static const vs_native_table *image_table(const vs_scheme *vm, size_t i) {
  if (i < OWN_TABLES) return own_tables[i];
  return vm->config.tables ? vm->config.tables[i - OWN_TABLES] : NULL;
}

static uint64_t image_sum(const vs_scheme *vm) {
  uint64_t sum = UINT64_C(14695981039346656037); /* FNV-1a over every name, and the numbers of symbols and anchors */
  const vs_native_table *t;
  for (size_t i = 0; (t = image_table(vm, i)); i++)
    for (const vs_native_def *d = t->defs; d->name; d++)
      for (const char *s = d->name;; s++) {
        sum = (sum ^ (unsigned char)*s) * UINT64_C(1099511628211);
        if (!*s) break;
      }
  return (sum ^ SYMBOLS << 8 ^ ANCHORS) * UINT64_C(1099511628211);
}

static bool image_native_number(const vs_scheme *vm, const vs_native_def *def, uint64_t *number) {
  uint64_t n = 0;
  const vs_native_table *t;
  for (size_t i = 0; (t = image_table(vm, i)); i++)
    for (const vs_native_def *d = t->defs; d->name; d++, n++)
      if (d == def) {
        *number = n;
        return true;
      }
  return false;
}

/* every def in the order of their numbers; the caller frees *count * sizeof(void *) bytes */
static bool image_native_list(vs_scheme *vm, const vs_native_def ***list, size_t *count) {
  size_t n = 0;
  const vs_native_table *t;
  for (size_t i = 0; (t = image_table(vm, i)); i++)
    for (const vs_native_def *d = t->defs; d->name; d++) n++;
  const vs_native_def **at = vs_mem(vm, NULL, 0, (n ? n : 1) * sizeof *at);
  if (!at) return false;
  *count = n ? n : 1;
  *list = at;
  for (size_t i = 0; (t = image_table(vm, i)); i++)
    for (const vs_native_def *d = t->defs; d->name; d++) *at++ = d;
  return true;
}

/* ---- writing: number the reachable objects breadth first, then hand them out rewritten ---- */

struct place { const vs_object *o; uint64_t offset; };
struct writer {
  vs_scheme *vm;
  const vs_object **order;
  size_t count, room;
  struct place *places; /* open addressing by address */
  size_t slots;
  uint64_t bytes;
  bool foreign;
};

static size_t writer_slot(const struct writer *w, const vs_object *o) {
  size_t i = (size_t)((uint64_t)(uintptr_t)o * UINT64_C(0x9E3779B97F4A7C15) >> 20) & (w->slots - 1);
  while (w->places[i].o && w->places[i].o != o) i = (i + 1) & (w->slots - 1);
  return i;
}

static bool writer_grow_places(struct writer *w) {
  size_t slots = w->slots ? w->slots * 2 : 1024;
  struct place *old = w->places, *at = vs_mem(w->vm, NULL, 0, slots * sizeof *at);
  if (!at) return false;
  memset(at, 0, slots * sizeof *at);
  size_t old_slots = w->slots;
  w->places = at;
  w->slots = slots;
  for (size_t i = 0; i < old_slots; i++)
    if (old[i].o) w->places[writer_slot(w, old[i].o)] = old[i];
  if (old) vs_mem(w->vm, old, old_slots * sizeof *old, 0);
  return true;
}

static bool writer_reach(struct writer *w, vs_value v) {
  if (!vs_is_object(v)) return true;
  const vs_object *o = vs_object_of(v);
  if (w->slots && w->places[writer_slot(w, o)].o) return true;
  if (o->type == VS_T_FOREIGN) w->foreign = true;
  if (o->type == VS_T_CODE) {
    vs_code *code = vs_as_code(v);
    code->places = vs_fix((int64_t)vs_code_place(code, UINT32_MAX));
  }
  if ((w->count + 1) * 2 > w->slots && !writer_grow_places(w)) return false;
  if (w->count == w->room) {
    size_t more = w->room ? w->room * 2 : 1024;
    const vs_object **q = vs_mem(w->vm, w->order, w->room * sizeof *q, more * sizeof *q);
    if (!q) return false;
    w->order = q;
    w->room = more;
  }
  w->places[writer_slot(w, o)] = (struct place){ o, w->bytes };
  w->order[w->count++] = o;
  w->bytes += (uint64_t)o->words * 8;
  return true;
}

static vs_value writer_value(const struct writer *w, vs_value v) {
  if (!vs_is_object(v)) return v;
  return VS_TAG_POINTER << 48 | (w->places[writer_slot(w, vs_object_of(v))].offset + 8);
}

static bool writer_object(struct writer *w, const vs_object *o, uint64_t *copy) {
  memcpy(copy, o, (size_t)o->words * 8);
  vs_object *h = (vs_object *)(void *)copy;
  h->gc = 0;
  size_t n;
  vs_value *slots = vs_layout_slots(h, &n);
  for (size_t i = 0; i < n; i++) slots[i] = writer_value(w, slots[i]);
  if (o->type == VS_T_NATIVE) {
    uint64_t number;
    if (!image_native_number(w->vm, ((const vs_native *)(const void *)o)->def, &number)) {
      return vs_fail(w->vm, w->vm->sym.internal, "a native of no table cannot be in the heap image");
    }
    ((vs_native *)(void *)h)->def = (const vs_native_def *)(uintptr_t)number;
  } else if (o->type == VS_T_TABLE) { /* addresses will differ: every entry counts as new, of a collection that never was */
    ((vs_table *)(void *)h)->young = 0;
    ((vs_table *)(void *)h)->epoch = UINT64_MAX;
  }
  return true;
}

bool vs_image_write(vs_scheme *vm, bool (*put)(void *to, const uint64_t *words, size_t count), void *to) {
  struct writer w = { .vm = vm };
  const vs_value *symbols = (const vs_value *)(const void *)&vm->sym, *anchors = (const vs_value *)(const void *)&vm->at;
  uint64_t header[HEADER], *copy = NULL;
  size_t copy_words = 1;
  vs_gc_major(vm); /* nothing moves from here on: vs_mem does not collect */
  bool ok = true;
  for (size_t i = 0; ok && i < SYMBOLS; i++) ok = writer_reach(&w, symbols[i]);
  for (size_t i = 0; ok && i < ANCHORS; i++) ok = writer_reach(&w, anchors[i]);
  for (size_t k = 0; ok && k < w.count; k++) {
    vs_object *o = (vs_object *)(uintptr_t)w.order[k];
    size_t n;
    const vs_value *slots = vs_layout_slots(o, &n);
    for (size_t i = 0; ok && i < n; i++) ok = writer_reach(&w, slots[i]);
    if (o->words > copy_words) copy_words = o->words;
  }
  if (ok && w.foreign) ok = vs_fail(vm, vm->sym.internal, "an object of the host cannot be in the heap image");
  ok = ok && (copy = vs_mem(vm, NULL, 0, copy_words * 8));
  if (ok) {
    header[0] = MAGIC;
    header[1] = image_sum(vm);
    header[2] = w.bytes / 8;
    for (size_t i = 0; i < SYMBOLS; i++) header[3 + i] = writer_value(&w, symbols[i]);
    for (size_t i = 0; i < ANCHORS; i++) header[3 + SYMBOLS + i] = writer_value(&w, anchors[i]);
    ok = put(to, header, HEADER) || vs_fail(vm, vm->sym.file, "the heap image cannot be written");
  }
  for (size_t k = 0; ok && k < w.count; k++)
    ok = writer_object(&w, w.order[k], copy) &&
         (put(to, copy, w.order[k]->words) || vs_fail(vm, vm->sym.file, "the heap image cannot be written"));
  if (copy) vs_mem(vm, copy, copy_words * 8, 0);
  if (w.order) vs_mem(vm, w.order, w.room * sizeof *w.order, 0);
  if (w.places) vs_mem(vm, w.places, w.slots * sizeof *w.places, 0);
  return ok;
}

/* ---- loading ---- */

static inline void image_relocate(vs_value *slot, uint64_t base) {
  if (vs_is_object(*slot)) *slot += base - 8; /* the payload is an offset: adding stays below the tag */
}

bool vs_image_load(vs_scheme *vm, const vs_image *image) {
  const uint64_t *words = image->words;
  if (image->count < HEADER || words[0] != MAGIC || words[1] != image_sum(vm) || image->count != HEADER + words[2])
    return vs_fail(vm, vm->sym.internal, "the heap image was made by another build");
  size_t bytes = (size_t)words[2] * 8, def_count;
  const vs_native_def **defs;
  if (!image_native_list(vm, &defs, &def_count)) return false;
  char *at = vs_mem(vm, NULL, 0, bytes);
  if (at) {
    uint64_t base = (uint64_t)(uintptr_t)at;
    memcpy(at, words + HEADER, bytes);
    for (size_t i = 0; i < bytes;) {
      vs_object *o = (vs_object *)(void *)(at + i);
      size_t n;
      vs_value *slots = vs_layout_slots(o, &n);
      for (size_t k = 0; k < n; k++) image_relocate(&slots[k], base);
      if (o->type == VS_T_NATIVE) {
        vs_native *native = (vs_native *)(void *)o;
        native->def = defs[(uintptr_t)native->def];
      }
      i += (size_t)o->words * 8;
    }
    memcpy(&vm->sym, words + 3, sizeof vm->sym);
    memcpy(&vm->at, words + 3 + SYMBOLS, sizeof vm->at);
    vs_value *symbols = (vs_value *)(void *)&vm->sym, *anchors = (vs_value *)(void *)&vm->at;
    for (size_t i = 0; i < SYMBOLS; i++) image_relocate(&symbols[i], base);
    for (size_t i = 0; i < ANCHORS; i++) image_relocate(&anchors[i], base);
    vs_gc_adopt(vm, at, bytes);
  }
  vs_mem(vm, defs, def_count * sizeof *defs, 0);
  return at != NULL;
}
