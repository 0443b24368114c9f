/* Owns the interface between C builtins and the VM: how a native is described, how it fails, returns, calls and polls.

   A native:
     static vs_status string_ref(vs_scheme *vm, vs_value *a, int n, vs_value *out);
     static const vs_native_def defs[] = {{"string-ref", "string k", string_ref, 0, "the k-th character"}, {0}};
     const vs_native_table vs_string_natives = {"string", defs};
   and one row VS_NATIVES(string) in natives.def (or, for a layer above vm/, an entry in vs_config.tables).

   The signature string is the one statement of what it takes; counts, keywords and the names in messages come from it:
     "k"  required      "[k j]" optional      "#:name" keyword      ". rest" any number more
   `a` holds the arguments on the VM's stack (rooted, updated by the collector, writable). `n` is how many were given.
   If the signature has keywords or slots (below) then optional arguments not given are VS_ABSENT and a[] is laid out as
   required, optional, then the keyword values in the order of the signature (VS_ABSENT where not given), then the
   slots. A native with keywords and ". rest" finds the keywords' values behind the n that were given: a[n], a[n + 1]
   and so on. (One with slots may not have ". rest".) Without them only a[0..n-1] exist; test n.
   A native that may return VS_TAILCALL has slots, or -1 there (which lays nothing out): so it gives up its caller's
   frame.

   It returns
     VS_OK         *out is the value (a native may leave it: #unspecific)
     VS_SEVERAL    *out holds several values, or none: vs_several returns this
     VS_ERROR      = false: vm->condition is set (the functions below do that, as does everything that returns bool)
     VS_TAILCALL   the native is done; the procedure given to vs_call is called in its place
     VS_CALL       the procedure given to vs_call is called; then the native is entered again, with the result in *out
   so `return vs_cons(vm, a[0], a[1], out);` is a complete body.

   Natives never call Scheme otherwise. A native that returns VS_CALL is `slots` > 0: its last `slots` elements of a[]
   are private, #f at first entry; n is -1 when it is entered again; state must be kept there (a phase number as a
   fixnum in the first, say) because a continuation may copy the frame and enter it twice. This is how load, eval, the
   expander with its macro calls, dynamic-wind and call/cc work:
     static vs_status load_(vs_scheme *vm, vs_value *a, int n, vs_value *out)  {  // "file", slots 2
       if (a[1] == VS_FALSE) open: make the reader/unit, vs_gc_store not needed: a[1] = unit (foreign object);
       else the last form's value is *out;
       read and expand one form; if a macro must run: return vs_call(vm, transformer, 3, argv)  (VS_CALL); the next
       entry has its value if a form is ready: vs_compile(vm, ast, node, &a[2]) && return vs_call(vm, a[2], 0, NULL);
       at the end: *out = last value; return VS_OK; }
   An error inside what was called does not enter the native again: it unwinds. Memory that must be freed hangs off a
   foreign object or is restored by dynamic-wind. */
#ifndef VS_NATIVE_H
#define VS_NATIVE_H

#include "vm/values/gc.h"

typedef int vs_status;
enum {
  VS_ERROR = 0,
  VS_OK = 1,
  VS_TAILCALL = 2,
  VS_CALL = 3,
  VS_THROW = 4,
  VS_UNCAUGHT = 5 /* these two are control.c's */,
  VS_SEVERAL = 6
};

typedef vs_status vs_native_fn(vs_scheme *vm, vs_value *a, int n, vs_value *out);

typedef struct vs_native_def {
  const char *name;          /* or several: "call/cc call-with-current-continuation": a procedure for each, whose errors
                                say its name */
  const char *signature;
  vs_native_fn *fn;
  int slots;
  const char *doc;           /* one line for help, or NULL */
} vs_native_def;

typedef struct vs_native_table {
  const char *name;
  const vs_native_def *defs; /* ends with a NULL name */
} vs_native_table;

/* Makes the procedures of a table and hands each to define(vm, context, symbol, procedure): the environment's
   business. */
bool vs_native_define(vs_scheme *vm, const vs_native_table *table,
                      bool (*define)(vs_scheme *vm, void *context, vs_value symbol, vs_value procedure), void *context);

/* Of the words nth(0), nth(1) ... to the first NULL, the one that is most like the wanted one, as in advice for names
   that are not defined; NULL: none is. */
const char *vs_nearest_word(const char *wanted, const char *(*nth)(size_t i));

/* ---- calling (see above). argv are copied. ---- */
vs_status vs_call(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv);       /* returns VS_CALL */
vs_status vs_tailcall(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv);   /* returns VS_TAILCALL */
/* for long argument lists: begin, push ..., then return VS_CALL or VS_TAILCALL */
void vs_call_begin(vs_scheme *vm, vs_value procedure);
bool vs_call_push(vs_scheme *vm, vs_value v);
/* Returns n values; `at` in roots or arguments. The run loop holds whoever is returned to, to taking as many. */
static inline vs_status vs_several(vs_scheme *vm, const vs_value *at, size_t n, vs_value *out) {
  return !vs_make_values(vm, at, n, out) ? VS_ERROR : n == 1 ? VS_OK : VS_SEVERAL;
}

/* ---- failing: all return VS_ERROR (false) ---- */
/* "NAME: PARAM must be EXPECTED, got VALUE"; PARAM from the signature by the argument's index in a[], NAME the running
   native */
vs_status vs_fail_type(vs_scheme *vm, int arg, const char *expected, vs_value got);
/* "NAME: PARAM is out of range: VALUE, must be from LOW to HIGH" (HIGH inclusive) */
vs_status vs_fail_range(vs_scheme *vm, int arg, vs_value got, int64_t low, int64_t high);
/* "NAME: " (if a native runs) + printf text; kind is vm->sym.error and the like. Formats: everything printf has. */
vs_status vs_fail(vs_scheme *vm, vs_value kind, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* the same with irritants, shown written after the text: a list */
vs_status vs_fail_with(vs_scheme *vm, vs_value kind, vs_value irritants, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* the same with a place of its own (reader, expander); no NAME prefix, no call chain */
vs_status vs_fail_at(vs_scheme *vm, vs_value kind, vs_pos place, vs_value irritants, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
vs_status vs_fail_memory(vs_scheme *vm);
/* raise any object, as (raise object) does */
vs_status vs_fail_object(vs_scheme *vm, vs_value object);

/* ---- checked arguments: false and a type error, or the value ---- */
/* fixnum or double; bignum and ratio via vm/values/number.h's vs_number_double */
bool vs_arg_double(vs_scheme *vm, const vs_value *a, int arg, double *out);
/* exact integer in [low, high] */
bool vs_arg_index(vs_scheme *vm, const vs_value *a, int arg, int64_t low, int64_t high, int64_t *out);
/* a VS_T_ type; the noun from object.def */
bool vs_arg_type(vs_scheme *vm, const vs_value *a, int arg, int type);

/* ---- lists ---- */
/* Length of a proper list, -1 if improper or circular. */
int64_t vs_list_length(vs_value list);
/* The numbers of a proper list into a fresh vs_mem array (count * 8 bytes, the caller frees), false and a type error
   for arg. */
bool vs_list_doubles(vs_scheme *vm, vs_value list, int arg, double **out, size_t *count);

/* ---- limits: call it in builtins that can be long, with the work done since last time (1 = a cheap inner step)
   ---- */
bool vs_poll(vs_scheme *vm, uint64_t work);
/* the same at turn i of a loop whose turns are worth `cost` cheap steps (a step: some 5 ns) */
static inline bool vs_poll_turn(vs_scheme *vm, uint64_t i, unsigned cost) {
  return (i & 1023) != 1023 || vs_poll(vm, 1024 * (uint64_t)cost);
}
/* memmove and memset in pieces, polling between them. A block larger than a piece is an object that does not move, or
   no object. */
bool vs_poll_move(vs_scheme *vm, void *to, const void *from, size_t bytes);
bool vs_poll_set(vs_scheme *vm, void *to, int byte, size_t bytes);

/* ---- foreign objects ---- */
typedef struct vs_foreign_type {
  const char *name;                                             /* "an object": for messages */
  void (*release)(void *object);                                /* one reference; must not call back; may not recurse
                                                                   deeply */
  bool (*equal)(const void *a, const void *b);                  /* equal?, or NULL: identity */
  uint64_t (*hash)(const void *object);                         /* agrees with equal, or NULL */
  /* text for the printer, UTF-8, appended through put; NULL prints #<name> */
  bool (*print)(vs_scheme *vm, const void *object, bool (*put)(void *to, const char *s, size_t n), void *to);
  void (*trace)(vs_scheme *vm, void *object, void (*mark)(vs_scheme *vm, vs_value *slot));   /* Scheme values inside, or
                                                                                  NULL. If not NULL the object is
                                                                                  treated as always just written to */
  bool callable_image;                                          /* reserved, false: foreign objects are not in the heap
                                                                   image */
} vs_foreign_type;

/* the host pointer if v is a foreign object of this type, else NULL */
static inline void *vs_foreign_get(vs_value v, const vs_foreign_type *type) {
  return vs_is(v, VS_T_FOREIGN) && vs_as_foreign(v)->type == type ? vs_as_foreign(v)->object : NULL;
}

/* ---- flat records: immutable, up to VS_FLAT_FIELDS doubles and a tag ---- */
enum { VS_FLAT_TAGS = 32, VS_FLAT_FIELDS = 16 };                 /* tag 0 is "a number" in the rules below */
typedef struct vs_flat_type {
  const char *name;        /* "point", for messages: "a point" is noun */
  const char *noun;
  const char *constructor; /* printed as (constructor f0 f1 ...) of the first `fields` doubles */
  int fields;
  const char *parts[2];    /* if set, each names the constructor of the next three doubles: (make-axis (xyz ...) (vxyz
                              ...)) */
} vs_flat_type;

typedef enum { VS_RULE_NONE, VS_RULE_ADD, VS_RULE_SUB, VS_RULE_MUL, VS_RULE_DIV, VS_RULE_CALL } vs_flat_rule;
/* componentwise, a number repeated; CALL: by vs_flat_rules.call */
typedef enum { VS_OP_ADD, VS_OP_SUB, VS_OP_MUL, VS_OP_DIV, VS_OP_COUNT } vs_flat_op;
typedef enum {
  VS_FLAT_PLUS,
  VS_FLAT_MINUS,
  VS_FLAT_FROM /* right - left */,
  VS_FLAT_TIMES,
  VS_FLAT_OVER,
  VS_FLAT_DOT,
  VS_FLAT_CROSS,
  VS_FLAT_APART,
  VS_FLAT_LENGTH
} vs_flat_kind;
typedef struct vs_flat_rules {
  int tags;                                                     /* 1 + number of types */
  vs_flat_type type[VS_FLAT_TAGS];
  /* [operator][left tag][right tag]; unary minus is 0 - x */
  struct { uint8_t rule, tag; } at[VS_OP_COUNT][VS_FLAT_TAGS][VS_FLAT_TAGS];
  /* Procedures that run as one opcode. `maker`: n numbers become a record; `field`: record -> double at index, for the
     tags in mask. The native of that name stays as the general case and the one that fails. */
  int makers, getters;
  struct { const char *name; uint8_t tag, n; } maker[64];
  struct { const char *name; uint64_t mask; uint8_t index; } getter[64];
  /* Procedures of two records of three fields, or of one and a number (right tag 0), and of one record: what comes of
     them is a record with the tag `result`, or a number where that is 0. */
  /* Computes the result of the procedure of this name, of arithmetic or of one number, for n arguments of which one is
     a record of a type with VS_RULE_CALL; NULL: no type has. Tests give #t or #f. */
  bool (*call)(vs_scheme *vm, const char *name, const vs_value *a, int n, vs_value *out);
  int binaries, unaries;
  struct { const char *name; uint8_t kind, left, right, result; } binary[32];
  struct { const char *name; uint8_t kind, tag, result; } unary[16];
} vs_flat_rules;
/* Returns the length of (x y z): the root of the sum of squares where that neither overflows nor loses digits to
   underflow, else scaled. */
double vs_flat_length(double x, double y, double z);
/* The host fills one and gives it before natives are defined; the VM keeps a copy. */
bool vs_flat_register(vs_scheme *vm, const vs_flat_rules *rules);
/* a+b etc. if one of them is a flat record: true and *out, or false with the error naming both kinds. For
   vm/values/number.c. */
bool vs_flat_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out);
/* Is one of the n arguments a record that `call` is for? */
bool vs_flat_callable(const vs_scheme *vm, const vs_value *a, int n);
static inline bool vs_is_flat(vs_value v, uint32_t tag) { return vs_is(v, VS_T_FLAT) && vs_as_flat(v)->h.flags == tag; }

/* what v is, with article, for messages: "a string", "a point", "a number" */
const char *vs_noun(vs_scheme *vm, vs_value v);

#endif
