/* Owns the expander's machine: it turns a form of a program into a core tree (ast.h), with macros expanded and names
 * resolved.
 *
 * Plan. A stack of tasks, each "expand this form in this environment and store the node there". A task may push others;
 * nothing recurses on the C stack. x->now is the current task. Its values are traced, so a handler reads them from
 * there again after an allocation. If the transformer of a macro is a Scheme procedure, the task stays on the stack,
 * marked as waiting, and the machine returns VS_EXPAND_CALL; it is entered again with the result.
 *
 * Depth: the compiler recurses over the tree within one lambda. Therefore the expander puts a subexpression at
 * DEPTH_LIMIT levels into a procedure without parameters, which is called at once.
 *
 * Life: a vs_expansion is inside a foreign object, with hooks that trace and free it. */
#ifndef VS_VM_FRONT_EXPAND_H
#define VS_VM_FRONT_EXPAND_H

#include "vm/front/ast.h"
#include "vm/front/environment.h"
#include "vm/machine/native.h"

enum {
#define VS_FORM(id, name, kind, shape) VS_FORM_##id,
#include "vm/front/forms.def"
#undef VS_FORM
  VS_FORM_COUNT
};
enum { VS_MACRO_RULES = -1, VS_MACRO_PROCEDURE = -2 };   /* vs_macro.kind as a fixnum: a VS_FORM_, or one of these */

typedef enum {
  VS_TASK_EXPR,      /* form: an expression */
  VS_TASK_BODY,      /* form: the rest of a body; acc: its definitions and expressions, newest first (body.c) */
  VS_TASK_TOP,       /* form: a top-level form */
  VS_TASK_QUASI,     /* form: a template; n: its level */
  VS_TASK_CASE,      /* form: the clauses of a case; var: the key's variable */
  VS_TASK_PREDICATE  /* form: a contract's predicate: and, or, not, list-of in it combine predicates (lambda.c) */
} vs_task_kind;

typedef struct vs_task {
  uint8_t kind;
  bool test;         /* only the truth of the value matters */
  bool decides;      /* its truth decides what is evaluated next: a procedure here is a mistake */
  bool waiting;      /* a transformer was called */
  bool chained;      /* the rest of a form whose shape has been checked: (and b c) of (and a b c) */
  uint32_t depth, n;
  vs_pos pos;        /* of the form, if the form has no position */
  vs_core_node **into;
  vs_var *var;
  vs_value form, env, acc;
} vs_task;

typedef enum {
  VS_EXPAND_ERROR,
  VS_EXPAND_CALL,
  VS_EXPAND_NODE,
  VS_EXPAND_FORMS,
  VS_EXPAND_RUN,
  VS_EXPAND_NOTHING
} vs_expand_result;

typedef struct vs_expansion {
  vs_scheme *vm;
  vs_ast ast;
  bool tree;               /* ast is open */
  vs_task now, *tasks;
  size_t count, room;
  size_t old;              /* the first task that a minor collection still has to visit */
  int64_t serial;          /* of the top-level form: scopes with another number are dead */
  vs_core_node *root;
  vs_expand_result result;
  bool definition;         /* NODE: of a definition: no value to report */
  vs_value procedure, args;   /* CALL, RUN: the procedure to call, and the list of arguments */
  vs_value forms;          /* FORMS: to be expanded instead, in order */
  vs_value later;          /* the top-level forms after this one: they may define a missing name */
  int poll;
} vs_expansion;

extern const vs_foreign_type vs_expansion_type;
bool vs_expansion_make(vs_scheme *vm, vs_value *out);                         /* a foreign object */

/* Begins a top-level form of `env`, in its environment. Then step until the result is neither ERROR nor CALL.
 *   CALL     call x->procedure with x->args and step again with the value
 *   NODE     x->root is the tree of the form
 *   FORMS    x->forms replace the form
 *   RUN      call x->procedure with x->args; the form is then finished
 *   NOTHING  the form is finished */
bool vs_expansion_begin(vs_expansion *x, vs_value form, vs_value env, vs_pos pos);
vs_expand_result vs_expansion_step(vs_expansion *x, vs_value value);

/* ---- for the forms ---- */
bool vs_expand_push(vs_expansion *x, vs_task_kind kind, vs_value form, vs_value env, vs_pos pos, vs_core_node **into,
                    uint32_t depth);
vs_task *vs_expand_top(vs_expansion *x);                               /* the task pushed last */
/* Expands element number nth of the current form, which has it, as an expression one level down. */
bool vs_expand_nth(vs_expansion *x, int64_t nth, vs_value env, vs_core_node **into);
/* Expands the elements of `list` (a tail of the current form) into a node's `at`. */
bool vs_expand_list(vs_expansion *x, vs_value list, vs_value env, vs_core_node **at, uint32_t depth);
/* Beyond some depth puts the task's form into a procedure that is called at once, so that recursion over the tree stays
 * shallow. */
bool vs_expand_outline(vs_expansion *x);
/* Expands a body: definitions and expressions, in a new scope of env. */
bool vs_expand_body(vs_expansion *x, vs_value forms, vs_value env, vs_pos pos, vs_core_node **into, uint32_t depth);

vs_core_node *vs_expand_node(vs_expansion *x, int kind, vs_pos pos);
vs_core_node *vs_expand_many(vs_expansion *x, int kind, size_t n, vs_pos pos);
/* Returns a reference to the library's own variable. */
vs_core_node *vs_expand_core(vs_expansion *x, const char *name, vs_pos pos);
/* Returns a call of it with room for n arguments. */
vs_core_node *vs_expand_call(vs_expansion *x, const char *name, size_t n, vs_pos pos);
vs_core_node *vs_expand_ref(vs_expansion *x, vs_value id, vs_value env, vs_pos pos);
bool vs_expand_var(vs_expansion *x, vs_value id, vs_value scope, vs_var **var);     /* a new variable, bound in scope */
bool vs_expand_scope(vs_expansion *x, vs_value env, vs_value *out);

/* form is a VS_FORM_. */
bool vs_is_form(vs_value env, vs_value id, int form);                  /* whether id means that syntax here */
vs_pos vs_form_pos(vs_value form, vs_pos outer);                       /* of a pair */
vs_pos vs_element_pos(vs_value pair, bool first, vs_pos outer);        /* of the car of a pair of a list */
/* Reports a syntax error at pos; adds `what`, written, unless it is VS_ABSENT. */
bool vs_expand_fail(vs_expansion *x, vs_pos pos, vs_value what, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* form is a VS_FORM_. */
bool vs_expand_shape(vs_expansion *x, int form);                       /* error "this is written (...)" there */

/* Expands macros at the head of *form until it is core syntax, an application or no pair; *m is the head's meaning.
 * Also returns false when the task has to wait (x->now.waiting is then set). */
bool vs_expand_settle(vs_expansion *x, vs_value *form, vs_meaning *m, vs_pos *pos);

/* Returns the form of the words import and define-library, or -1. They structure a program also if no import binds
 * them. m: the meaning of a top-level form's head. */
int vs_unit_word(const vs_meaning *m);

#define VS_FORM(id, name, kind, shape) VS_FORM_DECLARE_##kind(id)
#define VS_FORM_DECLARE_CORE(id) bool vs_form_##id(vs_expansion *x);
#define VS_FORM_DECLARE_REWRITE(id) bool vs_form_##id(vs_expansion *x, vs_value *form);
#define VS_FORM_DECLARE_DEFINITION(id)
#define VS_FORM_DECLARE_AUXILIARY(id)
#include "vm/front/forms.def"
#undef VS_FORM
#undef VS_FORM_DECLARE_CORE
#undef VS_FORM_DECLARE_REWRITE
#undef VS_FORM_DECLARE_DEFINITION
#undef VS_FORM_DECLARE_AUXILIARY

const char *vs_form_shape(int form);
bool vs_front_open(vs_scheme *vm);     /* makes vm->at.core, the core environment with its syntax */

#endif
