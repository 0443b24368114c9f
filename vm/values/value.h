/* Declares the representation of Scheme values: the NaN-boxed word, the heap objects, and functions on them.
 *
 * A vs_value has 64 bits.
 *   below 0xFFF9 << 48   an IEEE double, unboxed (the NaN that x86 makes, 0xFFF8 << 48, is among them)
 *   0xFFF9 | 48 bits     a fixnum, two's complement
 *   0xFFFA | 48 bits     an immediate: #t, #f, (), a character, markers
 *   0xFFFB | 48 bits     the address of a heap object
 * Doubles from outside pass vs_flonum(), which turns every NaN into the canonical NaN. Arithmetic on canonical values
 * remains canonical.
 *
 * Every heap object begins with vs_object. `words` is the size of the whole object in 8-byte words, with the header, so
 * that the collector can walk the heap. Objects move once, out of the nursery. Therefore C code that allocates, or
 * calls a function that allocates, must hold values in roots of the garbage collector (gc.h), not in plain locals; raw
 * pointers to objects are invalid after an allocation. Only vs_gc_store (gc.h) writes fields of type vs_value, except
 * in an object just allocated. */
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

/* ---- immediate values: a kind in bits 32..47, a payload in bits 0..31 ---- */
#define VS_IMMEDIATE(kind, n) ((VS_TAG_IMMEDIATE << 48) | ((uint64_t)(kind) << 32) | (uint64_t)(n))
#define VS_FALSE       VS_IMMEDIATE(0, 0)
#define VS_TRUE        VS_IMMEDIATE(0, 1)
#define VS_NIL         VS_IMMEDIATE(1, 0)
#define VS_UNSPECIFIC  VS_IMMEDIATE(2, 0)   /* value of (if #f #f) and set!; the prompt does not print it */
#define VS_EOF         VS_IMMEDIATE(3, 0)
#define VS_ABSENT      VS_IMMEDIATE(4, 0)   /* an optional or keyword argument that was not given; never visible to
                                             * programs */
#define VS_UNDEFINED   VS_IMMEDIATE(5, 0)   /* marks a variable that has no value yet (in letrec, or an undefined global
                                             * variable) */
#define VS_VACANT      VS_IMMEDIATE(6, 0)   /* in hash tables: key of a free slot or a removed entry */
#define VS_CHAR(c)     VS_IMMEDIATE(7, (uint32_t)(c))

static inline vs_value vs_bool(bool b) { return b ? VS_TRUE : VS_FALSE; }
static inline bool vs_is_true(vs_value v) { return v != VS_FALSE; }
static inline bool vs_is_char(vs_value v) { return (v >> 32) == (VS_CHAR(0) >> 32); }
/* Returns the code point of a character. */
static inline uint32_t vs_char(vs_value v) {
  VS_ASSERT(vs_is_char(v));
  return (uint32_t)v;
}

static inline bool vs_is_double(vs_value v) { return v < (VS_TAG_FIXNUM << 48); }
/* Returns the double that v represents. */
static inline double vs_double(vs_value v) {
  double d;
  VS_ASSERT(vs_is_double(v));
  memcpy(&d, &v, sizeof d);
  return d;
}
/* Returns the value that represents d, where d is no NaN or is the canonical NaN. The interpreter's own arithmetic
 * returns only such doubles. */
static inline vs_value vs_flonum_raw(double d) { vs_value v; memcpy(&v, &d, sizeof v); return v; }
/* Returns the value that represents any double d; every NaN becomes the canonical NaN. */
static inline vs_value vs_flonum(double d) { return d == d ? vs_flonum_raw(d) : UINT64_C(0x7FF8000000000000); }

static inline bool vs_is_fixnum(vs_value v) { return (v >> 48) == VS_TAG_FIXNUM; }
/* Returns the integer that the fixnum v represents. */
static inline int64_t vs_fixnum(vs_value v) {
  VS_ASSERT(vs_is_fixnum(v));
  return (int64_t)(v << 16) >> 16;
}
/* Returns the fixnum that represents n, which must fit 48 bits; n may also be a source position or hash of 48 bits. */
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
  _Alignas(8) uint8_t type; /* the type, VS_T_... */
  uint8_t gc;       /* flags of the garbage collector (gc.c) */
  uint16_t flags;   /* flags VS_F_..., some of which are specific to a type */
  uint32_t words;   /* size of the object with its header, in words of 8 bytes */
} vs_object;

enum {                          /* values of vs_object.flags */
  VS_F_IMMUTABLE  = 1,          /* a literal of a program (string, vector, bytes, pair), which the program must not
                                 * change */
  VS_F_LOCATED    = 2,          /* pair: it has a fourth word, its place in the source (vs_pos) */
  VS_F_SQUARE     = 4,          /* pair: it was written with [ ]; for messages and for printing sources */
  VS_F_WIDE       = 4,          /* string: each character has 4 bytes; without the flag 1 byte (Latin-1) */
  VS_F_CONSTANT   = 4,          /* cell of a global variable: the variable is imported or registered, and never
                                 * assigned, so that the compiler may replace its calls by instructions */
  VS_F_UNINTERNED = 4,          /* symbol: created by generate-uninterned-symbol */
  VS_F_LOCAL      = 8,          /* symbol, alias: a local scope has bound it */
  VS_F_ASSIGNED   = 8,          /* cell of a global variable: assigned by a set! in its own library or program, so that
                                 * importers share the cell */
  VS_F_AROUND     = 4,          /* environment: it is a scope that contains other scopes */
  VS_F_NEGATIVE   = 4,          /* bignum: it is negative */
  VS_F_MARKED     = 4           /* closure: marked by the layers above vm/ as a rule or operator */
};

static inline bool vs_is_object(vs_value v) { return (v >> 48) == VS_TAG_POINTER; }
/* Returns the heap object of v. */
static inline vs_object *vs_object_of(vs_value v) {
  VS_ASSERT(vs_is_object(v));
  return (vs_object *)(uintptr_t)(v & VS_PAYLOAD);
}
/* Returns the value that refers to an object. */
static inline vs_value vs_from_object(const void *o) {
  VS_ASSERT(((uint64_t)(uintptr_t)o & ~VS_PAYLOAD) == 0);
  return (VS_TAG_POINTER << 48) | (uint64_t)(uintptr_t)o;
}
static inline bool vs_is(vs_value v, int type) { return vs_is_object(v) && vs_object_of(v)->type == type; }

/* A position in a source file, in 48 bits, so that it fits a fixnum: file number 12 bits, line 22 bits, column 14 bits.
 * Lines and columns are counted from 1; 0 means unknown. */
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
typedef struct { vs_pair pair; vs_pos pos; } vs_located_pair;   /* a pair with the flag VS_F_LOCATED */

/* A string. `store` is a BYTES object with the characters, 1 or 4 bytes each (VS_F_WIDE): string-ref takes constant
 * time, and string-set! may convert the store. Characters are code points, never surrogates. */
typedef struct { vs_object h; uint32_t length, hash; vs_value store; } vs_string;

/* A symbol: a UTF-8 name, followed by a NUL. Interned symbols are unique (vs_intern in gc.h), and are compared by
 * ==. */
typedef struct { vs_object h; uint32_t hash, length; char name[]; } vs_symbol;

typedef struct { vs_object h; uint64_t length; vs_value at[]; } vs_vector;
typedef struct { vs_object h; uint64_t length; uint8_t at[]; } vs_bytes;

/* An integer that fits no fixnum: its magnitude in GMP limbs, the least first, the last not 0. The sign is
 * VS_F_NEGATIVE. */
typedef struct { vs_object h; uint64_t count; uint64_t limb[]; } vs_bignum;
typedef struct { vs_object h; vs_value num, den; } vs_ratio;     /* a ratio in lowest terms, with den > 1 */

/* The code of a procedure. It is in the old space and never moves, so that the run loop may keep addresses inside
 * it. */
typedef struct {
  vs_object h;
  vs_value name;        /* name of the procedure, a symbol or #f */
  vs_value consts;      /* vector in the old space with the code's constants: cells, literals, nested code, keyword
                         * lists */
  vs_value ins;         /* BYTES of 32-bit instructions, in the old space */
  vs_value places;      /* places of the instructions (code.h): BYTES, or one place as a fixnum */
  vs_value inlined;     /* BYTES of pairs {u32 pc, u32 constant}, sorted by pc: the instruction at pc replaces a call of
                         * a procedure, whose cell has the index `constant` in `consts` */
  vs_value params;      /* vector of the parameters' names for messages, as symbols: required, optional, keyword and
                         * rest parameters */
  vs_value doc;         /* documentation that the program attached, or #f */
  uint32_t required, optional, keywords, registers;
  uint32_t flags;       /* flags VS_CODE_... */
  uint32_t free;        /* number of variables that a closure captures */
} vs_code;
enum {
  VS_CODE_REST = 1,
  VS_CODE_SIMPLE = 2,           /* the procedure has only required parameters and no other flag */
  VS_CODE_GET = 4,              /* the procedure returns or sets a record's field; created by define-record-type */
  VS_CODE_SET = 8,
  VS_CODE_TEST = 16,            /* the procedure tests the type of a record; created by define-record-type */
  VS_CODE_MAKE = 32,            /* the procedure creates a record; created by define-record-type. Procedures with the
                                 * flags GET, TEST or MAKE run without an activation (record_call.h) */
  VS_CODE_RECORD = VS_CODE_GET | VS_CODE_SET | VS_CODE_TEST | VS_CODE_MAKE
};

typedef struct { vs_object h; vs_value code; vs_value free[]; } vs_closure;
/* A case-lambda: closures, tried in order. The last word, after the clauses, is a note: data of the layers above
 * vm/. */
typedef struct { vs_object h; uint64_t count; vs_value clause[]; } vs_case;
static inline vs_value vs_case_note(const vs_case *c) {
  return c->h.words > 2 + c->count ? c->clause[c->count] : VS_FALSE;
}
/* A procedure in C. `max`: greatest number of arguments, UINT32_MAX if it has a rest parameter. `keywords` is a vector
 * of symbols, or #f. `inlined`: row of inline.def, or 0; `inlined_arg`: argument of this row. */
typedef struct {
  vs_object h;
  const struct vs_native_def *def;
  uint32_t min, max;
  vs_value name, keywords;
  uint32_t inlined, inlined_arg;
} vs_native;

/* A global variable. `users` is a list of code objects, in which instructions have replaced calls of the variable's
 * value; a redefinition restores these calls. */
typedef struct { vs_object h; vs_value value, name, users; } vs_cell;
typedef struct { vs_object h; vs_value value; } vs_box;
typedef struct { vs_object h; uint64_t count; vs_value at[]; } vs_values;      /* several values of one expression;
                                                                                * count is never 1 */

/* A record type. fields: vector of the fields' names, as symbols. */
typedef struct { vs_object h; vs_value name, fields, parent, data; } vs_record_type;
typedef struct { vs_object h; vs_value type; vs_value at[]; } vs_record;

/* An immutable record of at most 16 doubles (flat.h). h.flags is its tag. */
typedef struct { vs_object h; double at[]; } vs_flat;
static inline uint32_t vs_flat_tag(const vs_flat *f) { return f->h.flags; }
static inline uint32_t vs_flat_count(const vs_flat *f) { return f->h.words - 1; }

/* A dual number: a value and its derivative (dual.h). */
typedef struct { vs_object h; vs_value level /* level: a fixnum */, value, slope; } vs_dual;

/* A hash table in insertion order. `entries` is a vector of triples: key, value, hash (a fixnum); the key of a removed
 * entry is VS_VACANT. `index` is BYTES of u32: entry number + 1, or 0 for a free slot. */
typedef struct {
  vs_object h;
  vs_value entries, index;
  uint32_t count, used;          /* count: number of entries; used: number of entries in `entries`, including removed
                                  * ones */
  uint32_t kind, young;          /* kind: VS_TABLE_... */
  uint64_t epoch;
} vs_table;
enum { VS_TABLE_EQ, VS_TABLE_EQV, VS_TABLE_EQUAL, VS_TABLE_STRING };

/* A port (vm/library/port.c). `buffer` is BYTES or #f, `name` a string or #f. `host` is the number of a stream of the
 * host, or -1. */
typedef struct {
  vs_object h;
  vs_value buffer, name, data;
  int64_t host;
  uint64_t position, limit;
  uint32_t line, col, flags, peeked;
} vs_port;

/* A promise. done: #t, #f or VS_ABSENT. value: for #t the result, for #f a thunk that returns a promise, for VS_ABSENT
 * another promise with the same result. */
typedef struct { vs_object h; vs_value done, value; } vs_promise;
typedef struct { vs_object h; vs_value value, converter, name; } vs_parameter;

/* An error of the system or of (error ...). It is printed as its message and irritants. `chain` is a list of
 * (procedure name . place as a fixnum), innermost first. `place` is the place of the failing call. */
typedef struct { vs_object h; vs_value kind, message, irritants /* irritants: a list */, chain, payload,
    calls /* calls: the running calls with their variables (activation.c), or #f */; vs_pos place; } vs_condition;

/* Captured activations, immutable. `at` is a copy of a part of the stack; `under` is the STACK object with the part
 * below it, up to its slot `depth`. */
typedef struct { vs_object h; vs_value under; uint64_t depth, count,
    total /* total: number of slots, including those of all STACK objects below */; vs_value at[]; } vs_stack;
/* A continuation. `ret` is the return information of the activation to which it returns (activation.h). */
typedef struct {
  vs_object h;
  vs_value stack;
  uint64_t depth;
  vs_value winders, handlers, parameters, ret;
} vs_continuation;

/* Objects of the expander. vm/front defines the meaning of their fields; the garbage collector visits all fields. */
typedef struct { vs_object h; vs_value name, table, imports, exports, parent, top, data; } vs_environment;
typedef struct { vs_object h; vs_value kind, transformer, env, data; } vs_macro;
typedef struct { vs_object h; vs_value name, env, data; uint64_t mark; } vs_alias;      /* an alias: a renamed
                                                                                         * identifier */

/* A constant that describes a call with keywords. name[]: the names of the call's last `count` arguments. */
typedef struct { vs_object h; uint64_t count; vs_value name[]; } vs_keywords;

/* A reference to an object of the host. `type` has the functions for the object (native.h); its release(object) is
 * called when the reference dies. `with` is for the host, and NULL at first. */
typedef struct { vs_object h; const struct vs_foreign_type *type; void *object; const void *with; } vs_foreign;

/* ---- access to objects; the caller must have tested the type ---- */
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

/* Returns the number of the record's fields. */
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
