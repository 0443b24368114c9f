/* Owns the facts about a program that are known without running it: its texts as trees with places, the variables with
 * their definitions and uses, the scopes, the comments, and the expansions of macros.
 *
 * An analysis holds all of these in arrays; an index names an element, and 0 means none. Nodes of the texts come first,
 * in the order of the text. Nodes made by macros follow, each with the node of which it is a copy. The analysis never
 * runs the program. It asks the interpreter for the meaning of the language's names, and has it import libraries.
 *
 * The first failure sets `trouble`. After it, every call does nothing, and know_read returns false. */
#ifndef VS_LANGUAGES_ANALYSIS_ANALYSIS_H
#define VS_LANGUAGES_ANALYSIS_ANALYSIS_H

#include "visualscheme.h"

typedef uint32_t know_index;

typedef enum {
  KNOW_LIST,   /* (a b), [a b], 'a, `a, ,a, ,@a: the last four have two elements, the word and the datum */
  KNOW_VECTOR, /* #(a b), #u8(1 2) */
  KNOW_SYMBOL, KNOW_KEYWORD, KNOW_NUMBER, KNOW_STRING, KNOW_CHARACTER, KNOW_BOOLEAN,
  KNOW_OTHER   /* #!eof, #0#, and any other datum without parts */
} know_kind;

/* The use of a node, once the scopes are known. */
typedef enum {
  KNOW_EXPRESSION,
  KNOW_DATUM,      /* quoted, or part of a pattern or a template */
  KNOW_SYNTAX,     /* a word of a form's syntax: if, else, => */
  KNOW_DEFINITION, /* a name at its definition or binding */
  KNOW_REFERENCE,  /* a name whose value is used */
  KNOW_ASSIGNMENT, /* a name whose value is set */
  KNOW_UNBOUND,    /* a name without a definition */
  KNOW_OPAQUE      /* within the use of a macro that only a run of the program could expand */
} know_role;

typedef struct {
  uint32_t file, from, to;                    /* bytes of the file's text */
  uint32_t line, column, end_line, end_column; /* from 1, columns in characters; the end is just after the last one */
} know_place;

typedef struct {
  uint8_t kind, role;
  char open;           /* LIST: ( [ ' ` , @ ; VECTOR: # */
  bool dotted;         /* LIST: a dot precedes its last element */
  bool made;           /* made by a macro: its place is that of the use */
  bool walked;         /* the walk has searched for its meaning */
  bool statement;      /* a statement: at top level or in a body */
  uint16_t form;       /* LIST: 1 + the row in binding_forms.def of its first word */
  know_index parent, first, next;
  uint32_t count;      /* of elements */
  know_index name;     /* SYMBOL, KEYWORD: know_name */
  know_index symbol;   /* of a name: the symbol that it refers to */
  know_index scope;    /* the scope around it */
  know_index expansion; /* LIST: the expansion of the macro that it uses */
  know_index origin;   /* made: the node of which it is a copy */
  know_place at;
} know_node;

/* A name as an identifier. Names from a macro's template are separate identifiers of the same text. */
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
  KNOW_FIELD,     /* a constructor, predicate or accessor of a record or a primitive */
  KNOW_RULE, KNOW_MACRO,
  KNOW_BUILTIN    /* of the language, or of an imported library */
} know_symbol_kind;

typedef struct {
  uint32_t least, most; /* numbers of positional arguments; most UINT32_MAX: any number */
  bool known;
  bool any_keyword;
  know_index keywords;  /* a node: the parameter list; 0: of the language */
} know_arity;

/* A parameter's value as the user writes it. */
typedef struct { const char *name, *value; } know_setting;

typedef struct {
  const char *text;       /* its name */
  know_index name, scope, next_in_scope;
  uint8_t kind;
  bool made;              /* made by a macro */
  bool optional;          /* PARAMETER: it has a default, takes the remaining arguments, or is a keyword */
  bool checked;           /* PARAMETER: a contract reads it */
  know_index definition;  /* the node of the name; 0: BUILTIN */
  know_index form;        /* the whole form of its definition */
  know_index value;       /* the expression; a FUNCTION's parameter list is in `parameters` */
  know_index parameters;  /* node: the list, or a rest name without a list */
  know_index body;        /* node: the first form of the body */
  know_index owner;       /* PARAMETER: the FUNCTION; 0: of a lambda */
  know_index first_use, last_use; /* know_use, in the order of the walk */
  uint32_t definitions, reads, sets, calls;
  know_arity arity;
  know_index comment, comment_end; /* the know_comments above or beside it */
  know_index doc_string;  /* node: the string in a body that documents it */
  uint16_t row;           /* MACRO of the language: 1 + the row of binding_forms.def; 0: none */
  bool rules;             /* MACRO by define-syntax-rule: `value` is the name with its pattern */
  know_index hides;       /* the variable of the program that it hides */
  const char *call, *keywords, *doc; /* BUILTIN: as in vs_name_info */
} know_symbol;

typedef struct { know_index symbol, node, next; uint8_t role; bool called; } know_use;
typedef struct { uint32_t file, from, to, line, end_line; bool alone; } know_comment; /* alone: no code precedes it on
                                                                                       * its line */

typedef struct {
  const char *path;       /* as the program names it */
  const char *text;
  size_t size;
  know_index root;        /* a LIST of the top-level forms */
  know_index first_comment, comment_end;
  know_index loaded_by;   /* node: the (load ...); 0: the program's own */
  bool run;               /* its forms are among the program's already: another load of it, also one by itself, adds
                           * nothing */
} know_file;

typedef struct {
  vs_scheme *scheme;
  const char *library_path;
  const char *given; size_t given_length; /* a text that replaces the file's; NULL: the file's own */
  char trouble[400];      /* "": none */
  vs_outcome outcome;     /* of the trouble */
  bool muted;             /* the host must store messages in `heard`, and show none */
  char heard[400];
  bool reading;           /* the host must ignore errors of line 0, and set `unreadable` for any other */
  bool unreadable;
  bool open;              /* the names cannot all be known: the program uses eval or opaque macros */
  bool script;            /* the program is in JavaScript (script/script_tree.h) */
  bool library;           /* the program defines a library: its imports may give other meanings to the language's
                           * names */
  struct know_memory *memory;
  know_node *nodes; size_t node_count, node_room;
  know_name *names; size_t name_count, name_room;
  know_scope *scopes; size_t scope_count, scope_room;
  know_symbol *symbols; size_t symbol_count, symbol_room;
  know_use *uses; size_t use_count, use_room;
  know_comment *comments; size_t comment_count, comment_room;
  know_file *files; size_t file_count, file_room;
  know_index *name_table; size_t name_slots;         /* by text, base and scope */
  know_index *binding_table; size_t binding_slots, binding_count; /* symbols, by scope and name */
  size_t text_nodes;      /* nodes up to this one are in the texts */
} knowledge;

enum { KNOW_MOST_NESTING = 10000, KNOW_MOST_NODES = 20000000, KNOW_MOST_MADE = 1000000, KNOW_MOST_BYTES = 64 << 20 };

bool know_open(knowledge *k); /* Makes the arrays of a new analysis; false: trouble. */
void know_free(knowledge *k);

/* ---- for the parts of this layer ---- */

/* Records the first trouble. Returns false, for the caller to return. place NULL: no place. */
bool know_fail(knowledge *k, const know_place *place, vs_outcome outcome, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void *know_alloc(knowledge *k, size_t bytes);                    /* zeroed, freed with k; NULL: trouble */
const char *know_text(knowledge *k, const char *text, size_t length); /* a copy with a final NUL; "": trouble */
/* Returns a new element, zeroed; 0: trouble. Arrays move, so keep indices and no pointers. */
know_index know_node_new(knowledge *k, know_kind kind);
know_index know_scope_new(knowledge *k, know_index parent, know_scope_kind kind, know_index node);
know_index know_symbol_new(knowledge *k, know_index scope, know_index name, know_symbol_kind kind);
void know_use_add(knowledge *k, know_index symbol, know_index node, know_role role, bool called);
/* Returns the name of that text. base and scope: the name and scope of which it is an alias; 0: a plain name. */
know_index know_name_of(knowledge *k, const char *text, size_t length, know_index base, know_index scope);
/* Returns the binding of the name in this scope only; 0: none. */
know_index know_bound_in(const knowledge *k, know_index scope, know_index name);

/* ---- queries ---- */

static inline const know_node *know_at(const knowledge *k, know_index node) { return &k->nodes[node]; }
know_index know_nth(const knowledge *k, know_index list, uint32_t nth); /* 0: none */
bool know_is(const knowledge *k, know_index node, const char *word);    /* true if it is this word, with any meaning */
/* Returns the file's text of the node. */
const char *know_spelling(const knowledge *k, know_index node, size_t *length);
const char *know_scope_word(know_scope_kind kind);
const char *know_symbol_word(know_symbol_kind kind);
const char *know_role_word(know_role role);
const char *know_kind_word(know_kind kind);

#endif
