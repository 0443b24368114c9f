/* Owns derivations: the stack of scopes that wait for their rules, and the objects that rules have made so far.
 *
 * A derivation begins where an operator or a rule is called from outside of any rule, and ends when its stack is
 * empty; what was made is then one object. Within a sequence of a rule the same operators only leave their scopes on
 * the stack. No call nests, whatever a rule's depth: rules.scm has the loop.
 *
 * How an operator knows: a form of a sequence hands over a live scope, one whose wrapper names the derivation under
 * way. Wrappers that programs see are plain; the operator or rule that gets a live one takes the mark away. */
#ifndef VS_BIND_RULES_DERIVATION_H
#define VS_BIND_RULES_DERIVATION_H

#include "bind/rules/lineage.h"
#include "bind/rules/surroundings.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/plane/outline.h"
#include "model/mesh.h"

typedef struct vs_args vs_args;

/* Scopes that wait, in order, each for its rule. */
typedef struct vs_rule_task {
  size_t bytes;
  uint32_t entry;       /* in the record */
  uint32_t count, next; /* child[next ...] are left */
  bool many;            /* each has a rule of its own, else all have rules[0] */
  bool body;            /* the rule is the body of one whose name this is, its arguments given */
  const char *name;
  const vs_origin *origin; /* where the operator stands */
  vs_value *rules;         /* behind the children */
  vs_scope *child[];
} vs_rule_task;

/* A scope that waits until nothing else is left, for signals of this name. */
typedef struct {
  vs_rule_task *task;
  const char *name; /* the store's */
} vs_waiting;

typedef struct vs_derivation {
  vs_scheme *vm;
  vs_bind *bind;      /* vm's */
  vs_store *store;    /* bind's */
  vs_rule_task **stack;
  size_t count, room;
  size_t begun; /* tasks that were there when the rule that runs began: those above it come in the order of its forms */
  vs_ref *made; /* references of our own */
  size_t made_count, made_room;
  vs_scope_flags **made_flags; /* of each thing that was made; none where flags_room ends */
  size_t flags_room;
  vs_waiting *waiting;
  size_t waiting_count, waiting_room;
  vs_scope *now;               /* whose rule runs; retained. NULL: none yet */
  vs_lineage *lineage;         /* shared with the derivations that its rules began */
  uint32_t entry, position;    /* in the record: of the scope whose rule runs */
  vs_surroundings *around;     /* of what was made, for questions; NULL: nobody asked yet */
  vs_value rule;               /* that next is to be called */
  const char *name;            /* of the rule that runs; NULL: none yet */
  uint32_t steps;              /* operators that it has used */
  uint32_t most;               /* levels a path may have */
  bool over;                   /* its object was handed out */
  struct vs_derivation *outer; /* valid while this one grows */
  uint64_t random[4];          /* the program's generator, put back in the end */
  /* bounds of what was placed last: a repeat places the same object over and over */
  vs_node *fitted; /* retained, or NULL */
  vs_bounds fitted_bounds;
} vs_derivation;

extern const vs_foreign_type vs_derivation_type;

enum { VS_RULES_DEPTH = 1000, VS_RULES_PARTS = 10000000 };

/* The derivation that the operator f works for: the one under way if argument 0 is live, else a new one, which is
 * *holder then. *holder is what the operator returns, and must be rooted. NULL: the error is set. */
vs_derivation *vs_rules_begin(vs_args *f, vs_value *holder);
/* Room for count scopes. many: each with its own rule. The caller fills child[] and rules[], and pushes or drops it. */
vs_rule_task *vs_task_new(vs_derivation *d, uint32_t count, bool many);
void vs_task_drop(vs_derivation *d, vs_rule_task *t);
/* Puts it on the stack. False: it is dropped, the error is set. */
bool vs_task_push(vs_derivation *d, vs_rule_task *t);
/* A copy of parent, or a new scope of class c, as child index of count of the operator op: path, depth and flags are
 * set. NULL: the error is set: no memory, or the path is too long. */
vs_scope *vs_rules_child(vs_derivation *d, vs_scope *parent, vs_scope_class c, const char *op, uint32_t index,
                         uint32_t count);
/* Adds an object to what was made, in a scope with these flags. False: the error is set. */
bool vs_rules_gather(vs_derivation *d, vs_ref ref, vs_scope_flags *flags);
/* The classes that an operator works on, else the error. */
bool vs_rules_class(vs_args *f, int i, unsigned classes);
const char *vs_rules_operator(vs_args *f); /* its name in a path: that of the procedure without "scope-" */

#endif
