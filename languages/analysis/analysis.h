/* Declares the facts about a program that are known without running it: its texts as trees with places, the variables
 * with their definitions and uses, the scopes, the comments, and the expansions of macros.
 *
 * An analysis contains these facts in arrays. An index identifies an element of an array, and 0 means that there is
 * none. Nodes of the texts come first, in the order of the text. Nodes made by macros follow, each with the node of
 * which it is a copy. The analysis never runs the program. It asks the interpreter for the meaning of the language's
 * names, and makes the interpreter import libraries.
 *
 * The first failure sets `trouble`. After it, every call does nothing, and know_read returns false. */
#ifndef VS_LANGUAGES_ANALYSIS_ANALYSIS_H
#define VS_LANGUAGES_ANALYSIS_ANALYSIS_H

#include "visualscheme.h"

typedef uint32_t know_index;

typedef enum {
  KNOW_LIST,   /* (a b), [a b], 'a, `a, ,a, ,@a; a list with one of the last four spellings has two elements, the word
                * and the datum */
  KNOW_VECTOR, /* a vector such as #(a b) or #u8(1 2) */
  KNOW_SYMBOL, KNOW_KEYWORD, KNOW_NUMBER, KNOW_STRING, KNOW_CHARACTER, KNOW_BOOLEAN,
  KNOW_OTHER   /* #!eof, #0#, and any other datum without parts */
} know_kind;

/* The role of a node in the program. The walk through the program (name_walk.h) determines it. */
typedef enum {
  KNOW_EXPRESSION,
  KNOW_DATUM,      /* data: quoted, or part of a macro's pattern or template */
  KNOW_SYNTAX,     /* a word of a form's syntax: if, else, => */
  KNOW_DEFINITION, /* a name where it is defined or bound */
  KNOW_REFERENCE,  /* a name whose value is used */
  KNOW_ASSIGNMENT, /* a name whose value is set */
  KNOW_UNBOUND,    /* a name without a definition */
  KNOW_OPAQUE      /* inside a macro use that only a run of the program could expand */
} know_role;

typedef struct {
  uint32_t file, from, to;                    /* file: index of the file. from, to: range of bytes of its text */
  uint32_t line, column, end_line, end_column; /* lines and columns from 1, columns in characters; the end is just after
                                                * the last character */
} know_place;

typedef struct {
  uint8_t kind, role;
  char open;           /* first character of the node. LIST: ( [ ' ` , @ ; VECTOR: # */
  bool dotted;         /* LIST: whether a dot precedes the last element */
  bool made;           /* whether a macro made the node; its place is then that of the macro's use */
  bool walked;         /* whether the walk (name_walk.h) has determined the node's meaning */
  bool statement;      /* whether the node is a statement, at top level or in a body */
  uint16_t form;       /* LIST: 1 + the row in binding_forms.def of the list's first word; 0: no row */
  know_index parent, first, next;
  uint32_t count;      /* LIST, VECTOR: number of elements */
  know_index name;     /* SYMBOL, KEYWORD: index of the node's know_name */
  know_index symbol;   /* symbol (name with its definition) to which the node refers; 0: none */
  know_index scope;    /* scope in which the node lies */
  know_index expansion; /* LIST that is a macro use: the node to which the macro expands */
  know_index origin;   /* if made: the node of which this node is a copy */
  know_place at;
} know_node;

/* A name as an identifier. Names from a macro's template are separate identifiers with the same text. base, scope: the
 * name of which it is an alias, and the scope of the macro. */
typedef struct { const char *text; know_index base, scope; uint32_t hash; } know_name;

typedef enum {
  KNOW_SCOPE_LANGUAGE, KNOW_SCOPE_PROGRAM, KNOW_SCOPE_PROCEDURE, KNOW_SCOPE_LET, KNOW_SCOPE_LOOP, KNOW_SCOPE_BODY,
  KNOW_SCOPE_SYNTAX
} know_scope_kind;
typedef struct { know_index parent, node, first_symbol, procedure; uint8_t kind; } know_scope;

typedef enum {
  KNOW_VARIABLE, KNOW_FUNCTION, KNOW_PARAMETER, /* a variable, a procedure, and a parameter of a procedure */
  KNOW_MODEL_PARAMETER, /* a name defined by (define-parameter ...) */
  KNOW_LOCAL,     /* a name bound by a let */
  KNOW_LOOP_VARIABLE, KNOW_LOOP,  /* names of (let loop ([i 0]) ...): i and loop */
  KNOW_FIELD,     /* a constructor, predicate or accessor of a record or a primitive */
  KNOW_RULE, KNOW_MACRO,
  KNOW_BUILTIN    /* a name of the language, or of an imported library */
} know_symbol_kind;

typedef struct {
  uint32_t least, most; /* least and greatest number of positional arguments; most UINT32_MAX: there is no upper
                         * limit */
  bool known;
  bool any_keyword;
  know_index keywords;  /* node of the parameter list that has the keywords; 0: the procedure is one of the language */
} know_arity;

/* A parameter's name and the text of the value that the user has set. */
typedef struct { const char *name, *value; } know_setting;

typedef struct {
  const char *text;       /* text of the name */
  know_index name, scope, next_in_scope;
  uint8_t kind;
  bool made;              /* whether a macro made the definition */
  bool optional;          /* PARAMETER: whether a call may omit it: it has a default, receives the remaining arguments,
                           * or is a keyword */
  bool checked;           /* PARAMETER: whether it has a contract, which uses its value */
  know_index definition;  /* node of the name in its definition; 0 for BUILTIN */
  know_index form;        /* node of the whole form that defines the symbol */
  know_index value;       /* node of the value's expression; for a FUNCTION, `parameters` is its parameter list */
  know_index parameters;  /* node of the parameter list, or of a rest name without a list */
  know_index body;        /* node of the first form of the body */
  know_index owner;       /* PARAMETER: symbol of its FUNCTION; 0: parameter of a lambda */
  know_index first_use, last_use; /* indices of the first and the last know_use of the symbol, in the order of the
                                   * walk */
  uint32_t definitions, reads, sets, calls;
  know_arity arity;
  know_index comment, comment_end; /* comment: first know_comment above or beside the definition; comment_end: index
                                    * after the last */
  know_index doc_string;  /* node of the string in a body that documents the definition */
  uint16_t row;           /* MACRO of the language: 1 + the row of binding_forms.def that describes it; 0: no row */
  bool rules;             /* MACRO defined by define-syntax-rule: `value` is the name with its pattern */
  know_index hides;       /* variable of the program that this symbol hides */
  const char *call, *keywords, *doc; /* BUILTIN: texts as in vs_name_info */
} know_symbol;

typedef struct { know_index symbol, node, next; uint8_t role; bool called; } know_use;
/* A comment in a file. from, to: range of bytes; line, end_line: lines from 1; alone: whether no code precedes it on
 * its line */
typedef struct { uint32_t file, from, to, line, end_line; bool alone; } know_comment;

typedef struct {
  const char *path;       /* path as the program writes it */
  const char *text;
  size_t size;
  know_index root;        /* LIST node whose elements are the top-level forms of the file */
  know_index first_comment, comment_end;
  know_index loaded_by;   /* node of the (load ...) that loads the file; 0: the program's own file */
  bool run;               /* whether the file's forms already belong to the program, so that loading the file again adds
                           * nothing */
} know_file;

typedef struct {
  vs_scheme *scheme;
  const char *library_path;
  const char *given; size_t given_length; /* text to analyse instead of the file's text; NULL: the file's text is
                                           * analysed */
  char trouble[400];      /* reason of the first failure; "": there is none */
  vs_outcome outcome;     /* outcome of the first failure */
  bool muted;             /* whether the interpreter's host must store messages by know_hear instead of showing them */
  char heard[700];        /* the first error that the interpreter reported while muted; if there is none, the first
                           * warning */
  uint32_t heard_line, heard_column; /* place of the message `heard` */
  bool heard_warning;     /* whether the message `heard` is a warning */
  uint32_t trial;         /* number of the value that a check is trying in place of an unknown argument */
  bool reading;           /* whether the interpreter's host must ignore errors at line 0, and set `unreadable` for any
                           * other error */
  bool unreadable;
  bool open;              /* whether some names cannot be known, because the program uses eval or opaque macros */
  bool script;            /* whether the program is in JavaScript (script/script_tree.h) */
  bool library;           /* whether the program defines a library, whose imports may give other meanings to the
                           * language's names */
  struct know_memory *memory;
  know_node *nodes; size_t node_count, node_room;
  know_name *names; size_t name_count, name_room;
  know_scope *scopes; size_t scope_count, scope_room;
  know_symbol *symbols; size_t symbol_count, symbol_room;
  know_use *uses; size_t use_count, use_room;
  know_comment *comments; size_t comment_count, comment_room;
  know_file *files; size_t file_count, file_room;
  know_index *name_table; size_t name_slots;         /* hash table of names by text, base and scope */
  know_index *binding_table; size_t binding_slots, binding_count; /* hash table of symbols by scope and name */
  size_t text_nodes;      /* number of nodes that come from the program's texts, not from macros */
} knowledge;

enum { KNOW_MOST_NESTING = 10000, KNOW_MOST_NODES = 20000000, KNOW_MOST_MADE = 1000000, KNOW_MOST_BYTES = 64 << 20 };

bool know_open(knowledge *k); /* Makes the arrays of a new analysis. Returns false with `trouble` set on failure. */
void know_free(knowledge *k);

/* ---- functions for the files of the analysis ---- */

/* Records the first failure. Always returns false, for the caller to return. place NULL: the failure has no place. */
bool know_fail(knowledge *k, const know_place *place, vs_outcome outcome, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* returns zeroed memory that is freed together with k; returns NULL, with `trouble` set, if memory is out */
void *know_alloc(knowledge *k, size_t bytes);
/* returns a copy of the text with a final NUL, freed together with k; returns "", with `trouble` set, if memory is
 * out */
const char *know_text(knowledge *k, const char *text, size_t length);
/* know_node_new and similar functions return the index of a new, zeroed element, or 0 on failure. The arrays may be
 * reallocated, so callers keep indices, not pointers. */
know_index know_node_new(knowledge *k, know_kind kind);
know_index know_scope_new(knowledge *k, know_index parent, know_scope_kind kind, know_index node);
know_index know_symbol_new(knowledge *k, know_index scope, know_index name, know_symbol_kind kind);
void know_use_add(knowledge *k, know_index symbol, know_index node, know_role role, bool called);
/* Returns the index of the name with this text. base and scope: the name and the scope of which it is an alias; 0: a
 * plain name. */
know_index know_name_of(knowledge *k, const char *text, size_t length, know_index base, know_index scope);
/* Returns the symbol that this scope itself binds to the name, or 0 if there is none. */
know_index know_bound_in(const knowledge *k, know_index scope, know_index name);

/* Stores a message of the interpreter in `heard`, while the analysis is muted. */
void know_hear(knowledge *k, const vs_diagnostic *d);

/* ---- queries of nodes and symbols ---- */

static inline const know_node *know_at(const knowledge *k, know_index node) { return &k->nodes[node]; }
know_index know_nth(const knowledge *k, know_index list, uint32_t nth); /* returns the nth element of the list, or 0 if
                                                                         * there is none */
/* returns true if the node is a symbol with this text; its meaning in the program does not matter */
bool know_is(const knowledge *k, know_index node, const char *word);
/* Returns the node's text as the file contains it. */
const char *know_spelling(const knowledge *k, know_index node, size_t *length);
const char *know_scope_word(know_scope_kind kind);
const char *know_symbol_word(know_symbol_kind kind);
const char *know_role_word(know_role role);
const char *know_kind_word(know_kind kind);

#endif
