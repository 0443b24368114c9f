/* Owns the output of the translation of a script: data of the language in the order of their text, each with its place.
 *
 * Words of the language and of its run-time library (library/javascript/runtime.sld) begin with js: , and names that
 * the translation makes contain a colon, too. Names of the script never do, so all are distinct. */
#ifndef VS_VM_JAVASCRIPT_TRANSLATION_H
#define VS_VM_JAVASCRIPT_TRANSLATION_H

#include "vm/javascript/script_scopes.h"

typedef enum {
  VS_ITEM_OPEN,
  VS_ITEM_CLOSE,
  VS_ITEM_WORD,   /* a word of the translation */
  VS_ITEM_NAME,   /* a name of the script */
  VS_ITEM_DIRECT, /* the same with a colon behind it: the procedure of a function */
  VS_ITEM_MADE,   /* word:number */
  VS_ITEM_KEY,    /* a text of the script as a symbol */
  VS_ITEM_NUMBER,
  VS_ITEM_COUNT,
  VS_ITEM_STRING,
  VS_ITEM_NATIVE /* text of the language itself: any number of data */
} vs_item_kind;

typedef struct {
  uint8_t kind;
  uint32_t line, column;
  const char *word;
  uint32_t a, b;  /* NAME, DIRECT: a; MADE, COUNT: a; KEY, STRING, NATIVE: text and length */
  uint32_t scope; /* NATIVE: the scope of its place */
  double number;
} vs_item;

/* The destination of control at a statement's end. */
typedef enum {
  VS_THEN_NOTHING,    /* none: the value is not used */
  VS_THEN_END,        /* the end of the function */
  VS_THEN_MADE,       /* the procedure word:number */
  VS_THEN_STATEMENTS, /* the statements from `node` up to `stop`, and then on */
  VS_THEN_LOOP,       /* the next turn of the loop `node`, with that number */
  VS_THEN_OUTCOME     /* after the finally of `target`: the destination of the part that ended */
} vs_then_kind;

typedef struct vs_then {
  vs_then_kind kind;
  const char *word;
  uint32_t number, node, stop;
  struct vs_jump_target *target;
  const struct vs_then *on;
} vs_then;

/* A statement that jumps enter or leave. A try: every jump out of its parts has a number. */
typedef struct vs_jump_target {
  struct vs_jump_target *up;
  uint32_t node;
  vs_then broken, continued;
  bool guard;
  uint32_t *exits;
  size_t exit_count, exit_room; /* jump nodes, 0 for a return: number i + 1 */
  uint32_t number;
} vs_jump_target;

typedef struct {
  vs_script *s;
  vs_scopes *k;
  vs_item *items;
  size_t count, room;
  uint32_t line; /* number of lines before the text */
  uint32_t scope, numbers;
  unsigned depth, functions; /* around the place */
  vs_script_place at;
  vs_jump_target *targets;
} vs_translation;

typedef enum { VS_TYPE_ANY, VS_TYPE_NUMBER, VS_TYPE_STRING, VS_TYPE_BOOLEAN } vs_static_type;

bool vs_translate_open(vs_translation *t);
bool vs_translate_close(vs_translation *t);
bool vs_translate_word(vs_translation *t, const char *word);
bool vs_translate_call(vs_translation *t, const char *word); /* ( and the word */
bool vs_translate_name(vs_translation *t, uint32_t name);
bool vs_translate_direct(vs_translation *t, uint32_t name);
bool vs_translate_made(vs_translation *t, const char *word, uint32_t number);
bool vs_translate_key(vs_translation *t, uint32_t node);  /* (js:quote key): NAME, STRING or NUMBER */
bool vs_translate_text(vs_translation *t, uint32_t name); /* the name as a string */
/* Returns the form for a parameter of the model that a call of gui_number or the like makes; NULL: another name. */
const char *vs_translate_parameter_word(const vs_translation *t, uint32_t name);
bool vs_translate_item(vs_translation *t, vs_item item);

#endif
