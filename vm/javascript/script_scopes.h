/* Declares facts about a script that its translation needs: scopes, variables, and the targets of jumps.
 *
 * There is a scope for the program, each function, the name of each function expression, and each catch. */
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
  uint32_t scope, name, next; /* scope: number of the scope; name: number of the name; next: number of the scope's next
                               * variable, in the order of the text */
  uint32_t declaration;       /* for functions: the node of the function's declaration in the script's tree */
  uint8_t kind;
  bool elsewhere; /* whether a script that ran before has declared the variable */
  bool assigned;  /* whether the variable is assigned after its declaration */
} vs_variable;

typedef struct {
  uint32_t parent, node, first, last;
  bool uses_this, uses_arguments;
} vs_scope_of_script;

/* Flags of a node of the script's tree. */
enum {
  VS_JUMPS_OUT = 1, /* a return, break or continue inside the statement leaves the statement */
  VS_STAYS = 2,     /* the end of the statement is never reached */
  VS_BROKEN = 4,    /* a loop, switch or label that a break leaves */
  VS_CONTINUED = 8  /* a loop in which there is a continue */
};

typedef struct {
  vs_script *s;
  vs_variable *variables;
  size_t variable_count, variable_room; /* number of variables, counting variable 0, which is not used */
  vs_scope_of_script *scopes;
  size_t scope_count, scope_room; /* number of scopes, counting scope 0, which is not used; scope 1 is that of the
                                   * program */
  uint32_t *table;
  size_t slots;      /* number of entries of the hash table from scope and name to variable */
  uint8_t *facts;    /* facts[n]: flags of node n of the script's tree */
  uint32_t *targets; /* targets[node]: for BREAK and CONTINUE the statement to which the jump refers; for FUNCTION and
                      * TRY the number of the scope */
  size_t room;
} vs_scopes;

/* Finds the scopes of s. If the script has a mistake, sets it in s and returns false; also returns false when memory is
 * out. Call vs_scopes_close in each case. */
bool vs_scopes_find(vs_scopes *k, vs_script *s);
void vs_scopes_close(vs_scopes *k);
/* Returns the variable that the name means in the scope, or 0 if it is not declared. */
uint32_t vs_scopes_resolve(const vs_scopes *k, uint32_t scope, uint32_t name);

#endif
