/* Creates basic objects, and implements the table of symbols. */
#include "vm/values/heap.h"

#include "vm/machine/poll.h"
#include "vm/values/gc.h"
#include "vm/machine/native.h"

bool vs_cons(vs_scheme *vm, vs_value car, vs_value cdr, vs_value *out) {
  vs_pair *p;
  if (vm->end - vm->free >= (ptrdiff_t)sizeof *p) {
    p = (vs_pair *)(void *)vm->free;
    vm->free += sizeof *p;
    p->h = (vs_object){VS_T_PAIR, 0, 0, VS_WORDS(vs_pair)};
  } else {
    VS_ROOTS(vm, r, 2);
    r[0] = car; r[1] = cdr;
    p = (vs_pair *)(void *)vs_gc_alloc(vm, VS_T_PAIR, VS_WORDS(vs_pair));
    if (!p) return false;
    car = r[0]; cdr = r[1];
  }
  p->car = car; p->cdr = cdr;
  *out = vs_from_object(p);
  return true;
}

bool vs_cons_at(vs_scheme *vm, vs_value car, vs_value cdr, vs_pos pos, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = car; r[1] = cdr;
  vs_located_pair *p = (vs_located_pair *)(void *)vs_gc_alloc(vm, VS_T_PAIR, VS_WORDS(vs_located_pair));
  if (!p) return false;
  p->pair.h.flags = VS_F_LOCATED;
  p->pair.car = r[0]; p->pair.cdr = r[1]; p->pos = pos;
  *out = vs_from_object(p);
  return true;
}

bool vs_make_vector(vs_scheme *vm, size_t n, vs_value fill, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = fill;
  if (n > UINT32_MAX - 2) return vs_fail_memory(vm);
  vs_vector *v = (vs_vector *)(void *)vs_gc_alloc(vm, VS_T_VECTOR, 2 + n);
  if (!v) return false;
  v->length = n;
  for (size_t i = 0; i < n;) {
    const vs_value first = r[0];
    for (size_t end = n - i < 4096 ? n : i + 4096; i < end; i++) v->at[i] = first;
    if (i < n && !vs_poll(vm, 4096)) return false;
  }
  *out = vs_from_object(v);
  return true;
}

bool vs_make_bytes(vs_scheme *vm, size_t n, vs_value *out) {
  if (n / 8 > UINT32_MAX - 3) return vs_fail_memory(vm);
  vs_bytes *b = (vs_bytes *)(void *)vs_gc_alloc(vm, VS_T_BYTES, 2 + (n + 7) / 8);
  if (!b) return false;
  b->length = n;
  *out = vs_from_object(b);
  return true;
}

bool vs_make_string(vs_scheme *vm, size_t length, uint32_t fill, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  bool wide = fill > 255;
  VS_ASSERT(fill <= 0x10FFFF);
  if (length > UINT32_MAX) return vs_fail_memory(vm);
  if (!vs_make_bytes(vm, wide ? length * 4 : length, &r[0])) return false;
  vs_bytes *b = vs_as_bytes(r[0]);
  if (wide) {
    for (size_t i = 0; i < length; i++) {
      memcpy(b->at + 4 * i, &fill, 4);
      if (!vs_poll_turn(vm, i, 1)) return false;
    }
  } else if (!vs_poll_set(vm, b->at, (int)fill, length)) {
    return false;
  }
  vs_string *s = (vs_string *)(void *)vs_gc_alloc(vm, VS_T_STRING, VS_WORDS(vs_string));
  if (!s) return false;
  s->h.flags = wide ? VS_F_WIDE : 0;
  s->length = (uint32_t)length;
  s->store = r[0];
  *out = vs_from_object(s);
  return true;
}

/* Returns the code point that begins at s, and sets *used to its number of bytes. s has n bytes; n is not 0. For an
 * invalid byte, returns U+FFFD and sets *used to 1. */
static uint32_t utf8_next(const unsigned char *s, size_t n, size_t *used) {
  VS_ASSERT(n > 0);
  *used = 1;
  if (s[0] < 0x80) return s[0];
  int more = s[0] >= 0xF0 && s[0] < 0xF5 ? 3 : s[0] >= 0xE0 && s[0] < 0xF0 ? 2 : s[0] >= 0xC2 && s[0] < 0xE0 ? 1 : 0;
  if (!more || (size_t)more >= n) return 0xFFFD;
  uint32_t c = s[0] & (0x3Fu >> more);
  for (int i = 1; i <= more; i++) {
    if ((s[i] & 0xC0) != 0x80) return 0xFFFD;
    c = c << 6 | (s[i] & 0x3Fu);
  }
  static const uint32_t least[4] = {0, 0x80, 0x800, 0x10000};
  if (c < least[more] || c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) return 0xFFFD;
  *used = (size_t)more + 1;
  return c;
}

bool vs_string_from_utf8(vs_scheme *vm, const char *text, size_t bytes, vs_value *out) {
  const unsigned char *s = (const unsigned char *)text;
  size_t length = 0, used;
  uint32_t widest = 0;
  VS_ROOTS(vm, r, 1);
  for (size_t i = 0; i < bytes; i += used, length++) {
    uint32_t c = utf8_next(s + i, bytes - i, &used);
    if (c > widest) widest = c;
    if (!vs_poll_turn(vm, length, 1)) return false;
  }
  if (!vs_make_string(vm, length, widest > 255 ? widest : 0, &r[0])) return false;
  uint8_t *at = vs_as_bytes(vs_as_string(r[0])->store)->at;
  for (size_t i = 0, k = 0; i < bytes; i += used, k++) {
    uint32_t c = utf8_next(s + i, bytes - i, &used);
    if (widest > 255) memcpy(at + 4 * k, &c, 4);
    else at[k] = (uint8_t)c;
    if (!vs_poll_turn(vm, k, 1)) return false;
  }
  *out = r[0];
  return true;
}

bool vs_make_box(vs_scheme *vm, vs_value v, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = v;
  vs_box *b = (vs_box *)(void *)vs_gc_alloc(vm, VS_T_BOX, VS_WORDS(vs_box));
  if (!b) return false;
  b->value = r[0];
  *out = vs_from_object(b);
  return true;
}

bool vs_make_cell(vs_scheme *vm, vs_value name, vs_value v, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = name; r[1] = v;
  vs_cell *c = (vs_cell *)(void *)vs_gc_alloc(vm, VS_T_CELL, VS_WORDS(vs_cell));
  if (!c) return false;
  c->name = r[0]; c->value = r[1]; c->users = VS_NIL;
  *out = vs_from_object(c);
  return true;
}

bool vs_make_values(vs_scheme *vm, const vs_value *at, size_t n, vs_value *out) {
  if (n == 1) { *out = at[0]; return true; }
  vs_values *v = (vs_values *)(void *)vs_gc_alloc(vm, VS_T_VALUES, 2 + n);
  if (!v) return false;
  v->count = n;
  memcpy(v->at, at, n * sizeof *at);
  *out = vs_from_object(v);
  return true;
}

bool vs_make_flat(vs_scheme *vm, uint32_t tag, const double *at, size_t n, vs_value *out) {
  vs_flat *f = (vs_flat *)(void *)vs_gc_alloc(vm, VS_T_FLAT, 1 + n);
  VS_ASSERT(tag < VS_FLAT_TAGS && n <= VS_FLAT_FIELDS);
  if (!f) return false;
  f->h.flags = (uint16_t)tag;
  memcpy(f->at, at, n * sizeof *at);
  *out = vs_from_object(f);
  return true;
}

bool vs_make_keywords(vs_scheme *vm, const vs_value *names, size_t n, vs_value *out) {
  vs_keywords *k = (vs_keywords *)(void *)vs_gc_alloc(vm, VS_T_KEYWORDS, 2 + n);
  if (!k) return false;
  k->count = n;
  memcpy(k->name, names, n * sizeof *names);
  *out = vs_from_object(k);
  return true;
}

/* ---- symbols: vm->at.symbols is a vector whose element 0 is the count as a fixnum; a power of two of slots follows,
 * with #f in free slots ---- */
static uint32_t name_hash(const char *s, size_t n) {
  uint32_t h = 2166136261u;
  for (size_t i = 0; i < n; i++) h = (h ^ (unsigned char)s[i]) * 16777619u;
  return h;
}

static bool symbols_grow(vs_scheme *vm) {
  VS_ROOTS(vm, r, 1);
  size_t room = vs_is_vector(vm->at.symbols) ? (vs_as_vector(vm->at.symbols)->length - 1) * 2 : 1024;
  if (!vs_make_vector(vm, room + 1, VS_FALSE, &r[0])) return false;
  vs_vector *to = vs_as_vector(r[0]);
  to->at[0] = vs_fix(0);
  if (vs_is_vector(vm->at.symbols)) {
    vs_vector *from = vs_as_vector(vm->at.symbols);
    to->at[0] = from->at[0];
    for (size_t i = 1; i < from->length; i++) {
      if (from->at[i] == VS_FALSE) continue;
      size_t k = vs_as_symbol(from->at[i])->hash & (room - 1);
      while (to->at[k + 1] != VS_FALSE) k = (k + 1) & (room - 1);
      vs_gc_store(vm, to, &to->at[k + 1], from->at[i]);
    }
  }
  vm->at.symbols = r[0];
  return true;
}

bool vs_intern(vs_scheme *vm, const char *name, size_t bytes, vs_value *out) {
  if (bytes > UINT32_MAX / 2) return vs_fail_memory(vm);
  if (!vs_is_vector(vm->at.symbols) && !symbols_grow(vm)) return false;
  vs_vector *table = vs_as_vector(vm->at.symbols);
  uint32_t hash = name_hash(name, bytes);
  size_t mask = table->length - 2, k = hash & mask;
  for (; table->at[k + 1] != VS_FALSE; k = (k + 1) & mask) {
    vs_symbol *s = vs_as_symbol(table->at[k + 1]);
    if (s->hash == hash && s->length == bytes && memcmp(s->name, name, bytes) == 0) {
      *out = table->at[k + 1];
      return true;
    }
  }
  vs_symbol *s = (vs_symbol *)(void *)vs_gc_alloc_old(vm, VS_T_SYMBOL, VS_WORDS(vs_symbol) + bytes / 8 + 1);
  if (!s) return false;
  s->h.flags = VS_F_IMMUTABLE;
  s->hash = hash; s->length = (uint32_t)bytes;
  memcpy(s->name, name, bytes);
  *out = vs_from_object(s);
  table = vs_as_vector(vm->at.symbols);
  vs_gc_store(vm, table, &table->at[k + 1], *out);
  int64_t count = vs_fixnum(table->at[0]) + 1;
  table->at[0] = vs_fix(count);
  if ((size_t)count * 4 > mask * 3) {          /* symbols do not move, so *out stays valid even if it is no root of the
                                                * garbage collector */
    return symbols_grow(vm);
  }
  return true;
}

bool vs_intern_c(vs_scheme *vm, const char *name, vs_value *out) { return vs_intern(vm, name, strlen(name), out); }
