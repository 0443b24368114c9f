/* Owns the facts about a script that its translation needs: its scopes and variables, and the targets of its jumps.
 *
 * A scope is the program's, a function's, that of a function expression's own name, or a catch's. */
#ifndef VS_VM_JAVASCRIPT_SCRIPT_SCOPES_H
#define VS_VM_JAVASCRIPT_SCRIPT_SCOPES_H

#include "languages/javascript/script.h"

typedef enum {
  VS_VARIABLE_PARAMETER,
  VS_VARIABLE_VAR,
  VS_VARIABLE_FUNCTION,
  VS_VARIABLE_SELF,
  VS_VARIABLE_CATCH,
  VS_VARIABLE_UNDECLARED
} vs_variable_kind;

typedef struct {
  uint32_t scope, name, next; /* next: the next variable of the scope, in the order of the text */
  uint32_t declaration;       /* FUNCTION: the node */
  uint8_t kind;
  bool elsewhere; /* declared by a script that ran before */
  bool assigned;  /* assigned somewhere after its declaration */
} vs_variable;

typedef struct {
  uint32_t parent, node, first, last;
  bool uses_this, uses_arguments;
} vs_scope_of_script;

/* The facts known of a node. */
enum {
  VS_JUMPS_OUT = 1, /* a statement: a return, break or continue in it leaves it */
  VS_STAYS = 2,     /* its end is never reached */
  VS_BROKEN = 4,    /* a loop, switch or label: a break leaves it */
  VS_CONTINUED = 8  /* a loop: a continue belongs to it */
};

typedef struct {
  vs_script *s;
  vs_variable *variables;
  size_t variable_count, variable_room; /* 0: none */
  vs_scope_of_script *scopes;
  size_t scope_count, scope_room; /* 0: none, 1: the program's */
  uint32_t *table;
  size_t slots;      /* variables by scope and name */
  uint8_t *facts;    /* index: node */
  uint32_t *targets; /* index: node. BREAK and CONTINUE: their statement; FUNCTION and TRY: their scope */
  size_t room;
} vs_scopes;

/* Returns false with the mistake in s, or when memory is out. Call vs_scopes_close in each case. */
bool vs_scopes_find(vs_scopes *k, vs_script *s);
void vs_scopes_close(vs_scopes *k);
/* Returns the variable of the name in the scope, which is one of k's; 0: not declared. */
uint32_t vs_scopes_resolve(const vs_scopes *k, uint32_t scope, uint32_t name);

#endif
