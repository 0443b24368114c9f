/* Owns environments: the meaning of an identifier at a place. They are heap objects only, so the heap image contains
 * them.
 *
 * An identifier is a symbol or an ALIAS, a name that a macro expansion renamed. An alias means its `name` in the
 * macro's environment `env` unless the alias itself is bound.
 *
 * Scopes may be nested by the thousand, and a name may be bound far outside. Therefore a scope with a depth that is a
 * multiple of SKIP (16), of its square and so on also has a table of all bindings of that many scopes around it (16,
 * 256, ...). A search tests the table and continues beyond those scopes. When a scope that contains others gets a late
 * binding, which bodies avoid, the tables made before are no longer valid. In a scope `name` is its depth and the
 * number of late bindings when its table was made, `imports` the table (identifier to the scope that binds it) or (),
 * `exports` the scope in which to continue. The number of late bindings is the `top` of the top-level environment.
 *
 * Environments form chains by `parent`. `top` is the end of a local scope's chain, #f in a top-level environment. A
 * local scope's `data` is the number of the expansion that made it; its bindings are fixnum addresses of vs_var of that
 * expansion's tree, or MACROs. A top-level environment (parent #f) binds CELLs and MACROs. Its `imports` is a list of
 * (environment . #t) or (environment . table from local name to its name there). Its `exports` is #t (every name that
 * does not begin with %) or a table from outside name to inside name. Its `name` is #f or the library's name; its
 * `data` is its intake of imports (vs_intake).
 *
 * A program shares the cells of its imports until it assigns or defines the name. The first reference copies a constant
 * (a cell with VS_F_CONSTANT) into a cell of the program. Therefore all code of the program, also code compiled before,
 * sees a new definition, and the library does not. */
#ifndef VS_VM_FRONT_ENVIRONMENT_H
#define VS_VM_FRONT_ENVIRONMENT_H

#include "vm/values/gc.h"

/* ---- tables from identifiers to values: a vector, slot 0 the count, then keys and values, open addressing ---- */
bool vs_idtable_new(vs_scheme *vm, vs_value *out);
vs_value vs_idtable_get(vs_value table, vs_value id);             /* VS_VACANT: not found */
/* `table` and `v` are in roots. A table that grows becomes another object: *table changes. */
bool vs_idtable_put(vs_scheme *vm, vs_value *table, vs_value id, vs_value v);
/* Returns the i-th slot, false beyond the end; a slot with key VS_VACANT is empty. */
bool vs_idtable_slot(vs_value table, size_t i, vs_value *key, vs_value *value);
int64_t vs_idtable_count(vs_value table);

/* ---- identifiers ---- */
static inline bool vs_is_identifier(vs_value v) { return vs_is(v, VS_T_SYMBOL) || vs_is(v, VS_T_ALIAS); }
/* id is an identifier. */
vs_value vs_identifier_symbol(vs_value id);                      /* the name without renamings */
/* The name is an identifier, and env an environment. */
bool vs_make_alias(vs_scheme *vm, vs_value name, vs_value env, vs_value *out);
/* Sets *out to a copy of a datum with symbols for its aliases; to the datum itself if it has none. */
bool vs_strip(vs_scheme *vm, vs_value datum, vs_value *out);
/* Sets *yes if test is true of the datum or a part of it. Returns false when memory is out. */
typedef enum { VS_DATUM_NO, VS_DATUM_YES, VS_DATUM_NO_MORE /* nor for its parts */ } vs_datum_test;
bool vs_datum_any(vs_scheme *vm, vs_value datum, vs_datum_test (*test)(vs_scheme *vm, vs_value v), bool *yes);

/* ---- environments ---- */
/* top-level, no imports */
bool vs_environment_new(vs_scheme *vm, vs_value name, vs_value *out);
bool vs_scope_new(vs_scheme *vm, vs_value parent, int64_t serial, vs_value *out);                    /* local */
/* in its own table */
bool vs_environment_bind(vs_scheme *vm, vs_value env, vs_value id, vs_value binding);
/* How a top-level environment takes imports.
 *   STRICT   libraries and `environment`: they see only their imports; a name from two libraries is an error
 *   FRESH    a program at its beginning: it sees the whole library; an import at the beginning makes it STRICT
 *   OPEN     a program after its beginning: an import adds, and replaces earlier imports
 *   PROMPT   the same, and an import also replaces the prompt's own definitions */
typedef enum { VS_INTAKE_STRICT, VS_INTAKE_FRESH, VS_INTAKE_OPEN, VS_INTAKE_PROMPT } vs_intake;
vs_intake vs_environment_intake(vs_value env);
/* env is a top-level environment. */
void vs_environment_set_intake(vs_value env, vs_intake intake);

/* Imports `from`; mapping is #t or a table from local name to its name in `from`. Every other meaning of a name
 * replaces that of the whole library (vm->at.core, mapping #t). Sets *clash to VS_VACANT, or to a name that cannot be
 * imported because it has another meaning; *own: by a definition of env itself. Both are top-level environments. */
bool vs_environment_import(vs_scheme *vm, vs_value env, vs_value from, vs_value mapping, vs_value *clash, bool *own);
void vs_environment_forget_imports(vs_value env);
static inline bool vs_is_top(vs_value env) { return vs_as_environment(env)->parent == VS_FALSE; }

typedef enum { VS_MEANS_NOTHING, VS_MEANS_LOCAL, VS_MEANS_MACRO, VS_MEANS_CELL } vs_meaning_kind;
typedef struct vs_meaning {
  vs_meaning_kind kind;
  vs_value value;        /* LOCAL: fixnum address of the vs_var; MACRO, CELL: the object; use it before it moves */
  vs_value env;          /* LOCAL: the scope that binds it; else the top-level environment of the identifier */
  vs_value id;           /* top level: the identifier there */
  bool foreign;          /* CELL or MACRO of an import, not its own */
} vs_meaning;
/* Returns the meaning of id in env. Allocates nothing. */
vs_meaning vs_environment_find(vs_value env, vs_value id);
bool vs_same_meaning(vs_value env_a, vs_value a, vs_value env_b, vs_value b);

/* Sets *cell to the cell for a reference to a top-level variable. If there is none, makes it, with VS_UNDEFINED. m: the
 * result of vs_environment_find. */
bool vs_environment_cell(vs_scheme *vm, const vs_meaning *m, vs_value *cell);
/* Sets *cell to the cell that (define id ...) at top level sets: env's own; older code sees it. */
bool vs_environment_define(vs_scheme *vm, vs_value env, vs_value id, vs_value *cell);
/* Returns the value of an exported or own variable by name, VS_UNDEFINED if there is none. */
vs_value vs_environment_value(vs_value env, vs_value symbol);

/* Calls each(context, symbol, binding) for every name that a program in env can use (no % names), until it returns
 * false. */
bool vs_environment_each(vs_value env, bool (*each)(void *context, vs_value symbol, vs_value binding), void *context);

/* Marks all definitions of env, a top-level environment, as constant, except those that its code assigns: the library
 * is finished. */
void vs_environment_seal(vs_value env);

#endif
