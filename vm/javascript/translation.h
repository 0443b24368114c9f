/* Declares the result of translating a script: items, which are parts of Scheme data in the order of their text, each
 * with its place.
 *
 * Words of the language and of its run-time library (library/javascript/runtime.sld) begin with js: , and names that
 * the translation creates contain a colon, too. Names in scripts never contain a colon, so the two never collide. */
#ifndef VS_VM_JAVASCRIPT_TRANSLATION_H
#define VS_VM_JAVASCRIPT_TRANSLATION_H

#include "vm/javascript/script_scopes.h"

typedef enum {
  VS_ITEM_OPEN,
  VS_ITEM_CLOSE,
  VS_ITEM_WORD,   /* a word that the translation writes, such as js:get */
  VS_ITEM_NAME,   /* a name in the script */
  VS_ITEM_DIRECT, /* a name in the script, followed by a colon: the direct procedure of a function */
  VS_ITEM_MADE,   /* the symbol word:number, which the translation creates */
  VS_ITEM_KEY,    /* a part of the script's text, as a symbol */
  VS_ITEM_NUMBER,
  VS_ITEM_COUNT,
  VS_ITEM_STRING,
  VS_ITEM_NATIVE /* native text: any number of data in Scheme's notation */
} vs_item_kind;

typedef struct {
  uint8_t kind;
  uint32_t line, column;
  const char *word;
  uint32_t a, b;  /* a: the name for NAME and DIRECT, the number for MADE and COUNT, the offset of the text for KEY,
                   * STRING and NATIVE; b: the length of this text */
  uint32_t scope; /* NATIVE: scope of the script in which the native text is */
  double number;
} vs_item;

/* The place at which control continues after a statement of the script. */
typedef enum {
  VS_THEN_NOTHING,    /* after the Scheme expression; the value of the expression is not used */
  VS_THEN_END,        /* control leaves the function: the statement is its last */
  VS_THEN_MADE,       /* in the procedure with the name word:number (MADE) */
  VS_THEN_STATEMENTS, /* at the statements from `node` up to `stop`, and after these statements at the place `on` */
  VS_THEN_LOOP,       /* at the next iteration of the loop statement `node`, whose loop number is `number` */
  VS_THEN_OUTCOME     /* after the try statement `target`, at the place that the result of the try determines */
} vs_then_kind;

typedef struct vs_then {
  vs_then_kind kind;
  const char *word;
  uint32_t number, node, stop;
  struct vs_jump_target *target;
  const struct vs_then *on;
} vs_then;

/* A statement that a break or continue leaves, or a try. If it is a try, each jump out of its parts has a number. */
typedef struct vs_jump_target {
  struct vs_jump_target *up;
  uint32_t node;
  vs_then broken, continued;
  bool guard;
  uint32_t *exits;
  size_t exit_count, exit_room; /* exits[i]: node of the jump with number i + 1, or 0 if that jump is a return */
  uint32_t number;
} vs_jump_target;

typedef struct {
  vs_script *s;
  vs_scopes *k;
  vs_item *items;
  size_t count, room;
  uint32_t line; /* line number of the script's first line, minus 1 */
  uint32_t scope, numbers;
  unsigned depth, functions; /* nesting depth of statements and of functions */
  vs_script_place at;
  vs_jump_target *targets;
} vs_translation;

typedef enum { VS_TYPE_ANY, VS_TYPE_NUMBER, VS_TYPE_STRING, VS_TYPE_BOOLEAN } vs_static_type;

bool vs_translate_open(vs_translation *t);
bool vs_translate_close(vs_translation *t);
bool vs_translate_word(vs_translation *t, const char *word);
bool vs_translate_call(vs_translation *t, const char *word); /* Writes an opening parenthesis and `word` after it. */
bool vs_translate_name(vs_translation *t, uint32_t name);
bool vs_translate_direct(vs_translation *t, uint32_t name);
bool vs_translate_made(vs_translation *t, const char *word, uint32_t number);
bool vs_translate_key(vs_translation *t, uint32_t node);  /* Writes (js:quote key), where the key is the text of `node`,
                                                           * a NAME, STRING or NUMBER. */
bool vs_translate_text(vs_translation *t, uint32_t name); /* Writes the name as a string literal. */
/* Returns the Scheme form that defines a parameter of the model if the name is gui_number or a similar word, otherwise
 * NULL. */
const char *vs_translate_parameter_word(const vs_translation *t, uint32_t name);
bool vs_translate_item(vs_translation *t, vs_item item);

#endif
