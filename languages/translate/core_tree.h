/* Owns the lowered tree of a translation: a program in a few kinds of node that every target language can say,
 * each with the place of the text that it comes from.
 *
 * Forms of the language keep their shape (a map stays a map, a let stays a let); the program's own macros are expanded.
 * A node's children come after it in the array, so that a loop downwards over the array meets children first.
 *
 *   NAME       a variable
 *   PRIMITIVE  a name of the language with its arguments: `text` is its name; KEYWORD children stand last
 *   CALL       the procedure, then its arguments; ABSENT where a parameter keeps its default
 *   PROCEDURE  PARAMETER children (one child: its default), then the body
 *   BODY       DEFINE children and expressions; the last one is its value
 *   DEFINE     a variable, and the child that it stands for
 *   MAP        DEFINE children (a variable, and the list that it runs through), WHEN children (tests), then what
 *              is made
 *   IF         test, then, and perhaps else */
#ifndef VS_LANGUAGES_TRANSLATE_CORE_TREE_H
#define VS_LANGUAGES_TRANSLATE_CORE_TREE_H

#include "languages/analysis/analysis.h"

typedef uint32_t tr_index; /* 0: none */

typedef enum {
  TR_NOTHING, TR_NUMBER, TR_STRING, TR_BOOLEAN, TR_NAME, TR_PRIMITIVE, TR_CALL, TR_PROCEDURE, TR_PARAMETER, TR_BODY,
  TR_DEFINE, TR_IF, TR_AND, TR_OR, TR_LIST, TR_MAP, TR_WHEN, TR_SET, TR_ABSENT, TR_KEYWORD
} tr_node_kind;

/* The kind of a value, as far as the text says; plus TR_LIST_OF times how deep the list is. Lists of solids are solids,
 * as wherever the language takes an object. */
typedef enum {
  TR_UNKNOWN, TR_A_NUMBER, TR_A_BOOLEAN, TR_A_STRING, TR_A_POINT, TR_A_CURVE, TR_A_SOLID, TR_A_PROCEDURE, TR_A_MATERIAL,
  TR_A_PATH, TR_ANYTHING, TR_LIST_OF = 16, TR_DEEPEST = 8
} tr_type;

typedef struct {
  uint8_t kind, type;
  bool draws;         /* something in it adds to the drawing when it is evaluated */
  bool parallel;      /* MAP: its lists run side by side; else each runs within the one before */
  bool effect;        /* MAP: for-each */
  bool rest;          /* PARAMETER: gathers what is left */
  bool yes;           /* BOOLEAN */
  bool plain;         /* BODY: the file's; its children stand at top level */
  tr_index parent, first, last, next;
  uint32_t count;
  know_index source;  /* of the text, or a macro's */
  tr_index variable;  /* NAME DEFINE PARAMETER SET */
  tr_index procedure; /* the PROCEDURE around it that becomes one of its own in the target; 0: top level */
  uint8_t colour;     /* 1: said as a colour, 2: a list of colours, and so on; 0: neither (colour_flow.h) */
  uint16_t row;       /* PRIMITIVE: the row of translated_words.def that fits, counted from 1 */
  const char *text;
} tr_node;

typedef struct {
  const char *text;   /* as the program says */
  const char *name;   /* as the target says */
  know_index symbol;  /* 0: of the translation's own */
  uint8_t type, gives; /* gives: what a procedure's calls give */
  uint8_t colour;     /* as of nodes */
  bool global, set, handed; /* handed: used otherwise than in calls */
  bool recursive, draws, loops; /* loops: JavaScript says it as a loop */
  bool lifted;        /* a local name that becomes a definition at top level */
  bool module;        /* stands for a solid, or makes one */
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
  tr_index *pairs; size_t pair_count, pair_room; /* procedure, variable: what a lifted procedure gets besides */
  tr_index root;      /* BODY */
  bool draws;         /* the program calls draw somewhere */
} translation;

enum { TR_MOST_COMPLAINTS = 100 };

/* A new last child of parent; 0 with trouble. Arrays move. */
tr_index tr_node_new(translation *t, tr_index parent, tr_node_kind kind, know_index source);
tr_index tr_variable_new(translation *t, const char *text);
tr_index tr_nth(const translation *t, tr_index node, uint32_t nth);
/* A copy of what stands at `from`, without its place among siblings, over `to`; its children move along. */
void tr_move(translation *t, tr_index from, tr_index to);
/* The parts that cannot go over: kept with its place, in the order of the text, once. False, for returning. */
bool tr_complain(translation *t, tr_index node, const char *format, ...) __attribute__((format(printf, 3, 4)));
bool tr_complain_at(translation *t, know_index source, const char *format, ...) __attribute__((format(printf, 3, 4)));
static inline const tr_node *tr_at(const translation *t, tr_index node) { return &t->nodes[node]; }

#endif
