/* Declares the core language, which the expander passes to the compiler.
 *
 * A tree is in the memory arena of one vs_ast. Its Scheme values are indices into the tree's constant pool, which the
 * garbage collector visits. Both are counted in the memory budget. The tree is freed as a whole. The expander builds it
 * from an explicit worklist. The compiler recurses over it, but takes lambda bodies from a worklist. The nesting inside
 * one lambda must therefore stay below VS_AST_DEPTH: the expander moves deeper subexpressions into a LAMBDA without
 * parameters, which is called at once. SEQ and CALL count one level at any length. The last element of a SEQ, each arm
 * of an IF in the tail of another (cond chains) and the body of a LET count one level each.
 *
 * Binding: vs_ast_var creates a variable, a vs_var; references point to it. The compiler finds captures and
 * assignments; the expander sets only the name. A vs_var belongs to exactly one LAMBDA, LET or FIX.
 *
 * Every node has the place of its form in the source. Error messages and call chains show the place of a CALL. */
#ifndef VS_VM_FRONT_AST_H
#define VS_VM_FRONT_AST_H

#include "vm/values/gc.h"

enum {
#define VS_AST(kind) VS_AST_##kind,
#include "vm/front/ast.def"
#undef VS_AST
  VS_AST_COUNT
};
enum { VS_AST_DEPTH = 400 };

typedef struct vs_core_node vs_core_node;

typedef struct vs_var {
  uint32_t name;             /* constant index of the variable's symbol */
  bool introduced;           /* created by a macro, so that messages do not show it */
  bool in_register;          /* whether the variable, unless it is captured, may be assigned in its register: no
                              * continuation of its activation is entered twice */
  bool given_again;          /* of a FIX: whether a continuation may compute its value a second time, so that it counts
                              * as assigned */
  /* Members that the compiler sets. */
  bool assigned, captured, known;
  uint32_t refs, calls;
  vs_core_node *owner, *value;    /* owner: LAMBDA that contains the variable; value: for a variable of a FIX whose
                                   * value is a LAMBDA, this LAMBDA */
  uint32_t reg;
  void *extra;
} vs_var;

typedef struct vs_param {    /* a parameter of a lambda; the order is required, optional, keyword */
  vs_var *var;
  vs_core_node *fallback;         /* default value, which may use the previous parameters; NULL: the parameter is
                                   * required */
  uint32_t keyword;          /* 0, or 1 + constant index of the keyword's symbol (without #:); a keyword parameter
                              * without a fallback is required */
} vs_param;

struct vs_core_node {
  uint8_t kind;
  bool flag;
  uint32_t count;            /* number of elements of `at` */
  vs_pos pos;
  union {
    uint32_t constant;                                            /* CONST: index of the constant */
    vs_var *var;                                                  /* LOCAL: the variable to which the node refers */
    struct { vs_var *var; vs_core_node *value; } set;                  /* SETLOCAL: an assignment, with the unspecific
                                                                        * value as its result */
    /* GLOBAL, SETGLOBAL, DEFGLOBAL: constant index of the variable's CELL. A reference to a cell that contains
     * VS_UNDEFINED is the error "NAME is not defined". */
    struct { uint32_t cell; vs_core_node *value; } global;
    struct { vs_core_node *test, *then, *otherwise; } branch;          /* IF; otherwise NULL: the value is unspecific */
    struct { vs_core_node **at; } seq;                                 /* SEQ: expressions in order; with count 0, the
                                                                        * value is unspecific */
    /* CALL: evaluated from left to right, the callee first. keywords: 0, or 1 + constant index of a KEYWORDS object
     * that names the last arguments. */
    struct { vs_core_node *callee; vs_core_node **at; uint32_t keywords; } call;
    /* LET and FIX, with `count` variables. The values of a LET are outside the scope of its variables. A FIX is a
     * letrec*: values are computed in order with all variables in scope, and a reference before the value is an error.
     * Internal definitions become a FIX. Named let and do become a FIX of one LAMBDA, whose body is a CALL of it; the
     * compiler makes it a loop. */
    struct { vs_var **vars; vs_core_node **values; vs_core_node *body; } let;
    struct {
      uint32_t name;                                              /* 0, or 1 + constant index of the name, a symbol */
      vs_param *params;                                           /* array of `count` parameters */
      vs_var *rest;                                               /* the rest parameter, or NULL */
      vs_core_node *body;
      void *extra;                                                /* data of the compiler about this LAMBDA */
    } lambda;                                                     /* the members of a LAMBDA node */
    struct { uint32_t name; vs_core_node **at; } clauses;              /* CASE: a case-lambda; its clauses are
                                                                        * LAMBDAs */
    struct { vs_core_node *predicate, *value; uint32_t name, text, who; } check;
      /* CHECK: a contract. Its value is that of `value` if (predicate value) is true. Otherwise it is the error "WHO:
       * NAME must be TEXT, got VALUE". A predicate that raises an error counts as false. If the predicate is no
       * procedure, the message shows [NAME TEXT]. name, text: constants (symbol, any source datum); who: constant
       * (symbol or #f). The predicate expression is evaluated once, outside the lambda (in a LET around it, or in a
       * cell), and `predicate` refers to its value. The compiler recognises any? if it is a GLOBAL. */
  } as;
};

typedef struct vs_ast {
  vs_scheme *vm;
  struct vs_ast *next;          /* next element of the list vm->asts */
  struct vs_ast_chunk *chunks;
  size_t left; char *bump;
  vs_value *pool; size_t pool_count, pool_room;   /* pool of constants, which the garbage collector visits */
  size_t pool_old;                                /* index of the first constant that a minor collection must visit */
} vs_ast;

/* Opens a tree and adds it to the list vm->asts. The caller owns the struct (in a foreign object of the expander). */
bool vs_ast_open(vs_scheme *vm, vs_ast *ast);
void vs_ast_close(vs_ast *ast);             /* Frees the tree; also called after a failed vs_ast_open. */
void vs_ast_clear(vs_ast *ast);             /* Empties the tree for the next top-level form. */

/* Returns zeroed memory of the arena, aligned to 8 bytes. When memory is out, sets the error and returns NULL. */
void *vs_ast_alloc(vs_ast *ast, size_t bytes);
/* Sets *index to the index of the constant v in the pool, which may already contain v. */
bool vs_ast_const(vs_ast *ast, vs_value v, uint32_t *index);
vs_var *vs_ast_var(vs_ast *ast, vs_value symbol);
/* Returns a node of this kind (VS_AST_...), with all members zero. */
vs_core_node *vs_ast_node(vs_ast *ast, int kind, vs_pos pos);
/* These functions return nodes of the kinds in their names, or NULL when memory is out. */
vs_core_node *vs_ast_constant(vs_ast *ast, vs_value v, vs_pos pos);
vs_core_node *vs_ast_local(vs_ast *ast, vs_var *var, vs_pos pos);
/* Returns a SEQ, CALL, CASE, LET, FIX or LAMBDA with room for n elements. */
vs_core_node *vs_ast_list(vs_ast *ast, int kind, size_t n, vs_pos pos);

void vs_gc_visit_trees(vs_scheme *vm, vs_gc_visit *visit);             /* Visits the constants of the trees that are
                                                                        * being built, for the garbage collector. */

#endif
