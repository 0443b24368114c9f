/* Owns derivations: the stack of scopes that wait for their rules, and the objects that rules have made.
 *
 * A derivation begins when a program calls an operator or a rule outside of any rule. It ends when its stack is empty;
 * all objects are then united to one. Inside a sequence of a rule the same operators only push their scopes. Calls do
 * not nest at any depth of rules: rules.scm has the loop.
 *
 * An operator recognises this by its scope. A form of a sequence passes a live scope, whose wrapper names the running
 * derivation. Wrappers that programs see are plain: the operator or rule that gets a live one removes the mark. */
#ifndef VS_BIND_RULES_DERIVATION_H
#define VS_BIND_RULES_DERIVATION_H

#include "bind/rules/lineage.h"
#include "bind/rules/surroundings.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/plane/outline.h"
#include "model/mesh.h"

typedef struct vs_args vs_args;

/* Scopes that wait for their rules, in order. */
typedef struct vs_rule_task {
  size_t bytes;
  uint32_t entry;       /* the number of its entry in the record */
  uint32_t count, next; /* child[next ...] still wait */
  bool many;            /* each child has its own rule; otherwise all have rules[0] */
  bool body;            /* rules[0] is the body of the rule `name`, with its arguments bound */
  const char *name;
  const vs_origin *origin; /* the place of the operator's call */
  vs_value *rules;         /* after the children, in the same block */
  vs_scope *child[];
} vs_rule_task;

/* A scope that waits for signals of this name, until no other scope is left. */
typedef struct {
  vs_rule_task *task;
  const char *name; /* owned by the store */
} vs_waiting;

typedef struct vs_derivation {
  vs_scheme *vm;
  vs_bind *bind;      /* vm's */
  vs_store *store;    /* bind's */
  vs_rule_task **stack;
  size_t count, room;
  size_t begun; /* the number of tasks when the running rule began; the tasks above it are in the order of its forms */
  vs_ref *made; /* holds its own references */
  size_t made_count, made_room;
  vs_scope_flags **made_flags; /* the flags of each object; no flags from flags_room on */
  size_t flags_room;
  vs_waiting *waiting;
  size_t waiting_count, waiting_room;
  vs_scope *now;               /* the scope whose rule runs; retained. NULL: none yet */
  vs_lineage *lineage;         /* shared with the derivations that its rules began */
  uint32_t entry, position;    /* the place in the record of the scope whose rule runs */
  vs_surroundings *around;     /* the surroundings, for questions of rules; NULL: no rule has asked yet */
  vs_value rule;               /* the next rule to call */
  const char *name;            /* the name of the running rule; NULL: none yet */
  uint32_t steps;              /* the number of operators that it has called */
  uint32_t most;               /* the most levels of a path */
  bool over;                   /* its object was returned */
  struct vs_derivation *outer; /* valid while this one runs */
  uint64_t random[4];          /* the state of the program's generator, restored at the end */
  /* The bounds of the last placed object: a repeat places the same object many times. */
  vs_node *fitted; /* retained, or NULL */
  vs_bounds fitted_bounds;
} vs_derivation;

extern const vs_foreign_type vs_derivation_type;

enum { VS_RULES_DEPTH = 1000, VS_RULES_PARTS = 10000000 };

/* Returns the derivation that the operator f works for: the running one if argument 0 is live, otherwise a new one,
 * which *holder then is. *holder is the operator's result and must be rooted. NULL: the error is set. */
vs_derivation *vs_rules_begin(vs_args *f, vs_value *holder);
/* Returns a task for count scopes; many: each has its own rule. The caller fills child[] and rules[], and pushes or
 * drops it. NULL: the error is set. */
vs_rule_task *vs_task_new(vs_derivation *d, uint32_t count, bool many);
void vs_task_drop(vs_derivation *d, vs_rule_task *t);
/* Pushes t. Returns false with t dropped and the error set. */
bool vs_task_push(vs_derivation *d, vs_rule_task *t);
/* Returns a scope of class c as child index of count of the operator op, with path, depth and flags set. NULL with the
 * error set: memory is out, or the path is too long. */
vs_scope *vs_rules_child(vs_derivation *d, vs_scope *parent, vs_scope_class c, const char *op, uint32_t index,
                         uint32_t count);
/* Adds an object, made in a scope with these flags. Returns false with the error set. */
bool vs_rules_gather(vs_derivation *d, vs_ref ref, vs_scope_flags *flags);
/* Returns true if argument i is of one of these classes, the bits of VS_SCOPE_BIT; otherwise sets the error. */
bool vs_rules_class(vs_args *f, int i, unsigned classes);
const char *vs_rules_operator(vs_args *f); /* returns its name in a path: that of the procedure without "scope-" */

#endif
