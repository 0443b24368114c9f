/* Declares the description of a target language. */
#ifndef VS_LANGUAGES_TRANSLATE_TARGET_H
#define VS_LANGUAGES_TRANSLATE_TARGET_H

#include <stdbool.h>
#include <stdint.h>

typedef struct tr_writer tr_writer;
typedef enum {
  TR_LIFTS_NOTHING,
  TR_LIFTS_SOLIDS, /* lifts only definitions that make solids, or that call themselves */
  TR_LIFTS_PROCEDURES
} tr_lifts;
typedef struct tr_target {
  const char *name, *title; /* name: for --to. title: for messages */
  const char *ending;       /* suffix of files in the language */
  uint8_t lifts;            /* which local definitions move to top level (TR_LIFTS_...) */
  bool assigns;             /* whether variables can be set */
  bool helpers_first;       /* whether the helpers that the program uses must precede it */
  const char *key;          /* text between a keyword and its value */
  const char *x, *y, *z;    /* the coordinate axes as vectors */
  const char *together;     /* text before the braces around several solids */
  bool capitals;            /* whether names begin with capital letters, unlike every word of the language */
  bool ascii;               /* whether characters outside ASCII are written as \uXXXX in texts */
  const char *comment;      /* text that begins a comment line */
  const char *reserved;     /* reserved words, each between blanks */
  void (*program)(tr_writer *w);
  void (*script)(tr_writer *w); /* writes a program that is a script; NULL: scripts are written like other programs */
  uint8_t column;           /* column of translated_words.def */
} tr_target;

#endif
