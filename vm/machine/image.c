/* Writes and loads the heap image.
 *
 * It consists of 64-bit words: magic number, sum of the native tables, number of words of all objects, number of words
 * of the natives among them. Then follow vm->sym, vm->at, and the objects in sequence, natives first. A pointer is the
 * address that its object has if the image is mapped at IMAGE_HOME. The `def` of a native is its number, counted
 * through all tables.
 *
 * Loading maps the image at IMAGE_HOME (image_map), and writes only to the natives. If the image cannot be mapped, it
 * is copied, and one pass over the words that contain values (vm/values/layout.h) adjusts the pointers: about a
 * millisecond per megabyte. Tables keyed by address are marked, so that their first use inserts every entry again. */
#define _GNU_SOURCE
#include "vm/machine/image.h"

#if defined(__linux__) && UINTPTR_MAX == UINT64_MAX
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

#include "vm/compiler/code.h"
#include "vm/values/gc.h"
#include "vm/values/layout.h"
#include "vm/machine/native.h"

#define MAGIC UINT64_C(0x31656D6865537356) /* "VsSheme1", least significant byte first */
enum {
  SYMBOLS = sizeof((vs_scheme *)0)->sym / sizeof(vs_value),
  ANCHORS = sizeof((vs_scheme *)0)->at / sizeof(vs_value),
  FIRST = 4, /* index of the first symbol in the image, after four words */
  HEADER = FIRST + SYMBOLS + ANCHORS
};
/* The address for which the image is written: its pointers are valid if it is mapped there. The address is below 2^39,
 * the smallest address space of 64-bit systems. Programs with fixed addresses are at lower addresses, libraries and
 * stacks at higher addresses. */
#define IMAGE_HOME UINT64_C(0x2000000000)
#define OBJECTS_HOME (IMAGE_HOME + HEADER * 8)

#define VS_NATIVES(name) extern const vs_native_table vs_##name##_natives;
#include "vm/machine/natives.def"
#undef VS_NATIVES

static const vs_native_table *const own_tables[] = {
#define VS_NATIVES(name) &vs_##name##_natives,
#include "vm/machine/natives.def"
#undef VS_NATIVES
};
enum { OWN_TABLES = sizeof own_tables / sizeof own_tables[0] };

/* ---- numbers of natives ---- */

/* Returns table number i of natives, or NULL if there is none. The VM's own tables precede those of the host. */
static const vs_native_table *image_table(const vs_scheme *vm, size_t i) {
  if (i < OWN_TABLES) return own_tables[i];
  return vm->config.tables ? vm->config.tables[i - OWN_TABLES] : NULL;
}

static uint64_t image_sum(const vs_scheme *vm) {
  uint64_t sum = UINT64_C(14695981039346656037); /* sum: FNV-1a hash of the names of all natives, and of the numbers of
                                                  * symbols and anchors (members of vm->at) */
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

/* Sets *list to an array of all natives in the order of their numbers. The caller frees it: *count * sizeof(void *)
 * bytes. */
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

/* ---- writing: numbers the reachable objects breadth first, then writes them with pointers for IMAGE_HOME ---- */

struct place { const vs_object *o; uint64_t offset; };
struct writer {
  vs_scheme *vm;
  const vs_object **order;
  size_t count, room;
  struct place *places; /* places: hash table from an object's address to its offset, with open addressing */
  size_t slots;
  uint64_t bytes, native_bytes;
  bool foreign;
};

/* Returns the slot of the hash table that contains the object, or the free slot where it belongs. The number of slots
 * is a power of two. */
static size_t writer_slot(const struct writer *w, const vs_object *o) {
  size_t i = (size_t)((uint64_t)(uintptr_t)o * UINT64_C(0x9E3779B97F4A7C15) >> 20) & (w->slots - 1);
  VS_ASSERT(w->slots > 0 && (w->slots & (w->slots - 1)) == 0);
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
  w->places[writer_slot(w, o)].o = o;
  w->order[w->count++] = o;
  return true;
}

/* Assigns offsets in the image to the reachable objects: natives first, all in the order in which they were found. */
static bool writer_place(struct writer *w) {
  const vs_object **order = vs_mem(w->vm, NULL, 0, w->room * sizeof *order);
  size_t n = 0;
  if (!order) return false;
  for (int natives = 1; natives >= 0; natives--) {
    for (size_t i = 0; i < w->count; i++) {
      const vs_object *o = w->order[i];
      if ((o->type == VS_T_NATIVE) != natives) continue;
      w->places[writer_slot(w, o)].offset = w->bytes;
      w->bytes += (uint64_t)o->words * 8;
      order[n++] = o;
    }
    if (natives) w->native_bytes = w->bytes;
  }
  vs_mem(w->vm, w->order, w->room * sizeof *order, 0);
  w->order = order;
  return true;
}

static vs_value writer_value(const struct writer *w, vs_value v) {
  if (!vs_is_object(v)) return v;
  return VS_TAG_POINTER << 48 | (OBJECTS_HOME + w->places[writer_slot(w, vs_object_of(v))].offset);
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
  } else if (o->type == VS_T_TABLE) { /* the keys of a hash table by address get other addresses: marks the table, so
                                       * that its next use inserts its entries again */
    ((vs_table *)(void *)h)->young = 0;
    ((vs_table *)(void *)h)->epoch = UINT64_MAX;
  }
  return true;
}

bool vs_image_write(vs_scheme *vm, bool (*put)(void *to, const uint64_t *words, size_t count), void *to) {
  struct writer w = { .vm = vm };
  const vs_value *symbols = (const vs_value *)(const void *)&vm->sym,
                 *anchors = (const vs_value *)(const void *)&vm->at;
  uint64_t header[HEADER], *copy = NULL;
  size_t copy_words = 1;
  vs_gc_major(vm); /* no object moves after this collection, since vs_mem does not collect garbage */
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
  ok = ok && writer_place(&w) && (copy = vs_mem(vm, NULL, 0, copy_words * 8));
  if (ok) {
    header[0] = MAGIC;
    header[1] = image_sum(vm);
    header[2] = w.bytes / 8;
    header[3] = w.native_bytes / 8;
    for (size_t i = 0; i < SYMBOLS; i++) header[FIRST + i] = writer_value(&w, symbols[i]);
    for (size_t i = 0; i < ANCHORS; i++) header[FIRST + SYMBOLS + i] = writer_value(&w, anchors[i]);
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

/* ---- mapping a part of the program's file ---- */

#if defined(__linux__) && UINTPTR_MAX == UINT64_MAX
typedef struct { uintptr_t from, end; off_t offset; } wanted; /* from, end: start and end of the constant in memory;
                                                               * offset: its offset in the program's file in bytes, or
                                                               * -1 if unknown */

/* Finds the constant in the first loaded module only, which is the program itself. Its file is /proc/self/exe. The file
 * of a library could have been replaced since it was loaded. */
static int find_in_program(struct dl_phdr_info *module, size_t size, void *to) {
  wanted *w = to;
  (void)size;
  for (unsigned i = 0; i < module->dlpi_phnum; i++) {
    const ElfW(Phdr) *part = &module->dlpi_phdr[i];
    uintptr_t start = (uintptr_t)(module->dlpi_addr + part->p_vaddr);
    if (part->p_type == PT_LOAD && w->from >= start && w->end <= start + part->p_filesz)
      w->offset = (off_t)(part->p_offset + (w->from - start));
  }
  return 1;
}

/* Maps the image, a constant in the program's file, a second time at IMAGE_HOME. Unused pages cost neither time nor
 * memory. Returns NULL if mapping is impossible, so that the image must be copied. */
static void *image_map(const void *image, size_t bytes) {
  wanted w = { (uintptr_t)image, (uintptr_t)image + bytes, -1 };
  dl_iterate_phdr(find_in_program, &w);
  int file = w.offset < 0 || w.offset % sysconf(_SC_PAGESIZE) ? -1 : open("/proc/self/exe", O_RDONLY | O_CLOEXEC);
  if (file < 0) return NULL;
  void *home = (void *)(uintptr_t)IMAGE_HOME; /* without FIXED_NOREPLACE, mmap may choose another address */
  void *at = mmap(home, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_FIXED_NOREPLACE, file, w.offset);
  close(file);
  if (at == home) return at;
  if (at != MAP_FAILED) munmap(at, bytes);
  return NULL;
}

static void image_unmap(vs_scheme *vm, void *objects, size_t bytes) {
  (void)vm;
  munmap((char *)objects - HEADER * 8, HEADER * 8 + bytes);
}

#else

static void *image_map(const void *image, size_t bytes) { return (void)image, (void)bytes, NULL; }
static void image_unmap(vs_scheme *vm, void *objects, size_t bytes) { (void)vm, (void)objects, (void)bytes; }

#endif

/* ---- loading the image ---- */

static void image_free(vs_scheme *vm, void *at, size_t bytes) { vs_mem(vm, at, bytes, 0); }

/* Adds to a pointer the distance from IMAGE_HOME to the image's actual address, in bytes. The addition does not change
 * the tag in the pointer's upper bits. */
static inline void image_relocate(vs_value *slot, uint64_t by) {
  if (vs_is_object(*slot)) *slot += by;
}

static void image_relocate_all(char *at, size_t bytes, uint64_t by) {
  for (size_t i = 0; i < bytes;) {
    vs_object *o = (vs_object *)(void *)(at + i);
    size_t n;
    vs_value *slots = vs_layout_slots(o, &n);
    for (size_t k = 0; k < n; k++) image_relocate(&slots[k], by);
    i += (size_t)o->words * 8;
  }
}

/* Returns true if this build of vs has written the image. `words` should be the mapped copy: reading the constant would
 * load its pages, too. */
static bool image_fits(vs_scheme *vm, const uint64_t *words, size_t count) {
  return words[0] == MAGIC && words[1] == image_sum(vm) && count == HEADER + words[2];
}

bool vs_image_load(vs_scheme *vm, const vs_image *image) {
  static const char other_build[] = "the heap image was made by another build";
  if (image->count < HEADER) return vs_fail(vm, vm->sym.internal, other_build);
  size_t bytes = (image->count - HEADER) * 8, def_count;
  char *mapped = image_map(image->words, image->count * 8), *at = mapped ? mapped + HEADER * 8 : NULL;
  const uint64_t *words = mapped ? (const uint64_t *)(const void *)mapped : image->words;
  const vs_native_def **defs = NULL;
  bool ok = image_fits(vm, words, image->count) || vs_fail(vm, vm->sym.internal, other_build);
  ok = ok && image_native_list(vm, &defs, &def_count) && (at || (at = vs_mem(vm, NULL, 0, bytes)));
  if (ok) {
    size_t native_bytes = (size_t)words[3] * 8;
    uint64_t by = (uint64_t)(uintptr_t)at - OBJECTS_HOME;
    if (!mapped) {
      memcpy(at, words + HEADER, bytes);
      image_relocate_all(at, bytes, by);
    }
    for (size_t i = 0; i < native_bytes;) {
      vs_native *native = (vs_native *)(void *)(at + i);
      native->def = defs[(uintptr_t)native->def];
      i += (size_t)native->h.words * 8;
    }
    memcpy(&vm->sym, words + FIRST, sizeof vm->sym);
    memcpy(&vm->at, words + FIRST + SYMBOLS, sizeof vm->at);
    vs_value *symbols = (vs_value *)(void *)&vm->sym, *anchors = (vs_value *)(void *)&vm->at;
    for (size_t i = 0; i < SYMBOLS; i++) image_relocate(&symbols[i], by);
    for (size_t i = 0; i < ANCHORS; i++) image_relocate(&anchors[i], by);
    vs_gc_adopt(vm, at, bytes, mapped ? image_unmap : image_free);
  } else if (mapped) {
    image_unmap(vm, at, bytes);
  }
  if (defs) vs_mem(vm, defs, def_count * sizeof *defs, 0);
  return ok;
}
