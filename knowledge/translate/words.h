/* Owns the target languages, and the tables of what the language's names are called in them. */
#ifndef VS_KNOWLEDGE_TRANSLATE_WORDS_H
#define VS_KNOWLEDGE_TRANSLATE_WORDS_H

#include "knowledge/translate/core_tree.h"

typedef struct tr_writer tr_writer;
typedef enum {
  TR_LIFTS_NOTHING,
  TR_LIFTS_SOLIDS, /* what makes solids, or calls itself */
  TR_LIFTS_PROCEDURES
} tr_lifts;
typedef struct tr_target {
  const char *name, *title; /* as --to says, and as people do */
  const char *ending;       /* of its files */
  uint8_t lifts;            /* what of local definitions goes to top level */
  bool assigns;             /* variables can be set */
  bool helpers_first;       /* what the program needs besides must stand before it */
  const char *key;          /* what stands between a keyword and its value */
  const char *x, *y, *z;    /* the axes as vectors */
  const char *together;     /* what stands before the braces around several solids */
  bool capitals;            /* names begin with capital letters, which no word of the language does */
  const char *comment;      /* what begins a line of comment */
  const char *reserved;     /* words that no name may be, each between blanks */
  void (*program)(tr_writer *w);
} tr_target;

/* NULL: there is none of that name, or ending. */
const tr_target *tr_target_named(const char *name);
const tr_target *tr_target_of_file(const char *path);
/* The word that (native 'word ...) has for the target. */
const char *tr_target_native(const tr_target *target);

typedef struct { const char *name, *arguments, *result, *keys, *text; } tr_word;

/* The first row of the primitive behind `row` (0: from the start) that fits its arguments as far as they are known, 1
 * and more; 0: there is none. */
uint16_t tr_word_find(const translation *t, tr_index primitive, uint16_t row);
/* A row's text is the target's; NULL where the target has nothing for it. */
tr_word tr_word_row(const tr_target *target, uint16_t row);
/* The next row of the name behind `row` (0: the first), 0: no more. */
uint16_t tr_word_next(const char *name, uint16_t row);
/* How many arguments a value of that name takes, -1: it is no procedure. */
int tr_word_arguments(const tr_target *target, const char *name);
/* The kind that the row asks of its nth argument, counted from 0; 0: it takes no such argument. */
char tr_word_letter(const char *arguments, uint32_t nth);

/* Definitions in the target language that translated programs use, in the order of their table. NULL past the last. */
const char *tr_helper_name(const tr_target *target, size_t nth);
const char *tr_helper_text(const tr_target *target, size_t nth);

#endif
