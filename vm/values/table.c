/* Implements hash tables (table.h). value.h describes their layout (vs_table).
 *
 * The index uses linear probing. A removal moves later entries back, so that the index has no marks of removed entries.
 * The hash of an entry is a fixnum: 40 bits of the hash, and bit 0 set if it is computed from the address of a young
 * object. After the nursery was emptied, table_sync inserts such entries again. Their keys are then in the old space,
 * and do not move any more. */
#include "vm/values/table.h"

#include "vm/values/equal.h"
#include "vm/values/heap.h"

enum { TABLE_FIRST_ENTRIES = 8 };

static vs_vector *table_entries(const vs_table *t) { return vs_as_vector(t->entries); }
static uint32_t *table_index(const vs_table *t) { return (uint32_t *)(void *)vs_as_bytes(t->index)->at; }
static uint32_t table_mask(const vs_table *t) { return (uint32_t)(vs_as_bytes(t->index)->length / 4) - 1; }

static uint64_t table_hash(vs_scheme *vm, const vs_table *t, vs_value key) {
  bool moves;
  uint64_t h = vs_hash(vm, key, t->kind, &moves);
  return ((h >> 8 & 0xFFFFFFFFFF) << 1) | moves;
}
static uint32_t hash_home(uint64_t stored, uint32_t mask) { return (uint32_t)(stored >> 1) & mask; }

/* Adds entry number `entry` with the hash `stored` to the index, which has room. mask: number of slots of the index, a
 * power of two, minus 1. */
static void index_place(uint32_t *index, uint32_t mask, vs_value stored, uint32_t entry) {
  uint32_t i = hash_home((uint64_t)vs_fixnum(stored), mask);
  VS_ASSERT((mask & (mask + 1)) == 0);
  while (index[i]) i = (i + 1) & mask;
  index[i] = entry + 1;
}
/* Adds the entry with this number to the table's index. */
static void table_place(vs_table *t, uint32_t entry) {
  VS_ASSERT(entry < t->used);
  index_place(table_index(t), table_mask(t), table_entries(t)->at[entry * 3 + 2], entry);
}

/* Frees slot i of the index, which is in use. Moves back later slots that a search would no longer reach. */
static void table_unplace(vs_table *t, uint32_t i) {
  uint32_t *index = table_index(t), mask = table_mask(t);
  VS_ASSERT(i <= mask && index[i] != 0);
  for (uint32_t j = i;;) {
    index[i] = 0;
    for (;;) {
      j = (j + 1) & mask;
      if (!index[j]) return;
      uint32_t home = hash_home((uint64_t)vs_fixnum(table_entries(t)->at[(index[j] - 1) * 3 + 2]), mask);
      if (((j - home) & mask) >= ((j - i) & mask)) break;
    }
    index[i] = index[j];
    i = j;
  }
}

static void table_sync(vs_scheme *vm, vs_table *t) {
  if (t->epoch == vm->collections) return;
  vs_value *at = table_entries(t)->at;
  for (uint32_t e = t->young; e < t->used; e++) {
    if (at[e * 3] == VS_VACANT) continue;
    uint64_t old = (uint64_t)vs_fixnum(at[e * 3 + 2]);
    if (!(old & 1)) continue;
    uint32_t *index = table_index(t), mask = table_mask(t), i = hash_home(old, mask);
    while (index[i] != e + 1) i = (i + 1) & mask;
    table_unplace(t, i);
    at[e * 3 + 2] = vs_fix((int64_t)table_hash(vm, t, at[e * 3]));
    table_place(t, e);
  }
  t->young = t->used;
  t->epoch = vm->collections;
}

/* Sets *entry to the number of the entry with this key, or to -1 if there is none, and *slot to its position in the
 * index. Returns false if memory runs out during a comparison. */
static bool table_find(vs_scheme *vm, vs_table *t, vs_value key, uint64_t hash, int64_t *entry, uint32_t *slot) {
  uint32_t *index = table_index(t), mask = table_mask(t);
  vs_value *at = table_entries(t)->at;
  bool deep = t->kind == VS_TABLE_EQUAL || t->kind == VS_TABLE_STRING;
  for (uint32_t i = hash_home(hash, mask); index[i]; i = (i + 1) & mask) {
    uint32_t e = index[i] - 1;
    vs_value *p = &at[e * 3];
    if ((uint64_t)vs_fixnum(p[2]) >> 1 != hash >> 1) continue;
    bool same = vs_eqv(p[0], key);
    if (!same && deep && !vs_equal(vm, p[0], key, &same)) return false;
    if (same) return *entry = e, *slot = i, true;
  }
  return *entry = -1, true;
}

bool vs_make_table(vs_scheme *vm, uint32_t kind, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  VS_ASSERT(kind <= VS_TABLE_STRING);
  if (!vs_make_vector(vm, TABLE_FIRST_ENTRIES * 3, VS_VACANT, &r[0]) ||
      !vs_make_bytes(vm, TABLE_FIRST_ENTRIES * 2 * 4, &r[1]))
    return false;
  vs_table *t = (vs_table *)(void *)vs_gc_alloc(vm, VS_T_TABLE, VS_WORDS(vs_table));
  if (!t) return false;
  t->entries = r[0];
  t->index = r[1];
  t->kind = kind;
  t->epoch = vm->collections;
  *out = vs_from_object(t);
  return true;
}

/* Makes room for another entry of the table. If many entries were removed, closes the gaps instead of growing. `table`
 * points to a root of the garbage collector. Returns false when memory is out. */
static bool table_reserve(vs_scheme *vm, const vs_value *table) {
  vs_table *t = vs_as_table(*table);
  uint32_t room = (uint32_t)(table_entries(t)->length / 3);
  if (t->used < room) return true;
  uint32_t new_room = t->count > room / 2 ? room * 2 : room;
  if (new_room > UINT32_MAX / 16) return vs_fail(vm, vm->sym.range, "the hash table would be too large");
  VS_ROOTS(vm, r, 2);
  if (!vs_make_vector(vm, (size_t)new_room * 3, VS_VACANT, &r[0]) ||
      !vs_make_bytes(vm, (size_t)new_room * 2 * 4, &r[1]))
    return false;
  t = vs_as_table(*table);
  table_sync(vm, t);
  vs_vector *to = vs_as_vector(r[0]), *from = table_entries(t);
  uint32_t n = 0, *index = (uint32_t *)(void *)vs_as_bytes(r[1])->at, mask = new_room * 2 - 1;
  for (uint32_t e = 0; e < t->used; e++) {
    if (from->at[e * 3] == VS_VACANT) continue;
    for (uint32_t k = 0; k < 3; k++) vs_gc_store(vm, to, &to->at[n * 3 + k], from->at[e * 3 + k]);
    index_place(index, mask, to->at[n * 3 + 2], n);
    n++;
    if (!vs_poll_turn(vm, e, 8)) return false;      /* polls before it changes the table, so that an interrupt leaves
                                                     * the table unchanged */
  }
  vs_gc_store(vm, t, &t->entries, r[0]);
  vs_gc_store(vm, t, &t->index, r[1]);
  t->used = n;
  t->young = 0;                                   /* the numbers of the entries have changed, so that table_sync must
                                                   * examine all entries */
  return true;
}

bool vs_table_get(vs_scheme *vm, vs_value table, vs_value key, vs_value *out) {
  vs_table *t = vs_as_table(table);
  table_sync(vm, t);
  int64_t e;
  uint32_t slot;
  if (!table_find(vm, t, key, table_hash(vm, t, key), &e, &slot)) return false;
  *out = e < 0 ? VS_VACANT : table_entries(t)->at[e * 3 + 1];
  return true;
}

bool vs_table_put(vs_scheme *vm, vs_value table, vs_value key, vs_value value) {
  VS_ROOTS(vm, r, 3);
  r[0] = table, r[1] = key, r[2] = value;
  if (!table_reserve(vm, &r[0])) return false;
  vs_table *t = vs_as_table(r[0]);
  table_sync(vm, t);
  uint64_t hash = table_hash(vm, t, r[1]);
  int64_t e;
  uint32_t slot;
  if (!table_find(vm, t, r[1], hash, &e, &slot)) return false;
  vs_vector *at = table_entries(t);
  if (e < 0) {
    e = t->used++;
    t->count++;
    vs_gc_store(vm, at, &at->at[e * 3], r[1]);
    at->at[e * 3 + 2] = vs_fix((int64_t)hash);
    table_place(t, (uint32_t)e);
  }
  vs_gc_store(vm, at, &at->at[e * 3 + 1], r[2]);
  return true;
}

bool vs_table_remove(vs_scheme *vm, vs_value table, vs_value key) {
  vs_table *t = vs_as_table(table);
  table_sync(vm, t);
  int64_t e;
  uint32_t slot;
  if (!table_find(vm, t, key, table_hash(vm, t, key), &e, &slot)) return false;
  if (e < 0) return true;
  table_unplace(t, slot);
  vs_value *at = table_entries(t)->at;
  at[e * 3] = at[e * 3 + 1] = at[e * 3 + 2] = VS_VACANT;
  t->count--;
  return true;
}

bool vs_table_clear(vs_scheme *vm, vs_value table) {
  VS_ROOTS(vm, r, 2);
  r[0] = table;
  if (!vs_make_table(vm, vs_as_table(table)->kind, &r[1])) return false;
  vs_table *t = vs_as_table(r[0]), *fresh = vs_as_table(r[1]);
  vs_gc_store(vm, t, &t->entries, fresh->entries);
  vs_gc_store(vm, t, &t->index, fresh->index);
  t->count = t->used = t->young = 0;
  return true;
}

bool vs_table_next(vs_value table, uint32_t *position, vs_value *key, vs_value *value) {
  const vs_table *t = vs_as_table(table);
  const vs_value *at = table_entries(t)->at;
  VS_ASSERT(t->count <= t->used);
  while (*position < t->used) {
    uint32_t e = (*position)++;
    if (at[e * 3] == VS_VACANT) continue;
    *key = at[e * 3];
    *value = at[e * 3 + 1];
    return true;
  }
  return false;
}
