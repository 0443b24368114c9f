/* Declares a reader of .sx files (the workloads and fuzz cases of the CSG suite), which makes kernel problems for tests
 * and benchmarks. */
#ifndef VS_TESTS_SX_H
#define VS_TESTS_SX_H

#include "kernel/evaluate.h"

typedef struct {
  vs_kernel_problem problem; /* the problem; it contains pointers into the arrays below */
  vs_kernel_leaf *leaves;
  vs_kernel_term *terms;
  uint32_t *operands;
  vs_mesh **meshes;          /* distinct meshes, owned */
  size_t leaf_room, term_room, operand_room, mesh_count, mesh_room;
} sx_problem;

bool sx_parse(const char *text, sx_problem *out); /* returns false after printing the reason to stderr */
void sx_free(sx_problem *p);
bool sx_write_stl(const vs_mesh *m, const char *path);

#endif
