/* Owns the making of the target's text: a stack of pieces still to be written, so that no depth of a program is too
 * deep. The text of a node is planned in reading order and done before anything that was planned earlier.
 *
 * In formats: %s text; %v a node's value; %t the same where it must hold together; %b a test; %o a node as one
 * statement; %l as statements, each on a line of its own; %d as statements that draw; %n a new line; %> and %< a line
 * further in and out; %_ a blank where a line may break; %% itself. */
#ifndef VS_LANGUAGES_TRANSLATE_TEXT_PLAN_H
#define VS_LANGUAGES_TRANSLATE_TEXT_PLAN_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef enum { TR_PIECE_TEXT, TR_PIECE_VALUE, TR_PIECE_TEST, TR_PIECE_SINGLE, TR_PIECE_STATEMENTS, TR_PIECE_DRAW,
  TR_PIECE_LINE, TR_PIECE_IN, TR_PIECE_OUT, TR_PIECE_SOFT, TR_PIECE_BEHIND, TR_PIECE_COMMENTS } tr_piece_kind;
typedef struct { uint8_t kind, level; tr_index node; const char *text; } tr_piece;

/* How strongly operators hold their operands; what holds less than is asked for goes into parentheses. */
enum { TR_LOOSE = 0, TR_CHOICE = 1, TR_EITHER = 2, TR_BOTH = 3, TR_EQUAL = 4, TR_ORDER = 5, TR_SUM = 6, TR_PRODUCT = 7,
  TR_SIGN = 8, TR_TIGHT = 9,
  TR_AS_LIST = 10 /* the arguments of a primitive, as a list of outlines (to_povray.c) */ };

struct tr_writer {
  translation *t;
  const tr_target *target;
  tr_piece *pieces; size_t piece_count, piece_room;
  tr_piece *plan; size_t plan_count, plan_room;  /* of the node at work */
  char *out; size_t out_count, out_room;
  uint32_t indent, column;
  know_index comment;  /* the next comment of the file at work */
  uint32_t segments;
  void (*emit)(tr_writer *w, const tr_piece *piece); /* plans a piece that has a node */
};

void tr_plan(tr_writer *w, const char *format, ...);
/* A value that holds its parts together with at least that level. */
void tr_plan_value(tr_writer *w, tr_index node, int level);
/* The text in quotes, with what the target must not read as it stands escaped by backslashes. */
void tr_plan_quoted(tr_writer *w, const char *text);
/* A comment up to the end of the line, whatever the text holds. */
void tr_plan_comment(tr_writer *w, const char *text);
/* A number; a fraction or one below zero stands in parentheses where it must hold together. */
void tr_plan_number(tr_writer *w, const char *text, int level);
/* Does all that is planned. */
void tr_write_planned(tr_writer *w);
/* Does all that is planned of a statement of the program, whose text begins at out[before]; its comment on the same
 * line comes behind it. */
void tr_write_statement(tr_writer *w, size_t before, know_index source);
void tr_put(tr_writer *w, const char *text, size_t length);

/* The row's text with the primitive's arguments: $1, %1 and #1 a value (loose, tight, as tight as the row),
 * $* all values, $n how many, $l all as a list of outlines, $[key|0] what a
 * keyword gives, or else 0, ~1 an angle in degrees, $k keywords, @1 a solid, @2+ the solids from the second on as
 * one statement, @*1 those from the first on each by itself, within braces. "7:..." says how strongly it holds;
 * "=6 + " is an operator. */
void tr_plan_row(tr_writer *w, tr_index primitive, int level);
/* How strongly the row holds its parts together. */
bool tr_row_has_block(const char *text);

/* An empty line where the text has one before the form and its comments. */
void tr_gap_before(tr_writer *w, know_index source);
/* The comments of the text before the place, each on its line; and one behind it on the same line. */
void tr_comments_before(tr_writer *w, know_index source);
void tr_comment_behind(tr_writer *w, know_index source);
/* The comments before the node, or its end, each on a line of its own within a block. */
void tr_comments_inside(tr_writer *w, know_index source, bool end);
/* The same when the pieces planned before are done: TR_PIECE_BEHIND or TR_PIECE_COMMENTS. */
void tr_plan_comments(tr_writer *w, tr_index node, tr_piece_kind kind, bool end);

/* Translates the program. The text belongs to the caller (free). NULL: trouble, or complaints. */
char *tr_write_program(translation *t, uint32_t segments, size_t *length);

#endif
