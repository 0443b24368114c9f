/* Declares derivations: applications of rules to a scope (a box or other shape) and to the scopes that they create. A
 * derivation has a stack of scopes that wait for their rules, and the objects that rules have created.
 *
 * A derivation begins when a program calls an operator or a rule outside of any rule. It ends when its stack is empty;
 * its value is the union of all objects. Operators inside a rule only push scopes. The loop that applies the rules is
 * in rules.scm, so that calls do not nest, even if rules are nested deeply.
 *
 * A scope tells an operator whether it is called inside a rule. Inside a rule, it receives a live scope, whose Scheme
 * object refers to the running derivation. Scopes in variables of the program are not live. An operator or rule that
 * receives a live scope removes the reference. */
#ifndef VS_BIND_RULES_DERIVATION_H
#define VS_BIND_RULES_DERIVATION_H

#include "bind/rules/lineage.h"
#include "bind/rules/surroundings.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/plane/outline.h"
#include "model/mesh.h"

typedef struct vs_args vs_args;

/* A task: the scopes that one call of an operator has created and that wait for their rules, in order. */
typedef struct vs_rule_task {
  size_t bytes;
  uint32_t entry;       /* number of the task's entry in the derivation's record (lineage.h) */
  uint32_t count, next; /* count: number of scopes; next: index of the first scope whose rule was not yet applied */
  bool many;            /* whether each scope has its own rule; otherwise rules[0] is the rule of all scopes of the
                         * task */
  bool body;            /* whether rules[0] is the body of the rule `name`, with the rule's arguments bound */
  const char *name;
  const vs_origin *origin; /* place of the operator's call in the program */
  vs_value *rules;         /* rules of the scopes; the array follows the array of scopes in one block of memory */
  vs_scope *child[];
} vs_rule_task;

/* A scope that waits for signals of one name, until all other scopes have been processed. */
typedef struct {
  vs_rule_task *task;
  const char *name; /* name of the signals, owned by the store */
} vs_waiting;

typedef struct vs_derivation {
  vs_scheme *vm;
  vs_bind *bind;      /* the program's vs_bind, not owned by the derivation */
  vs_store *store;    /* the store in which the objects are created */
  vs_rule_task **stack;
  size_t count, room;
  size_t begun; /* number of tasks when the running rule began; it has pushed the tasks from this index on, in the order
                 * of its expressions */
  vs_ref *made; /* objects that rules have created; their nodes are retained */
  size_t made_count, made_room;
  vs_scope_flags **made_flags; /* made_flags[i]: flags of object i; objects from flags_room on have none */
  size_t flags_room;
  vs_waiting *waiting;
  size_t waiting_count, waiting_room;
  vs_scope *now;               /* scope to which the running rule is applied, retained, or NULL */
  vs_lineage *lineage;         /* record of the derivation (lineage.h), shared with derivations that began within its
                                * rules */
  uint32_t entry, position;    /* the scope to which the rule is applied, in the record: number of its entry, and its
                                * position in this entry */
  vs_surroundings *around;     /* spatial tree of the objects created so far, for rules that ask about their
                                * surroundings; NULL before the first question */
  vs_value rule;               /* rule that %derivation-rule returns, a procedure */
  const char *name;            /* name of the running rule, or NULL */
  uint32_t steps;              /* number of operators that the running rule has called */
  uint32_t most;               /* greatest permitted number of levels of a scope's path */
  bool over;                   /* whether the derivation has ended and its object was returned */
  struct vs_derivation *outer; /* the derivation in one of whose rules this derivation began, or NULL; valid while this
                                * derivation runs */
  uint64_t random[4];          /* state of the program's random generator, which is restored at the derivation's end */
  /* The object that was placed last, and its bounds. A repeat places the same object many times, and need not measure
   * it again. */
  vs_node *fitted; /* node of the object placed last, retained, or NULL */
  vs_bounds fitted_bounds;
} vs_derivation;

extern const vs_foreign_type vs_derivation_type;

enum { VS_RULES_DEPTH = 1000, VS_RULES_PARTS = 10000000 };

/* Returns the derivation to which the operator f adds its scopes. If argument 0 is a live scope, returns the running
 * derivation. Otherwise begins a derivation, and sets *holder to its Scheme object, which becomes the operator's value.
 * *holder must be a root of the garbage collector. If it fails, sets the error and returns NULL. */
vs_derivation *vs_rules_begin(vs_args *f, vs_value *holder);
/* Returns a task with room for `count` scopes. many: each scope has its own rule. The caller sets child[] and rules[],
 * then calls vs_task_push or vs_task_drop. If it fails, sets the error and returns NULL. */
vs_rule_task *vs_task_new(vs_derivation *d, uint32_t count, bool many);
void vs_task_drop(vs_derivation *d, vs_rule_task *t);
/* Pushes the task on the stack. If it fails, drops it, sets the error and returns false. */
bool vs_task_push(vs_derivation *d, vs_rule_task *t);
/* Returns a new scope of class c: child `index` of the `count` children that the operator `op` creates from the scope
 * `parent`. Its path, depth and flags are set. If memory is out or the path is too long, sets the error and returns
 * NULL. */
vs_scope *vs_rules_child(vs_derivation *d, vs_scope *parent, vs_scope_class c, const char *op, uint32_t index,
                         uint32_t count);
/* Adds the object ref to the objects of d. flags: those of the scope in which it was created. If it fails, sets the
 * error and returns false. */
bool vs_rules_gather(vs_derivation *d, vs_ref ref, vs_scope_flags *flags);
/* Returns true if argument i is a scope of one of the classes in the mask `classes` (bits VS_SCOPE_BIT). Otherwise sets
 * the error and returns false. */
bool vs_rules_class(vs_args *f, int i, unsigned classes);
const char *vs_rules_operator(vs_args *f); /* Returns the operator's name as scopes' paths contain it: the procedure's
                                            * name without "scope-". */

#endif
