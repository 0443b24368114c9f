/* Implements equal? and hashes (equal.h). This file allocates no Scheme objects, so that addresses remain valid.
 *
 * equal? walks over both structures with an explicit stack. After more steps than most data need, it records the pairs
 * of objects that are being compared. A pair that occurs again counts as equal, as if both structures were unfolded
 * forever. Cycles therefore end, and shared structure is compared once. */
#include "vm/values/equal.h"

enum { EQUAL_STEPS_BEFORE_NOTES = 100000, HASH_NODES = 64 };

typedef struct equal_pair { vs_value a, b; } equal_pair;

typedef struct equal_walk {
  vs_scheme *vm;
  equal_pair *todo; size_t count, room;
  equal_pair *notes; size_t noted, slots;          /* notes: hash table of compared pairs, with open addressing; a is 0
                                                    * in a free slot. noted: number of pairs; slots: number of slots */
} equal_walk;

static uint64_t mix(uint64_t h, uint64_t v) {
  h = (h ^ v) * UINT64_C(0x9E3779B97F4A7C15);
  return h ^ h >> 32;
}

static bool equal_push(equal_walk *w, vs_value a, vs_value b) {
  if (w->count == w->room) {
    size_t room = w->room ? w->room * 2 : 64;
    equal_pair *todo = vs_mem(w->vm, w->todo, w->room * sizeof *todo, room * sizeof *todo);
    if (!todo) return false;
    w->todo = todo;
    w->room = room;
  }
  w->todo[w->count++] = (equal_pair){a, b};
  return true;
}

/* Returns the slot that contains the pair (a, b), or the free slot where it belongs. The number of slots is a power of
 * two. */
static equal_pair *equal_slot(equal_pair *notes, size_t slots, vs_value a, vs_value b) {
  size_t i = (size_t)mix(mix(0, a), b) & (slots - 1);
  VS_ASSERT(slots > 0 && (slots & (slots - 1)) == 0);
  while (notes[i].a && (notes[i].a != a || notes[i].b != b)) i = (i + 1) & (slots - 1);
  return &notes[i];
}

/* Records the pair (a, b). Sets *known to true if it was already recorded. Returns false when memory is out. */
static bool equal_note(equal_walk *w, vs_value a, vs_value b, bool *known) {
  if (w->noted * 2 >= w->slots) {
    size_t slots = w->slots ? w->slots * 2 : 1024;
    equal_pair *notes = vs_mem(w->vm, NULL, 0, slots * sizeof *notes);
    if (!notes) return false;
    memset(notes, 0, slots * sizeof *notes);
    bool ok = true;
    for (size_t i = 0; i < w->slots && (ok = vs_poll_turn(w->vm, i, 4)); i++)
      if (w->notes[i].a) *equal_slot(notes, slots, w->notes[i].a, w->notes[i].b) = w->notes[i];
    if (!ok) return vs_mem(w->vm, notes, slots * sizeof *notes, 0), false;
    if (w->notes) vs_mem(w->vm, w->notes, w->slots * sizeof *notes, 0);
    w->notes = notes;
    w->slots = slots;
  }
  equal_pair *slot = equal_slot(w->notes, w->slots, a, b);
  *known = slot->a != 0;
  if (!*known) {
    *slot = (equal_pair){a, b};
    w->noted++;
  }
  return true;
}

/* Returns character i of a string. */
static uint32_t string_at(const vs_string *s, uint32_t i) {
  const uint8_t *at = vs_as_bytes(s->store)->at;
  VS_ASSERT(i < s->length);
  return s->h.flags & VS_F_WIDE ? ((const uint32_t *)(const void *)at)[i] : at[i];
}

static bool string_equal(const vs_string *a, const vs_string *b) {
  if (a->length != b->length) return false;
  if (!((a->h.flags | b->h.flags) & VS_F_WIDE))
    return memcmp(vs_as_bytes(a->store)->at, vs_as_bytes(b->store)->at, a->length) == 0;
  for (uint32_t i = 0; i < a->length; i++)
    if (string_at(a, i) != string_at(b, i)) return false;
  return true;
}

static bool flat_equal(const vs_flat *a, const vs_flat *b) {
  if (a->h.flags != b->h.flags || a->h.words != b->h.words) return false;
  for (uint32_t i = 0; i < vs_flat_count(a); i++) {
    bool nan = a->at[i] != a->at[i] && b->at[i] != b->at[i];
    if (a->at[i] != b->at[i] && !nan) return false;
  }
  return true;
}

bool vs_equal(vs_scheme *vm, vs_value a, vs_value b, bool *out) {
  if (vs_eqv(a, b)) return *out = true, true;
  if (!vs_is_object(a) || !vs_is_object(b)) return *out = false, true;
  equal_walk w = {.vm = vm};
  bool ok = true, same = true;
  uint64_t steps = 0;
  for (;;) {
    if (!vs_eqv(a, b)) {
      if (!vs_is_object(a) || !vs_is_object(b) || vs_object_of(a)->type != vs_object_of(b)->type) {
        same = false;
        break;
      }
      steps++;
      if (!(ok = vs_poll_turn(vm, steps, steps > EQUAL_STEPS_BEFORE_NOTES ? 32 : 4))) break;
      int type = vs_object_of(a)->type;
      bool known = false;
      if (steps > EQUAL_STEPS_BEFORE_NOTES && (type == VS_T_PAIR || type == VS_T_VECTOR) &&
          !(ok = equal_note(&w, a, b, &known)))
        break;
      if (!known) {
        if (type == VS_T_PAIR) {
          if (!(ok = equal_push(&w, vs_cdr(a), vs_cdr(b)))) break;
          a = vs_car(a);
          b = vs_car(b);
          continue;
        }
        if (type == VS_T_VECTOR) {
          const vs_vector *x = vs_as_vector(a), *y = vs_as_vector(b);
          same = x->length == y->length;
          for (uint64_t i = x->length; same && ok && i-- > 0;)
            ok = equal_push(&w, x->at[i], y->at[i]) && vs_poll_turn(vm, i, 4);
        } else if (type == VS_T_STRING) {
          same = string_equal(vs_as_string(a), vs_as_string(b));
        } else if (type == VS_T_BYTES) {
          const vs_bytes *x = vs_as_bytes(a), *y = vs_as_bytes(b);
          same = x->length == y->length && memcmp(x->at, y->at, x->length) == 0;
        } else if (type == VS_T_FLAT) {
          same = flat_equal(vs_as_flat(a), vs_as_flat(b));
        } else if (type == VS_T_FOREIGN) {
          const vs_foreign *x = vs_as_foreign(a), *y = vs_as_foreign(b);
          same = x->type == y->type && x->type->equal && x->type->equal(x->object, y->object);
        } else {
          same = false;
        }
        if (!same || !ok) break;
      }
    }
    if (w.count == 0) break;
    w.count--;
    a = w.todo[w.count].a;
    b = w.todo[w.count].b;
  }
  if (w.todo) vs_mem(vm, w.todo, w.room * sizeof *w.todo, 0);
  if (w.notes) vs_mem(vm, w.notes, w.slots * sizeof *w.notes, 0);
  *out = same;
  return ok;
}

static uint64_t string_hash(const vs_string *s) {
  uint64_t h = 7;
  for (uint32_t i = 0; i < s->length; i++) h = h * 31 + string_at(s, i);
  return mix(h, s->length);
}

/* Returns the hash of v alone, without the elements of a pair or vector. deep: as equal? compares, not by address. Sets
 * *moves to true if the hash depends on the address of a young object. If moves is NULL, uses no address. */
static uint64_t hash_atom(vs_scheme *vm, vs_value v, bool deep, bool *moves) {
  if (!vs_is_object(v)) return mix(1, v);
  const vs_object *o = vs_object_of(v);
  if (o->type == VS_T_BIGNUM || o->type == VS_T_RATIO) return vs_number_hash(v);
  if (o->type == VS_T_SYMBOL) return mix(2, vs_as_symbol(v)->hash);
  if (deep) {
    if (o->type == VS_T_STRING) return string_hash(vs_as_string(v));
    if (o->type == VS_T_BYTES) {
      uint64_t h = 11;
      for (uint64_t i = 0; i < vs_as_bytes(v)->length; i++) h = h * 31 + vs_as_bytes(v)->at[i];
      return mix(h, 5);
    }
    if (o->type == VS_T_FLAT) {
      uint64_t h = o->flags;
      for (uint32_t i = 0; i < vs_flat_count(vs_as_flat(v)); i++) {
        double d = vs_as_flat(v)->at[i];
        h = mix(h, vs_flonum(d == 0 ? 0.0 : d));                    /* -0 and 0 must have equal hashes */
      }
      return h;
    }
    if (o->type == VS_T_FOREIGN) {
      const vs_foreign *f = vs_as_foreign(v);
      if (f->type->hash) return mix(13, f->type->hash(f->object));
      if (f->type->equal) return 13;
    }
  }
  if (!moves) return mix(3, o->type);
  if (vs_gc_is_young(vm, o)) *moves = true;
  return mix(3, v);
}

uint64_t vs_hash(vs_scheme *vm, vs_value v, uint32_t kind, bool *moves) {
  VS_ASSERT(kind <= VS_TABLE_STRING);
  if (moves) *moves = false;
  bool deep = kind == VS_TABLE_EQUAL || kind == VS_TABLE_STRING;
  if (!deep || !vs_is_object(v) || (!vs_is_pair(v) && !vs_is_vector(v))) return hash_atom(vm, v, deep, moves);
  /* Only the first nodes of a structure are hashed. This suffices to distinguish most data, and ends for cycles. */
  vs_value todo[HASH_NODES + 1];
  size_t count = 0, nodes = 0;
  todo[count++] = v;
  uint64_t h = 17;
  while (count && nodes++ < HASH_NODES) {
    v = todo[--count];
    if (vs_is_pair(v)) {
      h = mix(h, 19);
      if (count + 2 <= HASH_NODES) {
        todo[count++] = vs_cdr(v);
        todo[count++] = vs_car(v);
      }
    } else if (vs_is_vector(v)) {
      uint64_t n = vs_as_vector(v)->length;
      h = mix(h, n);
      for (uint64_t i = n < 8 ? n : 8; i-- > 0;)
        if (count < HASH_NODES) todo[count++] = vs_as_vector(v)->at[i];
    } else {
      h = mix(h, hash_atom(vm, v, true, moves));
    }
  }
  return h;
}
