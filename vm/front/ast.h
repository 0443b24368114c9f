/* Declares the core language, which the expander passes to the compiler.
 *
 * A tree is in the memory arena of one vs_ast, and is freed as a whole. Nodes refer to Scheme values by indices in the
 * tree's constant pool, which the garbage collector visits. Arena and pool are counted in the memory budget.
 *
 * The expander builds the tree from an explicit worklist. The compiler recurses over the tree, but takes the bodies of
 * lambdas from a worklist. The nesting inside one lambda must therefore stay below VS_AST_DEPTH: the expander moves
 * deeper subexpressions into a LAMBDA without parameters, which is called at once. A SEQ or CALL of any length counts
 * as one level. The last element of a SEQ, each arm of an IF in the tail of another IF (cond chains) and the body of a
 * LET count one level each.
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
  bool introduced;           /* whether a macro created the variable, so that messages do not show it */
  bool in_register;          /* whether the variable may be assigned in its register unless it is captured: no
                              * continuation returns to its activation twice */
  bool given_again;          /* for variables of a FIX (letrec*): whether a continuation may compute the value a second
                              * time, so that the variable counts as assigned */
  /* Flags of the variable that the compiler sets. */
  bool assigned, captured, known;
  uint32_t refs, calls;
  vs_core_node *owner, *value;    /* owner: LAMBDA that contains the variable. value: the LAMBDA that is the value of a
                                   * variable of a FIX, otherwise NULL */
  uint32_t reg;
  void *extra;
} vs_var;

typedef struct vs_param {    /* A parameter of a lambda. Required parameters come before optional ones, and these before
                              * keyword parameters. */
  vs_var *var;
  vs_core_node *fallback;         /* default value, which may refer to earlier parameters; NULL: the parameter is
                                   * required */
  uint32_t keyword;          /* 0, or 1 + constant index of the keyword's symbol (without #:); a keyword parameter
                              * without a fallback is required */
} vs_param;

struct vs_core_node {
  uint8_t kind;
  bool flag;
  uint32_t count;            /* number of elements of the node: expressions, variables or parameters */
  vs_pos pos;
  union {
    uint32_t constant;                                            /* CONST: index of the constant */
    vs_var *var;                                                  /* LOCAL: the variable to which the node refers */
    struct { vs_var *var; vs_core_node *value; } set;                  /* SETLOCAL: an assignment, with the unspecific
                                                                        * value as its result */
    /* GLOBAL, SETGLOBAL, DEFGLOBAL: constant index of the variable's CELL. A reference to a cell that contains
     * VS_UNDEFINED is the error "NAME is not defined". */
    struct { uint32_t cell; vs_core_node *value; } global;
    struct { vs_core_node *test, *then, *otherwise; } branch;          /* IF; if otherwise is NULL and the test is
                                                                        * false, the value is unspecific */
    struct { vs_core_node **at; } seq;                                 /* SEQ: expressions in order; with count 0, the
                                                                        * value is unspecific */
    /* CALL: callee and arguments, evaluated from left to right, the callee first. keywords: 0, or 1 + constant index of
     * a KEYWORDS object with the names of the last arguments. */
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
      void *extra;                                                /* the compiler's vs_lambda_info for this LAMBDA, or
                                                                   * NULL */
    } lambda;                                                     /* LAMBDA */
    struct { uint32_t name; vs_core_node **at; } clauses;              /* CASE: a case-lambda; its clauses are
                                                                        * LAMBDAs */
    struct { vs_core_node *predicate, *value; uint32_t name, text, who; } check;
      /* CHECK: a contract. If (predicate value) is true, the result is the value. Otherwise the error is "WHO: NAME
       * must be TEXT, got VALUE". name, text, who: indices of constants. */
  } as;
};

typedef struct vs_ast {
  vs_scheme *vm;
  struct vs_ast *next;          /* next element of the list vm->asts */
  struct vs_ast_chunk *chunks;
  size_t left; char *bump;
  vs_value *pool; size_t pool_count, pool_room;   /* pool of constants, which the garbage collector visits */
  size_t pool_old;                                /* index of the first constant that a minor garbage collection must
                                                   * visit */
} vs_ast;

/* Opens a tree and adds it to the list vm->asts. The caller owns the struct, as a member of the expander's foreign
 * object. */
bool vs_ast_open(vs_scheme *vm, vs_ast *ast);
void vs_ast_close(vs_ast *ast);             /* Frees the tree. It must be called even if vs_ast_open failed. */
void vs_ast_clear(vs_ast *ast);             /* Empties the tree for the next top-level form. */

/* Returns zeroed memory of the tree's arena, aligned to 8 bytes. When memory is out, sets the error and returns
 * NULL. */
void *vs_ast_alloc(vs_ast *ast, size_t bytes);
/* Sets *index to the index of the constant v in the pool, which may already contain v. */
bool vs_ast_const(vs_ast *ast, vs_value v, uint32_t *index);
vs_var *vs_ast_var(vs_ast *ast, vs_value symbol);
/* Returns a node of this kind (VS_AST_...), with all members zero. */
vs_core_node *vs_ast_node(vs_ast *ast, int kind, vs_pos pos);
/* vs_ast_constant and similar functions return a node of the kind in their name, or NULL when memory is out. */
vs_core_node *vs_ast_constant(vs_ast *ast, vs_value v, vs_pos pos);
vs_core_node *vs_ast_local(vs_ast *ast, vs_var *var, vs_pos pos);
/* Returns a SEQ, CALL, CASE, LET, FIX or LAMBDA with room for n elements. */
vs_core_node *vs_ast_list(vs_ast *ast, int kind, size_t n, vs_pos pos);

void vs_gc_visit_trees(vs_scheme *vm, vs_gc_visit *visit);             /* Visits the constants of the trees that are
                                                                        * being built, for the garbage collector. */

#endif
