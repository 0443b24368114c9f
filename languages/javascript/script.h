/* Declares the tree of a script, which is a program in JavaScript: nodes with places, names, texts and comments, all in
 * arrays.
 *
 * An index identifies a node, and 0 means that there is none. The caller provides the memory, and receives the old size
 * with each request. The height of every node is limited, so a recursive walk of the tree is safe. */
#ifndef VS_LANGUAGES_JAVASCRIPT_SCRIPT_H
#define VS_LANGUAGES_JAVASCRIPT_SCRIPT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
#define VS_SCRIPT_NODE(name, holds) VS_SCRIPT_##name,
#include "languages/javascript/script_nodes.def"
#undef VS_SCRIPT_NODE
} vs_script_kind;

typedef enum {
#define VS_SCRIPT_OPERATOR(name, text, binds) VS_OPERATOR_##name,
#include "languages/javascript/script_operators.def"
#undef VS_SCRIPT_OPERATOR
} vs_script_operator;

/* The greatest number of nested levels of brackets and statements, and the greatest height of a tree. */
enum { VS_SCRIPT_DEPTH = 400, VS_SCRIPT_HEIGHT = 1500 };

/* A place: the bytes of the text from `from` up to `to`. Lines and columns count from 1, columns in characters. The end
 * is just after the last character. */
typedef struct {
  uint32_t from, to, line, column, end_line, end_column;
} vs_script_place;

typedef struct {
  uint8_t kind, op;
  bool flag;
  uint16_t height;
  uint32_t next, count;
  uint32_t a, b, c, d;   /* parts of the node, such as indices of nodes; script_nodes.def gives their meaning for each
                          * kind */
  uint32_t name;         /* NAME: index in `names` */
  uint32_t text, length; /* STRING, NATIVE: offset and length in bytes of its contents in `texts`, in UTF-8 */
  double number;         /* NUMBER: the value of the number */
  vs_script_place at;
} vs_script_node;

typedef struct {
  uint32_t text, length, hash;
} vs_script_name;
typedef struct {
  vs_script_place at;
  bool alone; /* whether nothing precedes the comment on its line */
} vs_script_comment;

/* A function that resizes a block from `used` to `fresh` bytes. at NULL: it allocates a new block. fresh 0: it frees
 * the block. It returns NULL if memory is out. */
typedef void *vs_script_resize(void *context, void *at, size_t used, size_t fresh);

typedef struct {
  const char *source; /* text of the script, owned by the caller */
  size_t size;
  vs_script_resize *resize;
  void *context;
  vs_script_node *nodes;
  size_t node_count, node_room;
  vs_script_name *names;
  size_t name_count, name_room;
  uint32_t *name_table;
  size_t name_slots;
  char *texts;
  size_t text_count, text_room;
  vs_script_comment *comments;
  size_t comment_count, comment_room;
  uint32_t root; /* index of the PROGRAM node */
  bool no_memory;
  char trouble[240]; /* message about the first fault of the text; "": there is no fault */
  vs_script_place trouble_at;
} vs_script;

/* Frees the script's arrays. */
void vs_script_close(vs_script *s);

/* ---- functions for the scanner and the parser ---- */

/* Sets the message and the place of a fault, unless a fault is already set. Always returns false, so that callers can
 * return the result. */
bool vs_script_fail(vs_script *s, vs_script_place at, const char *format, ...) __attribute__((format(printf, 3, 4)));
bool vs_script_room(vs_script *s, void *array, size_t *room, size_t count, size_t size);
/* Returns a new node, or 0 if memory is out. */
uint32_t vs_script_node_new(vs_script *s, vs_script_kind kind, vs_script_place at);
/* Returns the index of the name in `names`. Adds the name if it is new. Returns 0 if memory is out. */
uint32_t vs_script_name_of(vs_script *s, const char *text, size_t length);
/* Returns the index of the name, or 0 if the script has no such name. */
uint32_t vs_script_name_known(const vs_script *s, const char *text, size_t length);
/* Appends the text to `texts`. Returns false if memory is out. */
bool vs_script_text(vs_script *s, const char *text, size_t length);

/* ---- functions that read a tree ---- */

static inline const vs_script_node *vs_script_at(const vs_script *s, uint32_t node) { return &s->nodes[node]; }
const char *vs_script_spelling(const vs_script *s, uint32_t name, size_t *length);
bool vs_script_is(const vs_script *s, uint32_t name, const char *word);
const char *vs_script_kind_word(vs_script_kind kind);
const char *vs_script_operator_word(vs_script_operator op);

#endif
