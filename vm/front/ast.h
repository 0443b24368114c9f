/* Owns the core language: what the expander hands to the compiler.

   A tree lives in the arena of one vs_ast; Scheme values in it are indices into the tree's constant pool, which is a
   root. Both are accounted memory. The tree is freed as a whole. The expander builds it from an explicit worklist; the
   compiler recurses over it, but not into lambda bodies (those come from a worklist), so nesting inside one lambda must
   stay below VS_AST_DEPTH: deeper subexpressions are outlined by the expander as CALL of a LAMBDA without parameters.
   SEQ and CALL count one level whatever their length; the last element of a SEQ, both arms of an IF in tail position of
   one another (cond chains) and the body of a LET count one level each like anything else.

   Binding: a variable is a vs_var made by vs_ast_var; references point at it. Who captures and assigns is found by the
   compiler; the expander fills nothing but the name. A vs_var belongs to exactly one LAMBDA, LET or FIX.

   Every node has a place: that of the form it came from. For CALL it is what the error message and call chain show. */
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
  bool introduced;           /* a macro's own: nobody wrote it, nobody is shown it */
  bool in_register;          /* unless captured, it is assigned where it lies: no continuation enters it twice */
  bool given_again;          /* FIX: its value may come a second time, to the same place: as if it were assigned */
  /* the compiler's */
  bool assigned, captured, known;
  uint32_t refs, calls;
  vs_core_node *owner, *value;    /* the LAMBDA it lives in; FIX: its initial LAMBDA */
  uint32_t reg;
  void *extra;
} vs_var;

typedef struct vs_param {    /* one parameter of a lambda, in the order required, optional, keyword */
  vs_var *var;
  vs_core_node *fallback;         /* NULL: required. Else evaluated when it was not given, in the scope of the
                                parameters before it */
  uint32_t keyword;          /* 0, or 1 + constant index of the keyword's symbol (the name without #:). A keyword
                                parameter with fallback NULL must be given */
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
    /* GLOBAL, SETGLOBAL, DEFGLOBAL: constant index of a CELL. GLOBAL of a cell holding VS_UNDEFINED is the error
     * "NAME is not defined" */
    struct { uint32_t cell; vs_core_node *value; } global;
    struct { vs_core_node *test, *then, *otherwise; } branch;          /* IF; otherwise NULL: #unspecific */
    struct { vs_core_node **at; } seq;                                 /* SEQ; count 0: #unspecific */
    /* CALL; keywords: 0 or 1 + constant index of a KEYWORDS object that names the last arguments. Evaluated left to
     * right, callee first */
    struct { vs_core_node *callee; vs_core_node **at; uint32_t keywords; } call;
    /* LET (values outside the scope), FIX (letrec*: in order, all in scope; a reference too early is an error);
     * count variables. Internal defines are FIX. Named let and do: FIX of one LAMBDA whose body is a CALL of it: the
     * compiler makes it a loop */
    struct { vs_var **vars; vs_core_node **values; vs_core_node *body; } let;
    struct {
      uint32_t name;                                              /* 0 or 1 + constant index of a symbol */
      vs_param *params;                                           /* count of them */
      vs_var *rest;                                               /* or NULL */
      vs_core_node *body;
      void *extra;                                                /* the compiler's */
    } lambda;                                                     /* LAMBDA */
    struct { uint32_t name; vs_core_node **at; } clauses;              /* CASE: case-lambda, LAMBDAs */
    struct { vs_core_node *predicate, *value; uint32_t name, text, who; } check;
      /* CHECK: a contract. Value of `value` if (predicate value) is true; else the error "WHO: NAME must be TEXT, got
         VALUE". A predicate that raises counts as false, one that is no procedure makes the message show [NAME TEXT].
         name, text: constants (symbol, any datum as written); who: constant (symbol or #f). The expander evaluates the
         predicate expression once, outside the lambda (a LET around it, or its own cell), and `predicate` is a
         reference to that; the compiler knows any? when it is a GLOBAL. */
  } as;
};

typedef struct vs_ast {
  vs_scheme *vm;
  struct vs_ast *next;          /* vm->asts */
  struct vs_ast_chunk *chunks;
  size_t left; char *bump;
  vs_value *pool; size_t pool_count, pool_room;   /* constants; roots */
  size_t pool_old;                                /* of them, the first that no minor collection has to look at again */
} vs_ast;

/* links it into vm->asts; the struct is the caller's (in a foreign object of the expander) */
bool vs_ast_open(vs_scheme *vm, vs_ast *ast);
void vs_ast_close(vs_ast *ast);             /* frees everything; also after a failed open */
void vs_ast_clear(vs_ast *ast);             /* for the next top-level form */

/* zeroed, 8-aligned; NULL and memory error */
void *vs_ast_alloc(vs_ast *ast, size_t bytes);
/* the same immediate or object may share an index */
bool vs_ast_const(vs_ast *ast, vs_value v, uint32_t *index);
vs_var *vs_ast_var(vs_ast *ast, vs_value symbol);
/* kind is a VS_AST_. */
vs_core_node *vs_ast_node(vs_ast *ast, int kind, vs_pos pos);                    /* fields zero */
/* shorthands; NULL when memory is out */
vs_core_node *vs_ast_constant(vs_ast *ast, vs_value v, vs_pos pos);
vs_core_node *vs_ast_local(vs_ast *ast, vs_var *var, vs_pos pos);
/* SEQ, CALL, CASE, LET, FIX, LAMBDA with room for n */
vs_core_node *vs_ast_list(vs_ast *ast, int kind, size_t n, vs_pos pos);

void vs_gc_visit_trees(vs_scheme *vm, vs_gc_visit *visit);             /* ast.c: constants of the trees being built */

#endif
