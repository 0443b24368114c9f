/* Owns what is known of a program without running it: its texts as trees in which everything has its place, the
 * variables with all places that define and use them, the scopes, the comments, what macros become.
 *
 * An analysis holds all of it in arrays; an index names an element, and 0 names none. Nodes of the texts come first,
 * in the order of the text; nodes that macros made follow, each with the node that it was copied from. Nothing here
 * runs the program: the interpreter is asked what the language's names mean, and to bring in libraries that are
 * imported.
 *
 * Failure is kept: the first one sets `trouble`, whatever is asked later does nothing, and know_read answers false. */
#ifndef VS_LANGUAGES_ANALYSIS_ANALYSIS_H
#define VS_LANGUAGES_ANALYSIS_ANALYSIS_H

#include "visualscheme.h"

typedef uint32_t know_index;

typedef enum {
  KNOW_LIST,   /* (a b), [a b], 'a, `a, ,a, ,@a: the last four hold two elements, the word and the datum */
  KNOW_VECTOR, /* #(a b), #u8(1 2) */
  KNOW_SYMBOL, KNOW_KEYWORD, KNOW_NUMBER, KNOW_STRING, KNOW_CHARACTER, KNOW_BOOLEAN,
  KNOW_OTHER   /* #!eof, #0#, and whatever else has no parts */
} know_kind;

/* The use of a node, once the scopes are known. */
typedef enum {
  KNOW_EXPRESSION,
  KNOW_DATUM,      /* quoted, or part of a pattern or a template */
  KNOW_SYNTAX,     /* a word that structures a form: if, else, => */
  KNOW_DEFINITION, /* a name where it is defined or bound */
  KNOW_REFERENCE,  /* a name where its value is used */
  KNOW_ASSIGNMENT, /* a name whose value is set */
  KNOW_UNBOUND,    /* a name that nothing defines */
  KNOW_OPAQUE      /* within the use of a macro that only running the program could expand */
} know_role;

typedef struct {
  uint32_t file, from, to;                    /* bytes of the file's text */
  uint32_t line, column, end_line, end_column; /* from 1, columns in characters; the end is just behind */
} know_place;

typedef struct {
  uint8_t kind, role;
  char open;           /* LIST: ( [ ' ` , @ ; VECTOR: # */
  bool dotted;         /* LIST: its last element stands behind a dot */
  bool made;           /* a macro made it: place is that of the use */
  bool walked;         /* its meaning has been looked for */
  bool statement;      /* stands at top level or in a body */
  uint16_t form;       /* LIST: 1 + the row of binding_forms.def that its first word names */
  know_index parent, first, next;
  uint32_t count;      /* of elements */
  know_index name;     /* SYMBOL, KEYWORD: know_name */
  know_index symbol;   /* a name: what it names */
  know_index scope;    /* where it stands */
  know_index expansion; /* LIST: what the macro that it uses makes of it */
  know_index origin;   /* made: the node that it was copied from */
  know_place at;
} know_node;

/* A name as one identifier: those that a macro's template brought in are identifiers of their own, of the same text. */
typedef struct { const char *text; know_index base, scope; uint32_t hash; } know_name;

typedef enum {
  KNOW_SCOPE_LANGUAGE, KNOW_SCOPE_PROGRAM, KNOW_SCOPE_PROCEDURE, KNOW_SCOPE_LET, KNOW_SCOPE_LOOP, KNOW_SCOPE_BODY,
  KNOW_SCOPE_SYNTAX
} know_scope_kind;
typedef struct { know_index parent, node, first_symbol, procedure; uint8_t kind; } know_scope;

typedef enum {
  KNOW_VARIABLE, KNOW_FUNCTION, KNOW_PARAMETER, /* of a procedure */
  KNOW_MODEL_PARAMETER, /* (define-parameter ...) */
  KNOW_LOCAL,     /* of a let */
  KNOW_LOOP_VARIABLE, KNOW_LOOP,  /* (let loop ([i 0]) ...) */
  KNOW_FIELD,     /* a constructor, predicate, accessor of a record or a primitive */
  KNOW_RULE, KNOW_MACRO,
  KNOW_BUILTIN    /* the language's, or an imported library's */
} know_symbol_kind;

typedef struct {
  uint32_t least, most; /* arguments by place; most UINT32_MAX: any number */
  bool known;
  bool any_keyword;
  know_index keywords;  /* a node: the parameter list; 0: of the language */
} know_arity;

/* A parameter's value as its user writes it. */
typedef struct { const char *name, *value; } know_setting;

typedef struct {
  const char *text;       /* its name */
  know_index name, scope, next_in_scope;
  uint8_t kind;
  bool made;              /* a macro's own */
  bool optional;          /* PARAMETER: it has a default, or gathers the rest, or is given by keyword */
  bool checked;           /* PARAMETER: a contract reads it */
  know_index definition;  /* the node of the name, 0: BUILTIN */
  know_index form;        /* the whole form that defines it */
  know_index value;       /* the expression, a FUNCTION's parameter list stands in `parameters` */
  know_index parameters;  /* node: the list, or a lone rest name */
  know_index body;        /* node: the first form of the body */
  know_index owner;       /* PARAMETER: the FUNCTION, 0: of a lambda */
  know_index first_use, last_use; /* know_use, in the order of the walk */
  uint32_t definitions, reads, sets, calls;
  know_arity arity;
  know_index comment, comment_end; /* the know_comments above or beside it */
  know_index doc_string;  /* node: a body's string that says what it does */
  uint16_t row;           /* MACRO of the language: 1 + the row of binding_forms.def; 0: none */
  bool rules;             /* MACRO: define-syntax-rule made it: `value` is the name with its pattern */
  know_index hides;       /* the variable of the program that it hides */
  const char *call, *keywords, *doc; /* BUILTIN: as vs_name_info says */
} know_symbol;

typedef struct { know_index symbol, node, next; uint8_t role; bool called; } know_use;
typedef struct { uint32_t file, from, to, line, end_line; bool alone; } know_comment; /* alone: nothing before it */

typedef struct {
  const char *path;       /* as it was named */
  const char *text;
  size_t size;
  know_index root;        /* a LIST of the top-level forms */
  know_index first_comment, comment_end;
  know_index loaded_by;   /* node: the (load ...), 0: the program's own */
  bool run;               /* its forms are among the program's: a second load of it, in itself too, adds nothing */
} know_file;

typedef struct {
  vs_scheme *scheme;
  const char *library_path;
  const char *given; size_t given_length; /* the program's text, in place of what its file holds; NULL: the file's */
  char trouble[400];      /* "": none */
  vs_outcome outcome;     /* of the trouble */
  bool muted;             /* the host is to keep what it is told in `heard`, and show nothing */
  char heard[400];
  bool reading;           /* the host is to pass over errors of line 0, and to set `unreadable` at any other */
  bool unreadable;
  bool open;              /* what defines names cannot all be known: eval, opaque macros */
  bool script;            /* the program is in JavaScript (script/script_tree.h) */
  bool library;           /* a library is defined here: its imports may give the language's names other meanings */
  struct know_memory *memory;
  know_node *nodes; size_t node_count, node_room;
  know_name *names; size_t name_count, name_room;
  know_scope *scopes; size_t scope_count, scope_room;
  know_symbol *symbols; size_t symbol_count, symbol_room;
  know_use *uses; size_t use_count, use_room;
  know_comment *comments; size_t comment_count, comment_room;
  know_file *files; size_t file_count, file_room;
  know_index *name_table; size_t name_slots;         /* by text, base and scope */
  know_index *binding_table; size_t binding_slots, binding_count; /* by scope and name: symbols */
  size_t text_nodes;      /* nodes up to here stand in the texts */
} knowledge;

enum { KNOW_MOST_NESTING = 10000, KNOW_MOST_NODES = 20000000, KNOW_MOST_MADE = 1000000, KNOW_MOST_BYTES = 64 << 20 };

bool know_open(knowledge *k); /* the arrays of an analysis that is new; false: trouble */
void know_free(knowledge *k);

/* ---- for the parts of this layer ---- */

/* The first trouble stays. False, for returning. place NULL: of no place. */
bool know_fail(knowledge *k, const know_place *place, vs_outcome outcome, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void *know_alloc(knowledge *k, size_t bytes);                    /* zeroed, freed with k; NULL: trouble */
const char *know_text(knowledge *k, const char *text, size_t length); /* a copy that ends in 0; "" with trouble */
/* A new element, zeroed; 0 with trouble. Arrays move: indices last, pointers do not. */
know_index know_node_new(knowledge *k, know_kind kind);
know_index know_scope_new(knowledge *k, know_index parent, know_scope_kind kind, know_index node);
know_index know_symbol_new(knowledge *k, know_index scope, know_index name, know_symbol_kind kind);
void know_use_add(knowledge *k, know_index symbol, know_index node, know_role role, bool called);
/* The name of that text; base and scope: what it is an alias of, 0: a plain one. */
know_index know_name_of(knowledge *k, const char *text, size_t length, know_index base, know_index scope);
/* Returns the binding of the name in the scope itself, 0: none. */
know_index know_bound_in(const knowledge *k, know_index scope, know_index name);

/* ---- asking ---- */

static inline const know_node *know_at(const knowledge *k, know_index node) { return &k->nodes[node]; }
know_index know_nth(const knowledge *k, know_index list, uint32_t nth); /* 0: there is none */
bool know_is(const knowledge *k, know_index node, const char *word);    /* is it this word? whatever it means */
/* The text of the file that the node was written as. */
const char *know_spelling(const knowledge *k, know_index node, size_t *length);
const char *know_scope_word(know_scope_kind kind);
const char *know_symbol_word(know_symbol_kind kind);
const char *know_role_word(know_role role);
const char *know_kind_word(know_kind kind);

#endif
