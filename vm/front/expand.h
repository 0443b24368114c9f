/* Declares the expander. It converts a form of a program to a core tree (ast.h): macros are expanded and names are
 * resolved.
 *
 * The expander has a stack of tasks; each is "expand this form in this environment and store the node there". A task
 * may push others; nothing recurses on the C stack. x->now is the current task. The garbage collector updates its
 * values, so that a function must read them again after an allocation. If the transformer of a macro is a Scheme
 * procedure, the task stays on the stack, marked as waiting, and vs_expansion_step returns VS_EXPAND_CALL. The caller
 * calls vs_expansion_step again with the procedure's value.
 *
 * The compiler recurses over the tree within one lambda. At DEPTH_LIMIT levels, the expander therefore puts a
 * subexpression into a procedure without parameters that is called at once.
 *
 * A vs_expansion is inside a foreign object, whose functions show its values to the garbage collector and free it. */
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
enum { VS_MACRO_RULES = -1, VS_MACRO_PROCEDURE = -2 };   /* special values of vs_macro.kind, a fixnum that is otherwise
                                                          * a VS_FORM_ */

typedef enum {
  VS_TASK_EXPR,      /* form: an expression */
  VS_TASK_BODY,      /* form: remaining forms of a body; acc: its definitions and expressions, newest first (body.c) */
  VS_TASK_TOP,       /* form: a top-level form */
  VS_TASK_QUASI,     /* form: a quasiquote template; n: number of quasiquotes around it */
  VS_TASK_CASE,      /* form: the clauses of a case; var: the variable that contains the key's value */
  VS_TASK_PREDICATE  /* form: predicate of a contract, in which and, or, not and list-of combine predicates
                      * (lambda.c) */
} vs_task_kind;

typedef struct vs_task {
  uint8_t kind;
  bool test;         /* whether only the truth of the form's value is used, as in a test */
  bool decides;      /* whether the form's value decides which form is evaluated next; a procedure as this value is
                      * probably a mistake */
  bool waiting;      /* whether the task waits for the result of the procedure that expands a macro */
  bool chained;      /* whether the form is the rest of a form whose syntax was already checked, such as (and b c) of
                      * (and a b c) */
  uint32_t depth, n;
  vs_pos pos;        /* place in the source if the form itself has no place */
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
  bool tree;               /* whether the core tree `ast` is open */
  vs_task now, *tasks;
  size_t count, room;
  size_t old;              /* index of the first task that a minor garbage collection must visit */
  int64_t serial;          /* number of the top-level form that is expanded; scopes with another number are no longer
                            * valid */
  vs_core_node *root;
  vs_expand_result result;
  bool definition;         /* result NODE: whether the form is a definition, whose value the prompt does not print */
  vs_value procedure, args;   /* results CALL and RUN: the procedure to call and its list of arguments */
  vs_value forms;          /* result FORMS: the forms that replace the expanded form, in order */
  vs_value later;          /* list of the top-level forms after this one, which may define a name that is not defined
                            * yet */
  int poll;
} vs_expansion;

extern const vs_foreign_type vs_expansion_type;
bool vs_expansion_make(vs_scheme *vm, vs_value *out);                         /* Sets *out to a foreign object that
                                                                               * contains a new expansion. */

/* Begins to expand a top-level form in environment `env`. vs_expansion_step is then called until its result is neither
 * ERROR nor CALL.
 *   CALL     the caller calls x->procedure with x->args, and passes the value to the next step
 *   NODE     x->root is the tree of the form
 *   FORMS    x->forms replace the form
 *   RUN      the caller calls x->procedure with x->args; the form is then finished
 *   NOTHING  the form is finished */
bool vs_expansion_begin(vs_expansion *x, vs_value form, vs_value env, vs_pos pos);
vs_expand_result vs_expansion_step(vs_expansion *x, vs_value value);

/* ---- functions for the files that expand forms ---- */
bool vs_expand_push(vs_expansion *x, vs_task_kind kind, vs_value form, vs_value env, vs_pos pos, vs_core_node **into,
                    uint32_t depth);
vs_task *vs_expand_top(vs_expansion *x);                               /* Returns the task pushed last. */
/* Pushes a task that expands element `nth` of the current form as an expression, one level deeper. */
bool vs_expand_nth(vs_expansion *x, int64_t nth, vs_value env, vs_core_node **into);
/* Pushes tasks that expand the elements of `list`, a tail of the current form, to at[0], at[1], ... */
bool vs_expand_list(vs_expansion *x, vs_value list, vs_value env, vs_core_node **at, uint32_t depth);
/* At DEPTH_LIMIT, puts the task's form into a procedure that is called at once, so that the tree of each lambda is
 * shallow. */
bool vs_expand_outline(vs_expansion *x);
/* Pushes a task that expands a body (definitions and expressions) in a new scope of env. */
bool vs_expand_body(vs_expansion *x, vs_value forms, vs_value env, vs_pos pos, vs_core_node **into, uint32_t depth);

vs_core_node *vs_expand_node(vs_expansion *x, int kind, vs_pos pos);
vs_core_node *vs_expand_many(vs_expansion *x, int kind, size_t n, vs_pos pos);
/* Returns a reference to a variable of the library. */
vs_core_node *vs_expand_core(vs_expansion *x, const char *name, vs_pos pos);
/* Returns a call of a procedure of the library, with room for n arguments. */
vs_core_node *vs_expand_call(vs_expansion *x, const char *name, size_t n, vs_pos pos);
vs_core_node *vs_expand_ref(vs_expansion *x, vs_value id, vs_value env, vs_pos pos);
bool vs_expand_var(vs_expansion *x, vs_value id, vs_value scope, vs_var **var);     /* Sets *var to a new variable, and
                                                                                     * binds id to it in the scope. */
bool vs_expand_scope(vs_expansion *x, vs_value env, vs_value *out);

/* Returns true if the identifier id means the syntax `form` (a VS_FORM_) in env. */
bool vs_is_form(vs_value env, vs_value id, int form);
vs_pos vs_form_pos(vs_value form, vs_pos outer);                       /* Returns the place of `form`, or `outer` if it
                                                                        * is no pair with a place. */
vs_pos vs_element_pos(vs_value pair, bool first, vs_pos outer);        /* Returns the place of the car of `pair`, a part
                                                                        * of a list, or `outer` if it is unknown. first:
                                                                        * `pair` is the first pair of the list. */
/* Reports a syntax error at pos. Appends `what` as text to the message, unless it is VS_ABSENT. */
bool vs_expand_fail(vs_expansion *x, vs_pos pos, vs_value what, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Reports that the syntax `form` (a VS_FORM_) is used wrongly: "this is written (...)". */
bool vs_expand_shape(vs_expansion *x, int form);

/* Expands the macro at the head of *form, repeatedly, until *form is core syntax, an application or no pair. Sets *m to
 * the meaning of its head. Returns false on an error, or with x->now.waiting set if the task must wait. */
bool vs_expand_settle(vs_expansion *x, vs_value *form, vs_meaning *m, vs_pos *pos);

/* Returns VS_FORM_import or VS_FORM_define_library if m is the unbound name `import` or `define-library`, otherwise -1.
 * m: the meaning of a top-level form's head. These words structure a program even if no import binds them. */
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
bool vs_front_open(vs_scheme *vm);     /* Creates vm->at.core, the environment with the core syntax. */

#endif
