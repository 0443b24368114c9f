/* Owns the lowered tree of a translation: a program in a few kinds of node that every target language can express, each
 * with its place in the text.
 *
 * Forms of the language keep their shape (a map stays a map, a let stays a let); the program's own macros are expanded.
 * A node's children come after it in the array, so a loop downwards over the array meets children first.
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

typedef uint32_t tr_index; /* 0: none */

typedef enum {
  TR_NOTHING, TR_NUMBER, TR_STRING, TR_BOOLEAN, TR_NAME, TR_PRIMITIVE, TR_CALL, TR_PROCEDURE, TR_PARAMETER, TR_BODY,
  TR_DEFINE, TR_IF, TR_AND, TR_OR, TR_LIST, TR_MAP, TR_WHEN, TR_SET, TR_ABSENT, TR_KEYWORD
} tr_node_kind;

/* The kind of a value, as far as the text determines it, plus TR_LIST_OF times the depth of the list. Lists of solids
 * are solids, since the language takes lists for objects. */
typedef enum {
  TR_UNKNOWN, TR_A_NUMBER, TR_A_BOOLEAN, TR_A_STRING, TR_A_POINT, TR_A_CURVE, TR_A_SOLID, TR_A_PROCEDURE, TR_A_MATERIAL,
  TR_A_PATH, TR_ANYTHING, TR_LIST_OF = 16, TR_DEEPEST = 8
} tr_type;

typedef struct {
  uint8_t kind, type;
  bool draws;         /* its evaluation adds to the drawing */
  bool parallel;      /* MAP: its lists run side by side; else each runs within the one before */
  bool effect;        /* MAP: for-each */
  bool rest;          /* PARAMETER: takes the remaining arguments */
  bool yes;           /* BOOLEAN */
  bool plain;         /* BODY: the file's; its children are at top level */
  tr_index parent, first, last, next;
  uint32_t count;
  know_index source;  /* of the text, or of a macro */
  tr_index variable;  /* NAME DEFINE PARAMETER SET */
  tr_index procedure; /* the PROCEDURE around it that becomes a separate one in the target; 0: top level */
  uint8_t colour;     /* 1: used as a colour, 2: a list of colours, and so on; 0: neither (colour_flow.h) */
  uint16_t row;       /* PRIMITIVE: its row of translated_words.def, counted from 1 */
  const char *text;
} tr_node;

typedef struct {
  const char *text;   /* in the program */
  const char *name;   /* in the target */
  know_index symbol;  /* 0: made by the translation */
  uint8_t type, gives; /* gives: the type of a procedure's calls */
  uint8_t colour;     /* as for nodes */
  bool global, set, handed; /* handed: used other than in calls */
  bool recursive, draws, loops; /* loops: JavaScript writes it as a loop */
  bool lifted;        /* a local name that becomes a definition at top level */
  bool module;        /* refers to a solid, or makes one */
  bool model_parameter;
  tr_index define;    /* DEFINE or PARAMETER */
  tr_index procedure; /* the PROCEDURE that it names; 0: none, or not known */
  tr_index owner;     /* the PROCEDURE that binds it; 0: top level */
} tr_variable;

typedef struct { know_place at; const char *text; } tr_complaint;

typedef struct {
  knowledge *k;
  const struct tr_target *target;
  const know_setting *settings; size_t setting_count;
  tr_node *nodes; size_t node_count, node_room;
  tr_variable *variables; size_t variable_count, variable_room;
  tr_complaint *complaints; size_t complaint_count, complaint_room;
  tr_index *pairs; size_t pair_count, pair_room; /* procedure, variable: the additional arguments of a lifted
                                                  * procedure */
  tr_index root;      /* BODY */
  bool draws;         /* the program calls draw somewhere */
} translation;

enum { TR_MOST_COMPLAINTS = 100 };

/* Appends a new child to parent; returns 0 on trouble. Arrays move. */
tr_index tr_node_new(translation *t, tr_index parent, tr_node_kind kind, know_index source);
tr_index tr_variable_new(translation *t, const char *text);
tr_index tr_nth(const translation *t, tr_index node, uint32_t nth);
/* Copies the node `from` over `to`, without its place among siblings; its children move along. */
void tr_move(translation *t, tr_index from, tr_index to);
/* Records a part that the target cannot express, with its place, in the order of the text, once. Returns false, for the
 * caller to return. */
bool tr_complain(translation *t, tr_index node, const char *format, ...) __attribute__((format(printf, 3, 4)));
bool tr_complain_at(translation *t, know_index source, const char *format, ...) __attribute__((format(printf, 3, 4)));
static inline const tr_node *tr_at(const translation *t, tr_index node) { return &t->nodes[node]; }

#endif
