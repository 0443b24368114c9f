/* Declares the scopes of the walk through a program, for the forms of the language that change scopes. */
#ifndef VS_LANGUAGES_ANALYSIS_NAME_WALK_H
#define VS_LANGUAGES_ANALYSIS_NAME_WALK_H

#include "languages/analysis/analysis.h"

typedef enum { KNOW_TASK_EXPRESSION, KNOW_TASK_BODY } know_task_kind;
typedef struct { know_index node, scope; uint8_t kind; } know_task;

typedef struct {
  knowledge *k;
  know_task *tasks; size_t task_count, task_room;
  know_task *later; size_t later_count, later_room;       /* tasks that the current form has deferred, in order */
  know_task *unknown; size_t unknown_count, unknown_room; /* names whose definition has not been found yet */
  size_t made;                                            /* number of nodes that macros have made */
  bool imported;                                          /* whether the program begins with an import */
  bool begun;
} know_walk;

enum { KNOW_LANGUAGE = 1, KNOW_PROGRAM = 2 }; /* indices of the first two scopes */

void know_later(know_walk *w, know_task_kind kind, know_index node, know_index scope);
/* Defers the node and the nodes after it in its list, as expressions. */
void know_later_each(know_walk *w, know_index first, know_index scope);
/* Defers the forms from `first` on as a body. The body gets a new scope if its forms define names. */
void know_later_body(know_walk *w, know_index first, know_index scope);
/* Binds the name at the node in the scope, and returns its symbol. Returns 0 if the node is not a name. A second
 * definition of a name in a scope returns the symbol of the first. */
know_index know_bind(know_walk *w, know_index node, know_index scope, know_symbol_kind kind, know_index form);
/* A parameter list. list: its node, which is a list, or a single name for all arguments. first: node of its first
 * parameter. scope: scope of the names. outside: scope of the contracts. owner: symbol of the procedure, or 0. */
typedef struct { know_index list, first, scope, outside, owner; } know_parameters;
/* Binds the names of a parameter list, walks its contracts, and sets *arity, the numbers of arguments. */
void know_bind_parameters(know_walk *w, const know_parameters *p, know_arity *arity);
/* Marks a node and all nodes below it as data. */
void know_mark_data(knowledge *k, know_index node, know_role role);
void know_mark(knowledge *k, know_index node, know_role role, know_index symbol, know_index scope);
/* Returns the symbol to which the identifier refers in the scope, including symbols of the language, or 0 if there is
 * none. */
know_index know_find(know_walk *w, know_index name, know_index scope);
/* Marks the node as a name whose value is used. called: the name is the procedure of a call. */
void know_refer(know_walk *w, know_index node, know_index scope, know_role role, bool called);
/* Reads the file to which the string at the node refers, and defers its forms as a body of the scope. */
void know_load(know_walk *w, know_index node, know_index scope);
/* Calls each(k, node, context) for the node and for all nodes below it. */
void know_each_in(knowledge *k, know_index root, void (*each)(knowledge *k, know_index node, void *context),
                  void *context);
know_index know_file_named(know_walk *w, know_index node); /* Returns the index of the file to which the string at the
                                                            * node refers; UINT32_MAX: there is no such file. */
know_index know_written(const knowledge *k, know_index node); /* If a macro has made the node by copying, returns the
                                                               * node of the text from which it was copied; otherwise
                                                               * returns the node. */

#endif
