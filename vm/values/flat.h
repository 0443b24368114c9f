/* Owns flat records: immutable, up to VS_FLAT_FIELDS doubles and a tag; their types and rules of arithmetic, which the
   host registers. */
#ifndef VS_VM_VALUES_FLAT_H
#define VS_VM_VALUES_FLAT_H

#include "vm/machine/vs.h"

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
/* Is one of the n arguments a record that `call` is for? */
bool vs_flat_callable(const vs_scheme *vm, const vs_value *a, int n);
static inline bool vs_is_flat(vs_value v, uint32_t tag) { return vs_is(v, VS_T_FLAT) && vs_as_flat(v)->h.flags == tag; }

#endif
