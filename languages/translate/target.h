/* Owns the form of a target language. */
#ifndef VS_LANGUAGES_TRANSLATE_TARGET_H
#define VS_LANGUAGES_TRANSLATE_TARGET_H

#include <stdbool.h>
#include <stdint.h>

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
  bool ascii;               /* in texts, characters beyond ASCII are written as \uXXXX */
  const char *comment;      /* what begins a line of comment */
  const char *reserved;     /* words that no name may be, each between blanks */
  void (*program)(tr_writer *w);
  void (*script)(tr_writer *w); /* a program that is a script, NULL: as any other */
  uint8_t column;           /* of translated_words.def */
} tr_target;

#endif
