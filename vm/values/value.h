/* Owns the representation of Scheme values: the NaN-boxed word, the heap objects behind it, and the accessors.

   A vs_value is 64 bits.
     below 0xFFF9 << 48   an IEEE double, unboxed (the NaN that x86 makes, 0xFFF8 << 48, is among them)
     0xFFF9 | 48 bits     a fixnum, two's complement
     0xFFFA | 48 bits     an immediate: #t, #f, (), a character, markers
     0xFFFB | 48 bits     the address of a heap object
   Doubles that come from outside pass vs_flonum(), which makes every NaN the one canonical NaN; arithmetic on canonical
   values stays canonical.

   Every heap object begins with vs_object. `words` counts the whole object in 8-byte words, header included, so that
   the heap can be walked. Objects move once, out of the nursery: C code that allocates (or calls what allocates) must
   hold values in roots (gc.h), not in plain locals; raw pointers to objects do not survive an allocation.
   Fields of type vs_value are written only through vs_gc_store (gc.h), except in an object just allocated. */
#ifndef VS_VM_VALUES_VALUE_H
#define VS_VM_VALUES_VALUE_H

#include "model/assert.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct vs_scheme vs_scheme;
typedef uint64_t vs_value;

#define VS_TAG_FIXNUM    UINT64_C(0xFFF9)
#define VS_TAG_IMMEDIATE UINT64_C(0xFFFA)
#define VS_TAG_POINTER   UINT64_C(0xFFFB)
#define VS_PAYLOAD       UINT64_C(0x0000FFFFFFFFFFFF)

#define VS_FIXNUM_MAX INT64_C(0x7FFFFFFFFFFF)
#define VS_FIXNUM_MIN (-VS_FIXNUM_MAX - 1)

/* ---- immediates: a kind in bits 32..47, a payload in bits 0..31 ---- */
#define VS_IMMEDIATE(kind, n) ((VS_TAG_IMMEDIATE << 48) | ((uint64_t)(kind) << 32) | (uint64_t)(n))
#define VS_FALSE       VS_IMMEDIATE(0, 0)
#define VS_TRUE        VS_IMMEDIATE(0, 1)
#define VS_NIL         VS_IMMEDIATE(1, 0)
#define VS_UNSPECIFIC  VS_IMMEDIATE(2, 0)   /* what (if #f #f) and set! return; the printer shows nothing in a REPL */
#define VS_EOF         VS_IMMEDIATE(3, 0)
#define VS_ABSENT      VS_IMMEDIATE(4, 0)   /* an optional or keyword argument that was not given; never a user's
                                               value */
#define VS_UNDEFINED   VS_IMMEDIATE(5, 0)   /* a variable that has no value yet (letrec, an undefined global) */
#define VS_VACANT      VS_IMMEDIATE(6, 0)   /* hash tables: a free slot, a removed entry */
#define VS_CHAR(c)     VS_IMMEDIATE(7, (uint32_t)(c))

static inline vs_value vs_bool(bool b) { return b ? VS_TRUE : VS_FALSE; }
static inline bool vs_is_true(vs_value v) { return v != VS_FALSE; }
static inline bool vs_is_char(vs_value v) { return (v >> 32) == (VS_CHAR(0) >> 32); }
/* the code point of a character */
static inline uint32_t vs_char(vs_value v) {
  VS_ASSERT(vs_is_char(v));
  return (uint32_t)v;
}

static inline bool vs_is_double(vs_value v) { return v < (VS_TAG_FIXNUM << 48); }
/* v is a double */
static inline double vs_double(vs_value v) {
  double d;
  VS_ASSERT(vs_is_double(v));
  memcpy(&d, &v, sizeof d);
  return d;
}
/* for a result of arithmetic on our own doubles */
static inline vs_value vs_flonum_raw(double d) { vs_value v; memcpy(&v, &d, sizeof v); return v; }
/* for a double that comes from anywhere else */
static inline vs_value vs_flonum(double d) { return d == d ? vs_flonum_raw(d) : UINT64_C(0x7FF8000000000000); }

static inline bool vs_is_fixnum(vs_value v) { return (v >> 48) == VS_TAG_FIXNUM; }
/* v is a fixnum */
static inline int64_t vs_fixnum(vs_value v) {
  VS_ASSERT(vs_is_fixnum(v));
  return (int64_t)(v << 16) >> 16;
}
/* n in range, or a place or a hash of 48 bits */
static inline vs_value vs_fix(int64_t n) {
  VS_ASSERT(n >= VS_FIXNUM_MIN && n <= (int64_t)VS_PAYLOAD);
  return (VS_TAG_FIXNUM << 48) | ((uint64_t)n & VS_PAYLOAD);
}
static inline bool vs_fits_fixnum(int64_t n) { return n >= VS_FIXNUM_MIN && n <= VS_FIXNUM_MAX; }

/* ---- heap objects ---- */
enum {
#define VS_OBJECT(name, noun, first, count) VS_T_##name,
#include "vm/values/object.def"
#undef VS_OBJECT
  VS_T_COUNT
};

typedef struct vs_object {
  uint8_t type;     /* VS_T_... */
  uint8_t gc;       /* the collector's own bits (gc.h) */
  uint16_t flags;   /* per type, VS_F_... below */
  uint32_t words;   /* size of the whole object in 8-byte words */
} vs_object;

enum {                          /* vs_object.flags */
  VS_F_IMMUTABLE  = 1,          /* literals: strings, vectors, bytes, pairs that the program must not change */
  VS_F_LOCATED    = 2,          /* pair: a fourth word holds its vs_pos */
  VS_F_SQUARE     = 4,          /* pair: read from [ ]; only for messages and re-printing of source */
  VS_F_WIDE       = 4,          /* string: 4 bytes a character, else 1 byte (Latin-1) */
  VS_F_CONSTANT   = 4,          /* cell: imported or registered, never assigned: calls to it may be inlined */
  VS_F_UNINTERNED = 4,          /* symbol: from generate-uninterned-symbol */
  VS_F_LOCAL      = 8,          /* symbol, alias: some local scope has bound it */
  VS_F_ASSIGNED   = 8,          /* cell: its own unit has a set! of it: who imports it shares it */
  VS_F_AROUND     = 4,          /* environment: other scopes lie in this one */
  VS_F_NEGATIVE   = 4,          /* bignum */
  VS_F_MARKED     = 4           /* closure: one that the layers above treat in a way of their own */
};

static inline bool vs_is_object(vs_value v) { return (v >> 48) == VS_TAG_POINTER; }
/* v is the address of a heap object */
static inline vs_object *vs_object_of(vs_value v) {
  VS_ASSERT(vs_is_object(v));
  return (vs_object *)(uintptr_t)(v & VS_PAYLOAD);
}
/* an address of 48 bits */
static inline vs_value vs_from_object(const void *o) {
  VS_ASSERT(((uint64_t)(uintptr_t)o & ~VS_PAYLOAD) == 0);
  return (VS_TAG_POINTER << 48) | (uint64_t)(uintptr_t)o;
}
static inline bool vs_is(vs_value v, int type) { return vs_is_object(v) && vs_object_of(v)->type == type; }

/* A place in a source file, 48 bits so that it also fits a fixnum (vs_fix(pos), back with vs_pos_of): file number
   (vm->at.files) 12 bits, line 22 bits, column 14 bits, all saturating; lines and columns from 1, 0 is unknown. Columns
   count characters. */
typedef uint64_t vs_pos;
static inline vs_pos vs_pos_make(uint32_t file, uint32_t line, uint32_t col) {
  if (file > 0xFFF) file = 0;
  if (line > 0x3FFFFF) line = 0x3FFFFF;
  if (col > 0x3FFF) col = 0x3FFF;
  return (uint64_t)file << 36 | (uint64_t)line << 14 | col;
}
static inline uint32_t vs_pos_file(vs_pos p) { return (uint32_t)(p >> 36); }
static inline uint32_t vs_pos_line(vs_pos p) { return (uint32_t)(p >> 14) & 0x3FFFFF; }
static inline uint32_t vs_pos_col(vs_pos p) { return (uint32_t)p & 0x3FFF; }
static inline vs_pos vs_pos_of(vs_value fixnum) {
  VS_ASSERT(vs_is_fixnum(fixnum));
  return fixnum & VS_PAYLOAD;
}

typedef struct { vs_object h; vs_value car, cdr; } vs_pair;
typedef struct { vs_pair pair; vs_pos pos; } vs_located_pair;   /* VS_F_LOCATED */

/* Characters are in `store`, a BYTES object, 1 or 4 bytes each (VS_F_WIDE), so that string-ref is O(1) and string-set!
   may widen. Code points, never surrogates. Conversions belong to the string module. */
typedef struct { vs_object h; uint32_t length, hash; vs_value store; } vs_string;

/* UTF-8 name, with a zero byte behind it. Interned ones are unique (vs_intern in gc.h): compare with ==. */
typedef struct { vs_object h; uint32_t hash, length; char name[]; } vs_symbol;

typedef struct { vs_object h; uint64_t length; vs_value at[]; } vs_vector;
typedef struct { vs_object h; uint64_t length; uint8_t at[]; } vs_bytes;

/* magnitude in GMP limbs, least first, the last not 0, never a value that fits a fixnum; sign in VS_F_NEGATIVE */
typedef struct { vs_object h; uint64_t count; uint64_t limb[]; } vs_bignum;
typedef struct { vs_object h; vs_value num, den; } vs_ratio;     /* lowest terms, den > 1 */

/* A compiled procedure. Never moves (allocated in the old space), so the run loop may point into it. */
typedef struct {
  vs_object h;
  vs_value name;        /* symbol or #f */
  vs_value consts;      /* vector, old space; cells, literals, nested code, keyword lists */
  vs_value ins;         /* BYTES of 32-bit instructions, old space */
  vs_value places;      /* BYTES: pc -> position, or one position as a fixnum: see code.h */
  vs_value inlined;     /* BYTES of {u32 pc, u32 constant}: instructions standing for a call of that constant's cell, by
                           pc */
  vs_value params;      /* vector of symbols: required, optional, keyword, rest: for messages */
  vs_value doc;         /* what the program may attach, or #f */
  uint32_t required, optional, keywords, registers;
  uint32_t flags;       /* VS_CODE_... */
  uint32_t free;        /* how many variables a closure of it captures */
} vs_code;
enum {
  VS_CODE_REST = 1,
  VS_CODE_SIMPLE = 2,           /* only required parameters, and none of the following */
  VS_CODE_GET = 4,              /* what define-record-type makes: a field's accessor, its modifier, */
  VS_CODE_SET = 8,
  VS_CODE_TEST = 16,            /* the predicate, */
  VS_CODE_MAKE = 32,            /* the constructor: run without an activation (record_call.h) */
  VS_CODE_RECORD = VS_CODE_GET | VS_CODE_SET | VS_CODE_TEST | VS_CODE_MAKE
};

typedef struct { vs_object h; vs_value code; vs_value free[]; } vs_closure;
/* case-lambda: closures, tried in order. A word behind the clauses is what the layers above noted of the procedure. */
typedef struct { vs_object h; uint64_t count; vs_value clause[]; } vs_case;
static inline vs_value vs_case_note(const vs_case *c) {
  return c->h.words > 2 + c->count ? c->clause[c->count] : VS_FALSE;
}
/* `max` is UINT32_MAX with a rest; `keywords` a vector of symbols or #f; `inlined` the row of inline.def, `inlined_arg`
   with it */
typedef struct {
  vs_object h;
  const struct vs_native_def *def;
  uint32_t min, max;
  vs_value name, keywords;
  uint32_t inlined, inlined_arg;
} vs_native;

/* A global variable. `users` lists the code that inlined it while VS_F_CONSTANT (patched when it is redefined). */
typedef struct { vs_object h; vs_value value, name, users; } vs_cell;
typedef struct { vs_object h; vs_value value; } vs_box;
typedef struct { vs_object h; uint64_t count; vs_value at[]; } vs_values;      /* never 1 of them */

typedef struct { vs_object h; vs_value name, fields /* vector of symbols */, parent, data; } vs_record_type;
typedef struct { vs_object h; vs_value type; vs_value at[]; } vs_record;

/* Up to 16 doubles and a tag (native.h: vs_flat_type); the tag is in h.flags. Immutable. */
typedef struct { vs_object h; double at[]; } vs_flat;
static inline uint32_t vs_flat_tag(const vs_flat *f) { return f->h.flags; }
static inline uint32_t vs_flat_count(const vs_flat *f) { return f->h.words - 1; }

/* A value and how fast it changes (dual.h). */
typedef struct { vs_object h; vs_value level /* fixnum */, value, slope; } vs_dual;

/* Insertion-ordered hash table. `entries` is a vector of triples key, value, hash (a fixnum); a removed entry's key is
   VS_VACANT. `index` is BYTES of u32 (entry number + 1, 0 free), open addressing, power of two. Keys hashed by address
   (eq?/eqv? on heap objects) change hash when they leave the nursery: entries from number `young` on were added since
   collection number `epoch`; when vm->collections has moved on, table.c re-inserts just those. */
typedef struct {
  vs_object h;
  vs_value entries, index;
  uint32_t count, used;          /* live entries; entries ever added */
  uint32_t kind, young;          /* VS_TABLE_... */
  uint64_t epoch;
} vs_table;
enum { VS_TABLE_EQ, VS_TABLE_EQV, VS_TABLE_EQUAL, VS_TABLE_STRING };

/* Fields as vm/library/port.c wants them: `buffer` BYTES or #f, `name` string or #f; `host` is a host stream's number
   or -1. */
typedef struct {
  vs_object h;
  vs_value buffer, name, data;
  int64_t host;
  uint64_t position, limit;
  uint32_t line, col, flags, peeked;
} vs_port;

typedef struct {
  vs_object h;
  vs_value done /* #t, #f */, value /* value or thunk */;
} vs_promise; /* shared through box if need be */
typedef struct { vs_object h; vs_value value, converter, name; } vs_parameter;

/* An error the system made, or (error ...). Shown as MESSAGE IRRITANT ...: "make-sphere: r must be positive, got" (-2).
   `chain` is a list of (procedure-name . position fixnum), innermost first; `place` the position of the failing
   call. */
typedef struct { vs_object h; vs_value kind /* symbol */, message /* string */, irritants /* list */, chain, payload,
    calls /* activation.c; #f: not kept */; vs_pos place; } vs_condition;

/* Captured activations, immutable: `at` is a copy of the stack; below it lies `under`, up to its slot `depth`. */
typedef struct { vs_object h; vs_value under; uint64_t depth, count,
    total /* slots, with those of all stretches below */; vs_value at[]; } vs_stack;
/* `ret` is the return information of the activation it returns into (run_loop.c) */
typedef struct {
  vs_object h;
  vs_value stack;
  uint64_t depth;
  vs_value winders, handlers, parameters, ret;
} vs_continuation;

/* Expander objects: fields are vm-front's business, all traced. */
typedef struct { vs_object h; vs_value name, table, imports, exports, parent, top, data; } vs_environment;
typedef struct { vs_object h; vs_value kind, transformer, env, data; } vs_macro;
typedef struct { vs_object h; vs_value name, env, data; uint64_t mark; } vs_alias;      /* a renamed identifier */

/* The constant descriptor of a call with keywords: the last `count` arguments belong to these names. */
typedef struct { vs_object h; uint64_t count; vs_value name[]; } vs_keywords;

/* A reference to an object of the host. `type` has the hooks (native.h); release(object) runs when it dies. `with` is
   for the owner's use, NULL at first. The bytes that the object counts towards the collector's budget is in h.flags
   (gc.c). */
typedef struct { vs_object h; const struct vs_foreign_type *type; void *object; const void *with; } vs_foreign;

/* ---- typed access; the caller has tested the type ---- */
#define VS_ACCESSOR(name, TYPE)                                                                                        \
  static inline vs_##name *vs_as_##name(vs_value v) {                                                                  \
    VS_ASSERT(vs_is(v, VS_T_##TYPE));                                                                                  \
    return (vs_##name *)(void *)vs_object_of(v);                                                                       \
  }
VS_ACCESSOR(pair, PAIR) VS_ACCESSOR(string, STRING) VS_ACCESSOR(symbol, SYMBOL) VS_ACCESSOR(vector, VECTOR)
VS_ACCESSOR(bytes, BYTES) VS_ACCESSOR(bignum, BIGNUM) VS_ACCESSOR(ratio, RATIO) VS_ACCESSOR(code, CODE)
VS_ACCESSOR(closure, CLOSURE) VS_ACCESSOR(case, CASE) VS_ACCESSOR(native, NATIVE) VS_ACCESSOR(cell, CELL)
VS_ACCESSOR(box, BOX) VS_ACCESSOR(values, VALUES) VS_ACCESSOR(record_type, RECORD_TYPE) VS_ACCESSOR(record, RECORD)
VS_ACCESSOR(flat, FLAT) VS_ACCESSOR(dual, DUAL) VS_ACCESSOR(table, TABLE) VS_ACCESSOR(port, PORT)
VS_ACCESSOR(promise, PROMISE) VS_ACCESSOR(parameter, PARAMETER) VS_ACCESSOR(condition, CONDITION)
VS_ACCESSOR(stack, STACK) VS_ACCESSOR(continuation, CONTINUATION) VS_ACCESSOR(environment, ENVIRONMENT)
VS_ACCESSOR(macro, MACRO) VS_ACCESSOR(alias, ALIAS) VS_ACCESSOR(keywords, KEYWORDS) VS_ACCESSOR(foreign, FOREIGN)
#undef VS_ACCESSOR

/* how many fields the record has */
static inline size_t vs_record_fields(const vs_record *r) { return r->h.words - sizeof(vs_record) / sizeof(vs_value); }

static inline bool vs_is_pair(vs_value v) { return vs_is(v, VS_T_PAIR); }
static inline bool vs_is_symbol(vs_value v) { return vs_is(v, VS_T_SYMBOL); }
static inline bool vs_is_string(vs_value v) { return vs_is(v, VS_T_STRING); }
static inline bool vs_is_vector(vs_value v) { return vs_is(v, VS_T_VECTOR); }
static inline vs_value vs_car(vs_value v) { return vs_as_pair(v)->car; }
static inline vs_value vs_cdr(vs_value v) { return vs_as_pair(v)->cdr; }
static inline vs_pos vs_pair_pos(vs_value v) {
  return vs_object_of(v)->flags & VS_F_LOCATED ? ((vs_located_pair *)(void *)vs_object_of(v))->pos : 0;
}
static inline bool vs_is_procedure(vs_value v) {
  return vs_is_object(v) && vs_object_of(v)->type >= VS_T_CLOSURE && vs_object_of(v)->type <= VS_T_PARAMETER;
}

#endif
