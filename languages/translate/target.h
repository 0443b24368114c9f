/* Owns the description of a target language. */
#ifndef VS_LANGUAGES_TRANSLATE_TARGET_H
#define VS_LANGUAGES_TRANSLATE_TARGET_H

#include <stdbool.h>
#include <stdint.h>

typedef struct tr_writer tr_writer;
typedef enum {
  TR_LIFTS_NOTHING,
  TR_LIFTS_SOLIDS, /* definitions that make solids, or that call themselves */
  TR_LIFTS_PROCEDURES
} tr_lifts;
typedef struct tr_target {
  const char *name, *title; /* for --to; for messages */
  const char *ending;       /* of its files */
  uint8_t lifts;            /* the local definitions that move to top level */
  bool assigns;             /* variables can be set */
  bool helpers_first;       /* the program's helpers must precede it */
  const char *key;          /* the text between a keyword and its value */
  const char *x, *y, *z;    /* the axes as vectors */
  const char *together;     /* the text before the braces around several solids */
  bool capitals;            /* names begin with capital letters, unlike every word of the language */
  bool ascii;               /* in texts, characters beyond ASCII are written as \uXXXX */
  const char *comment;      /* the beginning of a comment line */
  const char *reserved;     /* reserved words, each between blanks */
  void (*program)(tr_writer *w);
  void (*script)(tr_writer *w); /* writes a program that is a script; NULL: as any other */
  uint8_t column;           /* of translated_words.def */
} tr_target;

#endif
