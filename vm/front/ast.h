/* Owns the core language, which the expander passes to the compiler.
 *
 * A tree is in the arena of one vs_ast. Its Scheme values are indices into the tree's constant pool, which is a root.
 * Both are accounted memory. The tree is freed as a whole. The expander builds it from an explicit worklist. The
 * compiler recurses over it, but takes lambda bodies from a worklist, so the nesting inside one lambda must stay below
 * VS_AST_DEPTH: the expander outlines deeper subexpressions as a CALL of a LAMBDA without parameters. SEQ and CALL
 * count one level at any length. The last element of a SEQ, each arm of an IF in the tail of another (cond chains) and
 * the body of a LET count one level each.
 *
 * Binding: vs_ast_var makes a variable, a vs_var; references point to it. The compiler finds captures and assignments;
 * the expander fills only the name. A vs_var belongs to exactly one LAMBDA, LET or FIX.
 *
 * Every node has a place: that of its form. For CALL the error message and the call chain show it. */
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
  uint32_t name;             /* constant index of its symbol */
  bool introduced;           /* made by a macro: no message shows it */
  bool in_register;          /* unless captured, it is assigned in its register: no continuation enters twice */
  bool given_again;          /* FIX: its value may be given a second time, to the same place: counts as assigned */
  /* set by the compiler */
  bool assigned, captured, known;
  uint32_t refs, calls;
  vs_core_node *owner, *value;    /* the LAMBDA that contains it; FIX: its initial LAMBDA */
  uint32_t reg;
  void *extra;
} vs_var;

typedef struct vs_param {    /* a parameter of a lambda, in the order required, optional, keyword */
  vs_var *var;
  vs_core_node *fallback;         /* NULL: required. Else the default, in the scope of the parameters before it */
  uint32_t keyword;          /* 0, or 1 + constant index of the keyword's symbol (the name without #:). A keyword
                              * parameter without a fallback is required */
} vs_param;

struct vs_core_node {
  uint8_t kind;
  bool flag;
  uint32_t count;            /* of `at` */
  vs_pos pos;
  union {
    uint32_t constant;                                            /* CONST: index */
    vs_var *var;                                                  /* LOCAL */
    struct { vs_var *var; vs_core_node *value; } set;                  /* SETLOCAL; its value is #unspecific */
    /* GLOBAL, SETGLOBAL, DEFGLOBAL: constant index of a CELL. GLOBAL of a cell that contains VS_UNDEFINED is the error
     * "NAME is not defined" */
    struct { uint32_t cell; vs_core_node *value; } global;
    struct { vs_core_node *test, *then, *otherwise; } branch;          /* IF; `otherwise` NULL: #unspecific */
    struct { vs_core_node **at; } seq;                                 /* SEQ; count 0: #unspecific */
    /* CALL; keywords: 0, or 1 + constant index of a KEYWORDS object that names the last arguments. Evaluated left to
     * right, callee first */
    struct { vs_core_node *callee; vs_core_node **at; uint32_t keywords; } call;
    /* LET (values outside the scope), FIX (letrec*: in order, all in scope; a reference too early is an error); count
     * variables. Internal defines are FIX. Named let and do: FIX of one LAMBDA with a CALL of it as the body; the
     * compiler makes it a loop */
    struct { vs_var **vars; vs_core_node **values; vs_core_node *body; } let;
    struct {
      uint32_t name;                                              /* 0, or 1 + constant index of a symbol */
      vs_param *params;                                           /* count of them */
      vs_var *rest;                                               /* or NULL */
      vs_core_node *body;
      void *extra;                                                /* used by the compiler */
    } lambda;                                                     /* LAMBDA */
    struct { uint32_t name; vs_core_node **at; } clauses;              /* CASE: case-lambda, LAMBDAs */
    struct { vs_core_node *predicate, *value; uint32_t name, text, who; } check;
      /* CHECK: a contract. The value of `value` if (predicate value) is true; else the error "WHO: NAME must be TEXT,
       * got VALUE". A predicate that raises counts as false; for one that is no procedure the message shows [NAME
       * TEXT]. name, text: constants (symbol, any source datum); who: constant (symbol or #f). The expander evaluates
       * the predicate expression once, outside the lambda (a LET around it, or its own cell); `predicate` refers to
       * that. The compiler recognizes any? if it is a GLOBAL. */
  } as;
};

typedef struct vs_ast {
  vs_scheme *vm;
  struct vs_ast *next;          /* vm->asts */
  struct vs_ast_chunk *chunks;
  size_t left; char *bump;
  vs_value *pool; size_t pool_count, pool_room;   /* constants; roots */
  size_t pool_old;                                /* the first constant that a minor collection still has to visit */
} vs_ast;

/* Opens a tree and links it into vm->asts. The caller owns the struct (in a foreign object of the expander). */
bool vs_ast_open(vs_scheme *vm, vs_ast *ast);
void vs_ast_close(vs_ast *ast);             /* frees everything; also after a failed open */
void vs_ast_clear(vs_ast *ast);             /* for the next top-level form */

/* Returns zeroed memory, 8-aligned; NULL: out of memory, with the error set. */
void *vs_ast_alloc(vs_ast *ast, size_t bytes);
/* The same immediate or object may share an index. */
bool vs_ast_const(vs_ast *ast, vs_value v, uint32_t *index);
vs_var *vs_ast_var(vs_ast *ast, vs_value symbol);
/* Returns a node of this kind, a VS_AST_. */
vs_core_node *vs_ast_node(vs_ast *ast, int kind, vs_pos pos);                    /* fields are zero */
/* shorthands; NULL: out of memory */
vs_core_node *vs_ast_constant(vs_ast *ast, vs_value v, vs_pos pos);
vs_core_node *vs_ast_local(vs_ast *ast, vs_var *var, vs_pos pos);
/* Returns a SEQ, CALL, CASE, LET, FIX or LAMBDA with room for n. */
vs_core_node *vs_ast_list(vs_ast *ast, int kind, size_t n, vs_pos pos);

void vs_gc_visit_trees(vs_scheme *vm, vs_gc_visit *visit);             /* ast.c: constants of the trees being built */

#endif
