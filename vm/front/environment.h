/* Owns environments: what an identifier means where. Heap objects only, so they last in the heap image.

   An identifier is a symbol or an ALIAS, a name that a macro expansion renamed: it stands for its `name` in the macro's
   environment `env` unless something binds the alias itself.

   Scopes may nest by the thousand, and what is looked up may be bound far out. Therefore a scope whose depth is a
   multiple of SKIP (16), of its square and so on also has a table of all that the scopes around it bind, up to as many
   of them; a search probes that and goes on behind. When something is bound in a scope that others lie in already,
   which bodies do not do, such tables are no longer believed. In a scope `name` holds its depth and how many such late
   bindings there were when its table was made, `imports` the table (identifier to the scope that binds it) or (),
   `exports` the scope to go on in. The count is the `top` of the top-level environment.

   Environments form chains by `parent`; `top` is where a local scope's chain ends, #f in a top-level environment. A
   local scope's `data` is the number of the expansion that made it, its bindings are fixnum addresses of vs_var of that
   expansion's tree, or MACROs. A top-level environment (parent #f) binds CELLs and MACROs; `imports` is a list of
   (environment . #t) or (environment . table from local name to its name there); `exports` is #t (everything whose name
   does not begin with %) or a table from outside name to inside name; `name` is #f or what the library is called;
   `data` says how it takes imports (vs_intake).

   A program shares the cells of what it imports until it assigns or defines the name: constants (cells with
   VS_F_CONSTANT) are copied into a cell of its own at the first reference, so that all code of the program, also what
   was compiled before, sees a new definition and the library does not. */
#ifndef VS_VM_FRONT_ENVIRONMENT_H
#define VS_VM_FRONT_ENVIRONMENT_H

#include "vm/values/gc.h"

/* ---- tables from identifiers to values: a vector, slot 0 the count, then keys and values, open addressing ---- */
bool vs_idtable_new(vs_scheme *vm, vs_value *out);
vs_value vs_idtable_get(vs_value table, vs_value id);             /* VS_VACANT: not there */
/* `table` and `v` in roots. A table that grows is another object: *table changes. */
bool vs_idtable_put(vs_scheme *vm, vs_value *table, vs_value id, vs_value v);
/* i-th slot: false past the end; key VS_VACANT: a hole */
bool vs_idtable_slot(vs_value table, size_t i, vs_value *key, vs_value *value);
int64_t vs_idtable_count(vs_value table);

/* ---- identifiers ---- */
static inline bool vs_is_identifier(vs_value v) { return vs_is(v, VS_T_SYMBOL) || vs_is(v, VS_T_ALIAS); }
/* id is an identifier. */
vs_value vs_identifier_symbol(vs_value id);                      /* the name under all renamings */
/* The name is an identifier, and env an environment. */
bool vs_make_alias(vs_scheme *vm, vs_value name, vs_value env, vs_value *out);
/* A fresh copy of a datum without aliases, if there are any in it; else the datum. */
bool vs_strip(vs_scheme *vm, vs_value datum, vs_value *out);
/* Does test hold for the datum or anything in it? False: out of memory. */
typedef enum { VS_DATUM_NO, VS_DATUM_YES, VS_DATUM_NO_MORE /* nor for anything in it */ } vs_datum_test;
bool vs_datum_any(vs_scheme *vm, vs_value datum, vs_datum_test (*test)(vs_scheme *vm, vs_value v), bool *yes);

/* ---- environments ---- */
/* top-level, no imports */
bool vs_environment_new(vs_scheme *vm, vs_value name, vs_value *out);
bool vs_scope_new(vs_scheme *vm, vs_value parent, int64_t serial, vs_value *out);                    /* local */
/* in its own table */
bool vs_environment_bind(vs_scheme *vm, vs_value env, vs_value id, vs_value binding);
/* How a top-level environment takes imports.
     STRICT   what a library and `environment` see: just what they import. A name from two libraries is an error.
     FRESH    a program at its beginning: it sees the whole library; if it begins with an import it becomes STRICT and
     loses that OPEN     a program past its beginning: an import adds, and wins over what was imported before
     PROMPT   the same, and an import also wins over the prompt's own definitions */
typedef enum { VS_INTAKE_STRICT, VS_INTAKE_FRESH, VS_INTAKE_OPEN, VS_INTAKE_PROMPT } vs_intake;
vs_intake vs_environment_intake(vs_value env);
/* env is a top-level environment. */
void vs_environment_set_intake(vs_value env, vs_intake intake);

/* mapping #t or a table from local name to its name in `from`. The whole library (vm->at.core, mapping #t) gives
   way to everything else.
   *clash: VS_VACANT, or a name that cannot be imported because it means something else already; *own: by a definition
   *of env's own. Both are top-level environments. */
bool vs_environment_import(vs_scheme *vm, vs_value env, vs_value from, vs_value mapping, vs_value *clash, bool *own);
void vs_environment_forget_imports(vs_value env);
static inline bool vs_is_top(vs_value env) { return vs_as_environment(env)->parent == VS_FALSE; }

typedef enum { VS_MEANS_NOTHING, VS_MEANS_LOCAL, VS_MEANS_MACRO, VS_MEANS_CELL } vs_meaning_kind;
typedef struct vs_meaning {
  vs_meaning_kind kind;
  vs_value value;        /* LOCAL: fixnum address of the vs_var; MACRO, CELL: the object, which nothing may move before
                            its use */
  vs_value env;          /* where it was found: LOCAL its scope; else the top-level environment of the identifier */
  vs_value id;           /* top level: the identifier there */
  bool foreign;          /* CELL or MACRO of an import, not its own */
} vs_meaning;
/* Allocates nothing. */
vs_meaning vs_environment_find(vs_value env, vs_value id);
bool vs_same_meaning(vs_value env_a, vs_value a, vs_value env_b, vs_value b);

/* The cell for a reference to a variable of the top level, made where needed (holding VS_UNDEFINED). m: what
   vs_environment_find said. */
bool vs_environment_cell(vs_scheme *vm, const vs_meaning *m, vs_value *cell);
/* The cell that (define id ...) at top level sets: its own; old code sees it. */
bool vs_environment_define(vs_scheme *vm, vs_value env, vs_value id, vs_value *cell);
/* The value of an exported or own variable by name, VS_UNDEFINED if there is none. */
vs_value vs_environment_value(vs_value env, vs_value symbol);

/* Calls each(context, symbol, length) for every name that a program in env can use (no % names), until it returns
   false. */
bool vs_environment_each(vs_value env, bool (*each)(void *context, vs_value symbol, vs_value binding), void *context);

/* Marks everything defined in env so far, but not what its code assigns, as constant: a finished library. env is a
 * top-level environment. */
void vs_environment_seal(vs_value env);

#endif
