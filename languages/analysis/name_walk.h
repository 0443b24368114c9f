/* Owns the scopes of the walk through a program, and what the forms do with the names in them. */
#ifndef VS_LANGUAGES_ANALYSIS_NAME_WALK_H
#define VS_LANGUAGES_ANALYSIS_NAME_WALK_H

#include "languages/analysis/analysis.h"

typedef enum { KNOW_TASK_EXPRESSION, KNOW_TASK_BODY } know_task_kind;
typedef struct { know_index node, scope; uint8_t kind; } know_task;

typedef struct {
  knowledge *k;
  know_task *tasks; size_t task_count, task_room;
  know_task *later; size_t later_count, later_room;       /* of the form at work, in order */
  know_task *unknown; size_t unknown_count, unknown_room; /* names that nothing defined so far */
  size_t made;                                            /* nodes by macros */
  bool imported;                                          /* the program began with an import */
  bool begun;
} know_walk;

enum { KNOW_LANGUAGE = 1, KNOW_PROGRAM = 2 }; /* the first two scopes */

void know_later(know_walk *w, know_task_kind kind, know_index node, know_index scope);
/* The node and those behind it as expressions. */
void know_later_each(know_walk *w, know_index first, know_index scope);
/* The forms from `first` on as a body in a scope of its own, if they define anything. */
void know_later_body(know_walk *w, know_index first, know_index scope);
/* Binds the name at the node; 0: it is no name. A second definition in one scope is the first's symbol. */
know_index know_bind(know_walk *w, know_index node, know_index scope, know_symbol_kind kind, know_index form);
/* A parameter list, of count elements from `first` on, or a lone name: binds its names in scope, contracts are worked
 * out in `outside`. rest: the node itself is a name for all. Sets the arity. */
void know_bind_parameters(know_walk *w, know_index list, know_index first, know_index scope, know_index outside,
    know_index owner,
                          know_arity *arity);
/* Marks a tree as data. */
void know_mark_data(knowledge *k, know_index node, know_role role);
void know_mark(knowledge *k, know_index node, know_role role, know_index symbol, know_index scope);
/* The meaning of the identifier at the node in scope: a symbol; 0: nothing. Asks the language. */
know_index know_find(know_walk *w, know_index name, know_index scope);
/* A name where its value is used. */
void know_refer(know_walk *w, know_index node, know_index scope, know_role role, bool called);
/* Reads the file that the string at node names, and leaves its forms for later as a body of scope. */
void know_load(know_walk *w, know_index node, know_index scope);
/* Calls each(k, node, context) for the node and all below it. */
void know_each_in(knowledge *k, know_index root, void (*each)(knowledge *k, know_index node, void *context),
                  void *context);
know_index know_file_named(know_walk *w, know_index node); /* the file that the string names; UINT32_MAX: none */
know_index know_written(const knowledge *k, know_index node); /* the node of the text that a macro's copy stands for */

#endif
