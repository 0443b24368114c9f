/* Declares flat records: immutable objects with a tag and at most VS_FLAT_FIELDS doubles. The host registers their
 * types and the rules of their arithmetic. */
#ifndef VS_VM_VALUES_FLAT_H
#define VS_VM_VALUES_FLAT_H

#include "vm/machine/vs.h"

enum { VS_FLAT_TAGS = 32, VS_FLAT_FIELDS = 16 };                 /* tag 0 means a number in the rules of arithmetic */
typedef struct vs_flat_type {
  const char *name;        /* noun for messages, such as "a point" */
  const char *noun;
  const char *constructor; /* a record is printed as (constructor f0 f1 ...) with its first `fields` doubles */
  int fields;
  const char *parts[2];    /* if not NULL, the record is printed in two parts: parts[0] is the constructor of the first
                            * three doubles, parts[1] that of the next three, as in (make-axis (xyz ...) (vxyz ...)) */
} vs_flat_type;

typedef enum { VS_RULE_NONE, VS_RULE_ADD, VS_RULE_SUB, VS_RULE_MUL, VS_RULE_DIV, VS_RULE_CALL } vs_flat_rule;
/* The rules of arithmetic apply an operator to each component of a record; a number has the same value for every
 * component. VS_RULE_CALL: vs_flat_rules.call computes the result. */
typedef enum { VS_OP_ADD, VS_OP_SUB, VS_OP_MUL, VS_OP_DIV, VS_OP_COUNT } vs_flat_op;
typedef enum {
  VS_FLAT_PLUS,
  VS_FLAT_MINUS,
  VS_FLAT_FROM /* component of the right operand minus that of the left operand */,
  VS_FLAT_TIMES,
  VS_FLAT_OVER,
  VS_FLAT_DOT,
  VS_FLAT_CROSS,
  VS_FLAT_APART,
  VS_FLAT_LENGTH
} vs_flat_kind;
typedef struct vs_flat_rules {
  int tags;                                                     /* number of registered types of records, plus 1 */
  vs_flat_type type[VS_FLAT_TAGS];
  /* at[operator][left tag][right tag]: the rule, and the tag of the result; -x is computed as 0 - x */
  struct { uint8_t rule, tag; } at[VS_OP_COUNT][VS_FLAT_TAGS][VS_FLAT_TAGS];
  /* Procedures whose calls are compiled to one instruction. A `maker` creates a record of n numbers. A getter returns
   * the double at an index of a record. */
  int makers, getters;
  struct { const char *name; uint8_t tag, n; } maker[64];
  struct { const char *name; uint64_t mask; uint8_t index; } getter[64];
  /* Procedures of two records with three fields, of a record and a number (right tag 0), or of a single record. The
   * result is a record with the tag `result`, or a number if `result` is 0. */
  /* Computes the procedure `name` for n arguments, at least one of which is a record of a type with VS_RULE_CALL. NULL
   * if no type has this rule. */
  bool (*call)(vs_scheme *vm, const char *name, const vs_value *a, int n, vs_value *out);
  int binaries, unaries;
  struct { const char *name; uint8_t kind, left, right, result; } binary[32];
  struct { const char *name; uint8_t kind, tag, result; } unary[16];
} vs_flat_rules;
/* Returns the length of the vector (x y z). Scales the vector if the sum of squares overflows, or loses digits by
 * underflow. */
double vs_flat_length(double x, double y, double z);
/* Returns true if one of the n arguments is a record of a type with VS_RULE_CALL. */
bool vs_flat_callable(const vs_scheme *vm, const vs_value *a, int n);
static inline bool vs_is_flat(vs_value v, uint32_t tag) { return vs_is(v, VS_T_FLAT) && vs_as_flat(v)->h.flags == tag; }

#endif
