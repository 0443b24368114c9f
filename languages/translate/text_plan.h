/* Declares the writing of the target's text. A stack of pieces that are still to be written lets programs nest to any
 * depth. The pieces of a node are planned in reading order, and written before any piece that was planned earlier.
 *
 * In formats: %s text; %v a node's value; %t the value as an operand; %b a test; %o a node as one statement; %l as
 * statements, each on its own line; %d as statements that draw; %n a new line; %> and %< indent more and less; %_ a
 * blank at which a line may break; %% a percent sign. */
#ifndef VS_LANGUAGES_TRANSLATE_TEXT_PLAN_H
#define VS_LANGUAGES_TRANSLATE_TEXT_PLAN_H

#include "languages/translate/core_tree.h"
#include "languages/translate/target.h"

typedef enum { TR_PIECE_TEXT, TR_PIECE_VALUE, TR_PIECE_TEST, TR_PIECE_SINGLE, TR_PIECE_STATEMENTS, TR_PIECE_DRAW,
  TR_PIECE_LINE, TR_PIECE_IN, TR_PIECE_OUT, TR_PIECE_SOFT, TR_PIECE_BEHIND, TR_PIECE_COMMENTS } tr_piece_kind;
typedef struct { uint8_t kind, level; tr_index node; const char *text; } tr_piece;

/* The precedences of operators, from the lowest. An operator inside an operand that requires a higher precedence gets
 * parentheses. */
enum { TR_LOOSE = 0, TR_CHOICE = 1, TR_EITHER = 2, TR_BOTH = 3, TR_EQUAL = 4, TR_ORDER = 5, TR_SUM = 6, TR_PRODUCT = 7,
  TR_SIGN = 8, TR_TIGHT = 9,
  TR_AS_LIST = 10 /* a special precedence: writes the arguments of a primitive as a list of outlines (to_povray.c) */ };

struct tr_writer {
  translation *t;
  const tr_target *target;
  tr_piece *pieces; size_t piece_count, piece_room;
  tr_piece *plan; size_t plan_count, plan_room;  /* planned pieces of the current node */
  char *out; size_t out_count, out_room;
  uint32_t indent, column;
  know_index comment;  /* next comment of the current file that was not written yet */
  uint32_t segments;
  void (*emit)(tr_writer *w, const tr_piece *piece); /* function of the target that plans the pieces of which a piece
                                                      * with a node consists */
};

void tr_plan(tr_writer *w, const char *format, ...);
/* Plans the value of the node. If it is an operator of lower precedence than `level`, it gets parentheses. */
void tr_plan_value(tr_writer *w, tr_index node, int level);
/* Plans the text between quotes, with backslashes where the target needs them. */
void tr_plan_quoted(tr_writer *w, const char *text);
/* Plans a comment up to the end of the line. The text may contain any characters. */
void tr_plan_comment(tr_writer *w, const char *text);
/* Plans a number. A fraction or a negative number gets parentheses if the precedence `level` requires them. */
void tr_plan_number(tr_writer *w, const char *text, int level);
/* Writes all planned pieces. */
void tr_write_planned(tr_writer *w);
/* Writes all planned pieces of a statement, whose text begins at out[before], and then the comment that follows the
 * form `source` on its line. */
void tr_write_statement(tr_writer *w, size_t before, know_index source);
void tr_put(tr_writer *w, const char *text, size_t length);

/* Plans a primitive by the text of its row, in which these signs are replaced: $1, %1 and #1 a value (loose, as a
 * single operand, at the row's precedence), $* all values, $n their number, $l all as a list of outlines, $[key|0] a
 * keyword's value, or else 0, ~1 an angle in degrees, $k keywords, @1 a solid, @2+ the solids from the second on as one
 * statement, @*1 those from the first on, each by itself, within braces. "7:..." gives the precedence; "=6 + " is an
 * operator. */
void tr_plan_row(tr_writer *w, tr_index primitive, int level);
/* Returns true if the row's text contains a block of statements. */
bool tr_row_has_block(const char *text);

/* Writes an empty line if the program's text has an empty line before the form and its comments. */
void tr_gap_before(tr_writer *w, know_index source);
/* tr_comments_before writes the comments that precede the form in the text, each on its own line. tr_comment_behind
 * writes the comment that follows it on its line. */
void tr_comments_before(tr_writer *w, know_index source);
void tr_comment_behind(tr_writer *w, know_index source);
/* Writes the comments that precede the node (or its end, if `end`) in the text, each on its own line inside a block. */
void tr_comments_inside(tr_writer *w, know_index source, bool end);
/* Plans the comments of a node as a piece that follows the pieces planned before. kind: TR_PIECE_BEHIND or
 * TR_PIECE_COMMENTS. */
void tr_plan_comments(tr_writer *w, tr_index node, tr_piece_kind kind, bool end);
/* Plans the node by a format that contains it once, together with the comments that precede and follow it in the
 * text. */
void tr_plan_commented(tr_writer *w, const char *format, tr_index node);

/* Translates the program. Returns the text, which the caller frees. Returns NULL on failure, or if there are parts that
 * the target cannot express. */
char *tr_write_program(translation *t, uint32_t segments, size_t *length);

#endif
