/* Owns flat records: a tag and at most VS_FLAT_FIELDS doubles, immutable; and their types and rules of arithmetic,
 * which the host registers. */
#ifndef VS_VM_VALUES_FLAT_H
#define VS_VM_VALUES_FLAT_H

#include "vm/machine/vs.h"

enum { VS_FLAT_TAGS = 32, VS_FLAT_FIELDS = 16 };                 /* tag 0 means a number in the rules below */
typedef struct vs_flat_type {
  const char *name;        /* the noun of messages, as in "a point" */
  const char *noun;
  const char *constructor; /* the printed form is (constructor f0 f1 ...) with the first `fields` doubles */
  int fields;
  const char *parts[2];    /* each, if set, is the constructor of the next three doubles: (make-axis (xyz ...) (vxyz
                            * ...)) */
} vs_flat_type;

typedef enum { VS_RULE_NONE, VS_RULE_ADD, VS_RULE_SUB, VS_RULE_MUL, VS_RULE_DIV, VS_RULE_CALL } vs_flat_rule;
/* componentwise, a number counts for every component; CALL: vs_flat_rules.call computes it */
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
  int tags;                                                     /* 1 + the number of types */
  vs_flat_type type[VS_FLAT_TAGS];
  /* [operator][left tag][right tag]; unary minus is 0 - x */
  struct { uint8_t rule, tag; } at[VS_OP_COUNT][VS_FLAT_TAGS][VS_FLAT_TAGS];
  /* Procedures that run as one opcode. A `maker` makes a record of n numbers; a `field` returns the double at an index
   * of a record whose tag is in the mask. The native of the same name handles the general case and reports errors. */
  int makers, getters;
  struct { const char *name; uint8_t tag, n; } maker[64];
  struct { const char *name; uint64_t mask; uint8_t index; } getter[64];
  /* Procedures of two records of three fields, of a record and a number (right tag 0), or of one record. Each returns a
   * record with the tag `result`; a number if `result` is 0. */
  /* Computes the procedure of this name for n arguments, at least one a record of a type with VS_RULE_CALL. The
   * procedures are those of arithmetic or of one number; tests return #t or #f. NULL: no type has that rule. */
  bool (*call)(vs_scheme *vm, const char *name, const vs_value *a, int n, vs_value *out);
  int binaries, unaries;
  struct { const char *name; uint8_t kind, left, right, result; } binary[32];
  struct { const char *name; uint8_t kind, tag, result; } unary[16];
} vs_flat_rules;
/* Returns the length of (x y z). Scales the vector if the sum of squares overflows or loses digits to underflow. */
double vs_flat_length(double x, double y, double z);
/* Returns true if one of the n arguments is a record that `call` handles. */
bool vs_flat_callable(const vs_scheme *vm, const vs_value *a, int n);
static inline bool vs_is_flat(vs_value v, uint32_t tag) { return vs_is(v, VS_T_FLAT) && vs_as_flat(v)->h.flags == tag; }

#endif
