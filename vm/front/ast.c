/* Allocates core trees and their pools of constants. */
#include "vm/front/ast.h"

#include "vm/machine/native.h"

struct vs_ast_chunk { struct vs_ast_chunk *next; size_t bytes; };
enum { CHUNK = 16 << 10 };

bool vs_ast_open(vs_scheme *vm, vs_ast *ast) {
  memset(ast, 0, sizeof *ast);
  ast->vm = vm;
  ast->next = vm->asts;
  vm->asts = ast;
  return true;
}

static void free_chunks(vs_ast *ast, struct vs_ast_chunk *keep) {
  while (ast->chunks != keep) {
    struct vs_ast_chunk *c = ast->chunks;
    ast->chunks = c->next;
    vs_mem(ast->vm, c, c->bytes, 0);
  }
}

void vs_ast_close(vs_ast *ast) {
  if (!ast->vm) return;
  free_chunks(ast, NULL);
  if (ast->pool) vs_mem(ast->vm, ast->pool, ast->pool_room * sizeof *ast->pool, 0);
  for (vs_ast **link = &ast->vm->asts; *link; link = &(*link)->next)
    if (*link == ast) { *link = ast->next; break; }
  memset(ast, 0, sizeof *ast);
}

void vs_ast_clear(vs_ast *ast) {
  struct vs_ast_chunk *last = ast->chunks;
  while (last && last->next) last = last->next;
  if (last && last->bytes != CHUNK) last = NULL;
  free_chunks(ast, last);
  ast->pool_count = ast->pool_old = 0;
  ast->left = last ? CHUNK - sizeof *last : 0;
  ast->bump = last ? (char *)(last + 1) : NULL;
}

void *vs_ast_alloc(vs_ast *ast, size_t bytes) {
  bytes = (bytes + 7) & ~(size_t)7;
  if (bytes > ast->left) {
    size_t size = sizeof(struct vs_ast_chunk) + bytes > CHUNK ? sizeof(struct vs_ast_chunk) + bytes : CHUNK;
    struct vs_ast_chunk *c = vs_mem(ast->vm, NULL, 0, size);
    if (!c) return NULL;
    c->next = ast->chunks; c->bytes = size;
    ast->chunks = c;
    ast->bump = (char *)(c + 1);
    ast->left = size - sizeof *c;
  }
  void *p = ast->bump;
  ast->bump += bytes; ast->left -= bytes;
  return memset(p, 0, bytes);
}

bool vs_ast_const(vs_ast *ast, vs_value v, uint32_t *index) {
  /* Searches only the latest 16 constants, since equal constants are mostly close together. The compiler later merges
   * all equal constants of a procedure. */
  size_t from = ast->pool_count > 16 ? ast->pool_count - 16 : 0;
  for (size_t i = ast->pool_count; i-- > from;)
    if (ast->pool[i] == v) { *index = (uint32_t)i; return true; }
  if (ast->pool_count == ast->pool_room) {
    size_t room = ast->pool_room ? ast->pool_room * 2 : 64;
    vs_value *p = vs_mem(ast->vm, ast->pool, ast->pool_room * sizeof *p, room * sizeof *p);
    if (!p) return false;
    ast->pool = p; ast->pool_room = room;
  }
  ast->pool[ast->pool_count] = v;
  *index = (uint32_t)ast->pool_count++;
  return true;
}

vs_var *vs_ast_var(vs_ast *ast, vs_value symbol) {
  vs_var *v = vs_ast_alloc(ast, sizeof *v);
  return v && vs_ast_const(ast, symbol, &v->name) ? v : NULL;
}

vs_core_node *vs_ast_node(vs_ast *ast, int kind, vs_pos pos) {
  vs_core_node *n = vs_ast_alloc(ast, sizeof *n);
  VS_ASSERT(kind >= 0 && kind < VS_AST_COUNT);
  if (n) { n->kind = (uint8_t)kind; n->pos = pos; }
  return n;
}

vs_core_node *vs_ast_constant(vs_ast *ast, vs_value v, vs_pos pos) {
  vs_core_node *n = vs_ast_node(ast, VS_AST_CONST, pos);
  return n && vs_ast_const(ast, v, &n->as.constant) ? n : NULL;
}

vs_core_node *vs_ast_local(vs_ast *ast, vs_var *var, vs_pos pos) {
  vs_core_node *n = vs_ast_node(ast, VS_AST_LOCAL, pos);
  if (n) n->as.var = var;
  return n;
}

vs_core_node *vs_ast_list(vs_ast *ast, int kind, size_t count, vs_pos pos) {
  vs_core_node *n = vs_ast_node(ast, kind, pos);
  if (!n || count > UINT32_MAX) return NULL;
  n->count = (uint32_t)count;
  size_t bytes = (count ? count : 1) * sizeof(void *);
  switch (kind) {
    case VS_AST_SEQ: return (n->as.seq.at = vs_ast_alloc(ast, bytes)) ? n : NULL;
    case VS_AST_CALL: return (n->as.call.at = vs_ast_alloc(ast, bytes)) ? n : NULL;
    case VS_AST_CASE: return (n->as.clauses.at = vs_ast_alloc(ast, bytes)) ? n : NULL;
    case VS_AST_LET:
    case VS_AST_FIX:
      return (n->as.let.vars = vs_ast_alloc(ast, bytes)) && (n->as.let.values = vs_ast_alloc(ast, bytes)) ? n : NULL;
    case VS_AST_LAMBDA:
      return (n->as.lambda.params = vs_ast_alloc(ast, (count ? count : 1) * sizeof(vs_param))) ? n : NULL;
  }
  return NULL;
}

void vs_gc_visit_trees(vs_scheme *vm, vs_gc_visit *visit) {
  for (vs_ast *a = vm->asts; a; a = a->next) {
    for (size_t i = vs_gc_is_minor(vm) ? a->pool_old : 0; i < a->pool_count; i++) visit(vm, &a->pool[i]);
    if (vs_gc_is_minor(vm)) a->pool_old = a->pool_count;
  }
}
