/* Declares the lowered tree of a translation: a program in a few kinds of node that every target language can express,
 * each with its place in the text.
 *
 * Forms of the language keep their shape (a map stays a map, a let stays a let); the program's own macros are expanded.
 * A node's children come after it in the array, so a loop downwards over the array visits children first.
 *
 *   NAME       a variable
 *   PRIMITIVE  a name of the language with its arguments: `text` is its name; KEYWORD children come last
 *   CALL       the procedure, then its arguments; ABSENT for a parameter that keeps its default
 *   PROCEDURE  PARAMETER children (one child: its default), then the body
 *   BODY       DEFINE children and expressions; the last one is its value
 *   DEFINE     a variable, and its value as a child
 *   MAP        DEFINE children (a variable, and the list that it runs through), WHEN children (tests), then the
 *              element
 *   IF         test, then, and optionally else */
#ifndef VS_LANGUAGES_TRANSLATE_CORE_TREE_H
#define VS_LANGUAGES_TRANSLATE_CORE_TREE_H

#include "languages/analysis/analysis.h"

typedef uint32_t tr_index; /* index of a node or variable; 0: none */

typedef enum {
  TR_NOTHING, TR_NUMBER, TR_STRING, TR_BOOLEAN, TR_NAME, TR_PRIMITIVE, TR_CALL, TR_PROCEDURE, TR_PARAMETER, TR_BODY,
  TR_DEFINE, TR_IF, TR_AND, TR_OR, TR_LIST, TR_MAP, TR_WHEN, TR_SET, TR_ABSENT, TR_KEYWORD
} tr_node_kind;

/* The type of a value, as far as the text determines it, plus TR_LIST_OF times the depth of the list. A list of solids
 * has the type of a solid, because the language accepts lists as objects. */
typedef enum {
  TR_UNKNOWN, TR_A_NUMBER, TR_A_BOOLEAN, TR_A_STRING, TR_A_POINT, TR_A_CURVE, TR_A_SOLID, TR_A_PROCEDURE, TR_A_MATERIAL,
  TR_A_PATH, TR_ANYTHING, TR_LIST_OF = 16, TR_DEEPEST = 8
} tr_type;

typedef struct {
  uint8_t kind, type;
  bool draws;         /* whether the evaluation of the node adds to the drawing */
  bool parallel;      /* MAP: whether it advances through all its lists together; otherwise each list is a loop inside
                       * the loop of the list before it */
  bool effect;        /* MAP: whether it is a for-each */
  bool rest;          /* PARAMETER: whether it is a rest parameter, which receives the remaining arguments */
  bool yes;           /* BOOLEAN: its value */
  bool plain;         /* BODY: whether it is the body of the file, so that its children are at top level */
  tr_index parent, first, last, next;
  uint32_t count;
  know_index source;  /* node of the analysis from which this node was made */
  tr_index variable;  /* NAME, DEFINE, PARAMETER, SET: the variable */
  tr_index procedure; /* surrounding PROCEDURE that becomes a separate procedure in the target; 0: the node is at top
                       * level */
  uint8_t colour;     /* 1: used as a colour, 2: a list of colours, and so on; 0: not a colour (colour_flow.h) */
  uint16_t row;       /* PRIMITIVE: row of translated_words.def that translates it, counted from 1 */
  const char *text;
} tr_node;

typedef struct {
  const char *text;   /* name of the variable in the program */
  const char *name;   /* name of the variable in the target */
  know_index symbol;  /* symbol of the analysis; 0: the translation has made the variable */
  uint8_t type, gives; /* type: type of the variable's value. gives: if the value is a procedure, type of its results */
  uint8_t colour;     /* 1: the variable is a colour, 2: a list of colours, and so on; 0: not a colour
                       * (colour_flow.h) */
  bool global, set, handed; /* handed: whether the variable is used other than as the procedure of a call, so that its
                             * calls are not all known */
  bool recursive, draws, loops; /* loops: whether the output in JavaScript writes the procedure as a loop */
  bool lifted;        /* whether a local definition of the variable moves to top level */
  bool module;        /* whether the variable is a solid, or a procedure that makes a solid */
  bool model_parameter;
  tr_index define;    /* DEFINE or PARAMETER node of the variable */
  tr_index procedure; /* PROCEDURE that is the variable's value; 0: the value is no procedure, or is not known */
  tr_index owner;     /* PROCEDURE whose parameter or local variable it is; 0: top level */
} tr_variable;

typedef struct { know_place at; const char *text; } tr_complaint;

typedef struct {
  knowledge *k;
  const struct tr_target *target;
  const know_setting *settings; size_t setting_count;
  tr_node *nodes; size_t node_count, node_room;
  tr_variable *variables; size_t variable_count, variable_room;
  tr_complaint *complaints; size_t complaint_count, complaint_room;
  tr_index *pairs; size_t pair_count, pair_room; /* pairs of a procedure that moves to top level, and a variable that
                                                  * must be passed to it as an additional argument */
  tr_index root;      /* BODY of the program */
  bool draws;         /* whether the program calls draw */
} translation;

enum { TR_MOST_COMPLAINTS = 100 };

/* Appends a new child to the node `parent`, and returns its index. Returns 0 on failure. The array of nodes may be
 * reallocated. */
tr_index tr_node_new(translation *t, tr_index parent, tr_node_kind kind, know_index source);
tr_index tr_variable_new(translation *t, const char *text);
tr_index tr_nth(const translation *t, tr_index node, uint32_t nth);
/* Copies the node `from` over `to`, which keeps its place among its siblings. The children of `from` move to `to`. */
void tr_move(translation *t, tr_index from, tr_index to);
/* Records a complaint: a part of the program that the target cannot express, with its place. Complaints are in the
 * order of the text; a second equal one is not recorded. Always returns false, for the caller to return. */
bool tr_complain(translation *t, tr_index node, const char *format, ...) __attribute__((format(printf, 3, 4)));
bool tr_complain_at(translation *t, know_index source, const char *format, ...) __attribute__((format(printf, 3, 4)));
static inline const tr_node *tr_at(const translation *t, tr_index node) { return &t->nodes[node]; }

#endif
