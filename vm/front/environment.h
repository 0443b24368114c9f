/* Declares environments, which determine the meaning of an identifier at a place in a program. They consist only of
 * heap objects, so that the heap image contains them.
 *
 * An identifier is a symbol or an ALIAS, a name that was renamed by a macro's expansion. An alias refers to the binding
 * of its `name` in the macro's environment `env` unless the alias itself is bound.
 *
 * There may be thousands of nested scopes, and a name may be bound far outside. Therefore a scope whose depth is a
 * multiple of SKIP (16), of its square and so on also has a table of all bindings of that many scopes around it (16,
 * 256, ...). A search reads the table and continues outside those scopes. A late binding is one that is added to a
 * scope that already contains other scopes. It makes their tables invalid; bodies avoid such bindings. In a scope,
 * `name` is its depth and the number of late bindings when its table was made. Its `imports` is the table (identifier
 * to the scope that binds it) or (), its `exports` the scope in which to continue. The `top` of the top-level
 * environment is the number of late bindings.
 *
 * Environments form chains by `parent`. `top` is the end of a local scope's chain, #f in a top-level environment. A
 * local scope's `data` is the number of the expansion that created it. A local scope binds names to fixnum addresses of
 * vs_var of that expansion's tree, or to MACROs. A top-level environment (parent #f) binds CELLs and MACROs. Its
 * `imports` is a list of (environment . #t) or (environment . table from local name to its name there). Its `exports`
 * is #t (every name that does not begin with %) or a table from outside name to inside name. Its `name` is #f or the
 * library's name. Its `data` is the way in which it accepts imports (vs_intake).
 *
 * A program shares the cells of its imports until it assigns or defines the name. The first reference to a constant (a
 * cell with VS_F_CONSTANT) copies it into a cell of the program. A new definition in the program therefore affects all
 * code of the program, including code compiled before, and not the library. */
#ifndef VS_VM_FRONT_ENVIRONMENT_H
#define VS_VM_FRONT_ENVIRONMENT_H

#include "vm/values/gc.h"

/* ---- tables of identifiers: a vector with the count in slot 0, then keys and values; open addressing ---- */
bool vs_idtable_new(vs_scheme *vm, vs_value *out);
vs_value vs_idtable_get(vs_value table, vs_value id);             /* Returns the value of the key id in the table, or
                                                                   * VS_VACANT. */
/* Sets the value of the key id in the table. `table` and `v` point to roots of the garbage collector. If the table
 * grows, *table becomes another object. */
bool vs_idtable_put(vs_scheme *vm, vs_value *table, vs_value id, vs_value v);
/* Sets *key and *value to those of slot i of the table. Returns false if i is not below the number of slots. An empty
 * slot has the key VS_VACANT. */
bool vs_idtable_slot(vs_value table, size_t i, vs_value *key, vs_value *value);
int64_t vs_idtable_count(vs_value table);

/* ---- identifiers ---- */
static inline bool vs_is_identifier(vs_value v) { return vs_is(v, VS_T_SYMBOL) || vs_is(v, VS_T_ALIAS); }
/* Returns the symbol of an identifier. For an alias (a name that a macro renamed), this is the original name. */
vs_value vs_identifier_symbol(vs_value id);
/* Sets *out to a new alias of the identifier `name` in the environment `env`. */
bool vs_make_alias(vs_scheme *vm, vs_value name, vs_value env, vs_value *out);
/* Sets *out to a copy of the datum in which symbols replace aliases (renamed identifiers), or to the datum itself if it
 * has no aliases. */
bool vs_strip(vs_scheme *vm, vs_value datum, vs_value *out);
/* Result of testing one part of a datum, in a search that ends at VS_DATUM_YES. VS_DATUM_NO_MORE: the parts inside this
 * part need no tests. */
typedef enum { VS_DATUM_NO, VS_DATUM_YES, VS_DATUM_NO_MORE } vs_datum_test;
bool vs_datum_any(vs_scheme *vm, vs_value datum, vs_datum_test (*test)(vs_scheme *vm, vs_value v), bool *yes);

/* ---- environments ---- */
/* Creates a top-level environment without imports. */
bool vs_environment_new(vs_scheme *vm, vs_value name, vs_value *out);
bool vs_scope_new(vs_scheme *vm, vs_value parent, int64_t serial, vs_value *out);                    /* Creates a local
                                                                                                      * scope. */
/* Binds id in the table of env itself, not in one of its parents. */
bool vs_environment_bind(vs_scheme *vm, vs_value env, vs_value id, vs_value binding);
/* The ways in which a top-level environment accepts imports.
 *   STRICT   of libraries and `environment`: only imports are visible; a name from two libraries is an error
 *   FRESH    of a program at its start: the whole library is visible; an import at the start makes it STRICT
 *   OPEN     of a program after its start: an import adds names, and replaces earlier imports
 *   PROMPT   as OPEN, and an import also replaces definitions made at the prompt */
typedef enum { VS_INTAKE_STRICT, VS_INTAKE_FRESH, VS_INTAKE_OPEN, VS_INTAKE_PROMPT } vs_intake;
vs_intake vs_environment_intake(vs_value env);
/* Sets how env, a top-level environment, accepts imports. */
void vs_environment_set_intake(vs_value env, vs_intake intake);

/* Imports the top-level environment `from` into env. mapping is #t, or a table from local names to names in `from`.
 * Sets *clash to a name that has a different binding in env, or to VS_VACANT. Sets *own to true if env itself defines
 * this name. */
bool vs_environment_import(vs_scheme *vm, vs_value env, vs_value from, vs_value mapping, vs_value *clash, bool *own);
void vs_environment_forget_imports(vs_value env);
static inline bool vs_is_top(vs_value env) { return vs_as_environment(env)->parent == VS_FALSE; }

typedef enum { VS_MEANS_NOTHING, VS_MEANS_LOCAL, VS_MEANS_MACRO, VS_MEANS_CELL } vs_meaning_kind;
typedef struct vs_meaning {
  vs_meaning_kind kind;
  vs_value value;        /* LOCAL: address of the variable as a fixnum. MACRO, CELL: the object, which an allocation may
                          * move */
  vs_value env;          /* LOCAL: the scope that binds the identifier. Otherwise the top-level environment that binds
                          * it */
  vs_value id;           /* name of the identifier in the top-level environment that binds it */
  bool foreign;          /* whether the variable (CELL) or the MACRO comes from an imported library */
} vs_meaning;
/* Returns the meaning of id in env. Allocates nothing. */
vs_meaning vs_environment_find(vs_value env, vs_value id);
bool vs_same_meaning(vs_value env_a, vs_value a, vs_value env_b, vs_value b);

/* Sets *cell to the cell of a top-level variable. m: the variable's meaning, as returned by vs_environment_find. If the
 * variable has no cell, creates a cell with the value VS_UNDEFINED. */
bool vs_environment_cell(vs_scheme *vm, const vs_meaning *m, vs_value *cell);
/* Sets *cell to the cell that a top-level (define id ...) in env assigns. The cell belongs to env alone; code of env
 * that was compiled earlier refers to the same cell. */
bool vs_environment_define(vs_scheme *vm, vs_value env, vs_value id, vs_value *cell);
/* Returns the value of the variable that env defines or exports under the name `symbol`, or VS_UNDEFINED. */
vs_value vs_environment_value(vs_value env, vs_value symbol);

/* Calls each(context, symbol, binding) for every name that a program in env can use, except names that begin with %.
 * Ends when `each` returns false. */
bool vs_environment_each(vs_value env, bool (*each)(void *context, vs_value symbol, vs_value binding), void *context);

/* Marks as constant all variables that env, a top-level environment, defines, except those that its code assigns.
 * Called after the library is loaded. */
void vs_environment_seal(vs_value env);

#endif
