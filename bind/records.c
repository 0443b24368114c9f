/* Defines the flat record types of the language (points, gvectors, axes, planes, matrices, intervals), with their
 * printing and arithmetic. */
#include "bind/records.h"

#include "bind/functions/function_values.h"

static const vs_flat_type types[] = {
  [VS_FLAT_POINT] = { "point", "a point", "xyz", 3, { NULL, NULL } },
  [VS_FLAT_VECTOR] = { "gvector", "a gvector", "vxyz", 3, { NULL, NULL } },
  [VS_FLAT_AXIS] = { "axis", "an axis", "make-axis", 6, { "xyz", "vxyz" } },
  [VS_FLAT_PLANE] = { "plane", "a plane", "make-plane", 6, { "xyz", "vxyz" } },
  [VS_FLAT_MATRIX] = { "matrix", "a matrix", "make-matrix", 16, { NULL, NULL } },
  [VS_FLAT_INTERVAL] = { "interval", "an interval", "interval", 2, { NULL, NULL } },
};

enum { NUMBER = 0, P = VS_FLAT_POINT, V = VS_FLAT_VECTOR };

/* The pairs of operand types that + - * / accept in addition to numbers. For any other pair, the error names both
 * types. */
static const struct { uint8_t op, left, right, rule, result;
} arithmetic[] = {
  { VS_OP_ADD, P, V, VS_RULE_ADD, P },      { VS_OP_ADD, V, P, VS_RULE_ADD, P },
  { VS_OP_ADD, V, V, VS_RULE_ADD, V },      { VS_OP_SUB, P, V, VS_RULE_SUB, P },
  { VS_OP_SUB, P, P, VS_RULE_SUB, V },      { VS_OP_SUB, V, V, VS_RULE_SUB, V },
  { VS_OP_SUB, NUMBER, V, VS_RULE_SUB, V }, /* (- v), which is computed as 0 - v */
  { VS_OP_MUL, NUMBER, V, VS_RULE_MUL, V }, { VS_OP_MUL, V, NUMBER, VS_RULE_MUL, V },
  { VS_OP_DIV, V, NUMBER, VS_RULE_DIV, V },
};

/* procedures whose calls are compiled to a single instruction */
static const struct { const char *name; uint8_t kind, left, right, result; } binary[] = {
  { "v+v", VS_FLAT_PLUS, V, V, V },
  { "v-v", VS_FLAT_MINUS, V, V, V },
  { "p+v", VS_FLAT_PLUS, P, V, P },
  { "p-v", VS_FLAT_MINUS, P, V, P },
  { "p-p", VS_FLAT_MINUS, P, P, V },
  { "p->q", VS_FLAT_FROM, P, P, V },
  { "v*r", VS_FLAT_TIMES, V, NUMBER, V },
  { "v/r", VS_FLAT_OVER, V, NUMBER, V },
  { "dot", VS_FLAT_DOT, V, V, NUMBER },
  { "cross", VS_FLAT_CROSS, V, V, V },
  { "distance", VS_FLAT_APART, P, P, NUMBER },
};

void vs_bind_flat_rules(vs_flat_rules *r) {
  *r = (vs_flat_rules){ .tags = VS_FLAT_INTERVAL + 1, .call = vs_interval_call };
  for (int t = VS_FLAT_POINT; t <= VS_FLAT_INTERVAL; t++) r->type[t] = types[t];
  for (size_t i = 0; i < sizeof arithmetic / sizeof *arithmetic; i++) {
    r->at[arithmetic[i].op][arithmetic[i].left][arithmetic[i].right].rule = arithmetic[i].rule;
    r->at[arithmetic[i].op][arithmetic[i].left][arithmetic[i].right].tag = arithmetic[i].result;
  }
  for (int op = 0; op < VS_OP_COUNT; op++)
    for (int k = 1; k < 4; k++) /* defines + - * / of an interval with an interval or a number */
      r->at[op][k & 1 ? VS_FLAT_INTERVAL : NUMBER][k & 2 ? VS_FLAT_INTERVAL : NUMBER].rule = VS_RULE_CALL;
  r->maker[r->makers].name = "xyz", r->maker[r->makers].tag = P, r->maker[r->makers++].n = 3;
  r->maker[r->makers].name = "vxyz", r->maker[r->makers].tag = V, r->maker[r->makers++].n = 3;
  static const char *const coordinate[] = { "cx", "cy", "cz" };
  for (uint8_t i = 0; i < 3; i++) {
    r->getter[r->getters].name = coordinate[i];
    r->getter[r->getters].mask = UINT64_C(1) << P | UINT64_C(1) << V;
    r->getter[r->getters++].index = i;
  }
  for (size_t i = 0; i < sizeof binary / sizeof *binary; i++, r->binaries++) {
    r->binary[i].name = binary[i].name, r->binary[i].kind = binary[i].kind;
    r->binary[i].left = binary[i].left, r->binary[i].right = binary[i].right, r->binary[i].result = binary[i].result;
  }
  r->unary[r->unaries].name = "vlength", r->unary[r->unaries].kind = VS_FLAT_LENGTH, r->unary[r->unaries++].tag = V;
}
