/* Declares the description of a target language. */
#ifndef VS_LANGUAGES_TRANSLATE_TARGET_H
#define VS_LANGUAGES_TRANSLATE_TARGET_H

#include <stdbool.h>
#include <stdint.h>

typedef struct tr_writer tr_writer;
typedef enum {
  TR_LIFTS_NOTHING,
  TR_LIFTS_SOLIDS, /* moves only local definitions that make solids, or that call themselves, to top level */
  TR_LIFTS_PROCEDURES
} tr_lifts;
typedef struct tr_target {
  const char *name, *title; /* name: name of the language for the option --to. title: its name in messages */
  const char *ending;       /* suffix of files in the target language */
  uint8_t lifts;            /* which local definitions move to top level (TR_LIFTS_...) */
  bool assigns;             /* whether variables can be set after their definition */
  bool helpers_first;       /* whether the helpers that the program uses must precede the program */
  const char *key;          /* text between a keyword and its value in a call; "": there are no keywords */
  const char *x, *y, *z;    /* the coordinate axes as vectors */
  const char *together;     /* text before the braces around several solids that form a single object */
  bool capitals;            /* whether names begin with capital letters, unlike every word of the language */
  bool ascii;               /* whether characters outside ASCII are written as \uXXXX in texts */
  const char *comment;      /* text that begins a comment line */
  const char *reserved;     /* reserved words, each between blanks */
  void (*program)(tr_writer *w);
  void (*script)(tr_writer *w); /* writes a program that is a script (JavaScript); NULL: scripts are written like other
                                 * programs */
  uint8_t column;           /* column of translated_words.def with the words of this target */
} tr_target;

#endif
