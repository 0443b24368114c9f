/* Declares the interface between natives (procedures in C) and the VM: how a native is described, fails, returns, calls
 * procedures and polls.
 *
 * A native:
 *   static vs_status string_ref(vs_scheme *vm, vs_value *a, int n, vs_value *out);
 *   static const vs_native_def defs[] = {{"string-ref", "string k", string_ref, 0, "the k-th character"}, {0}};
 *   const vs_native_table vs_string_natives = {"string", defs};
 * and one row VS_NATIVES(string) in natives.def (or, for a layer above vm/, an entry in vs_config.tables).
 *
 * The signature string alone defines the arguments; counts, keywords and the names in messages come from it:
 *   "k"  required      "[k j]" optional      "#:name" keyword      ". rest" any number more
 * `a` is the arguments on the VM's stack (rooted, updated by the collector, writable). `n` is the number given. If the
 * signature has keywords or slots (below), a[] contains the required arguments, the optional ones, the keyword values
 * in the order of the signature, then the slots; VS_ABSENT is an argument that was not given. A native with keywords
 * and ". rest" finds the keyword values behind the n that were given: a[n], a[n + 1] and so on. (A native with slots
 * may not have ". rest".) Without keywords and slots only a[0..n-1] exist; test n. A native that may return VS_TAILCALL
 * has slots, or -1 there, which adds none: its caller's activation then ends first.
 *
 * It returns
 *   VS_OK         *out is the value (a native may leave it: #unspecific)
 *   VS_SEVERAL    *out contains several values, or none: vs_several returns this
 *   VS_ERROR      = false: vm->condition is set (by the functions below, and by all that return bool)
 *   VS_TAILCALL   the native ends; the loop calls the procedure given to vs_call in its place
 *   VS_CALL       the loop calls the procedure given to vs_call, then enters the native again, with the result in *out
 * so `return vs_cons(vm, a[0], a[1], out);` is a complete body.
 *
 * Natives never call Scheme in another way. A native that returns VS_CALL has `slots` > 0: its last `slots` elements of
 * a[] are private, #f at first entry; n is -1 when it is entered again. It must keep its state there (for example a
 * phase number as a fixnum in the first), because a continuation may copy the activation and enter it twice. load,
 * eval, the expander with its macro calls, dynamic-wind and call/cc work in this way:
 *   static vs_status load_(vs_scheme *vm, vs_value *a, int n, vs_value *out)  {  // "file", slots 2
 *     if (a[1] == VS_FALSE) open: make the reader/unit, vs_gc_store not needed: a[1] = unit (foreign object);
 *     else the last form's value is *out;
 *     read and expand one form; if a macro must run: return vs_call(vm, transformer, 3, argv)  (VS_CALL); the next
 *     entry has its value if a form is ready: vs_compile(vm, ast, node, &a[2]) && return vs_call(vm, a[2], 0, NULL);
 *     at the end: *out = last value; return VS_OK; }
 * An error inside the called procedure does not enter the native again: it unwinds. A foreign object must own memory
 * that has to be freed, or dynamic-wind restores it. */
#ifndef VS_VM_MACHINE_NATIVE_H
#define VS_VM_MACHINE_NATIVE_H

#include "vm/values/flat.h"
#include "vm/values/gc.h"

typedef int vs_status;
enum {
  VS_ERROR = 0,
  VS_OK = 1,
  VS_TAILCALL = 2,
  VS_CALL = 3,
  VS_THROW = 4,
  VS_UNCAUGHT = 5 /* result of a native of control.c only */,
  VS_SEVERAL = 6
};

typedef vs_status vs_native_fn(vs_scheme *vm, vs_value *a, int n, vs_value *out);

typedef struct vs_native_def {
  const char *name;          /* name of the procedure. Several names, separated by blanks, define several procedures;
                              * the errors of each show its own name */
  const char *signature;
  vs_native_fn *fn;
  int slots;
  const char *doc;           /* one line of help, or NULL */
} vs_native_def;

typedef struct vs_native_table {
  const char *name;
  const vs_native_def *defs; /* procedures of the table; the last element has the name NULL */
} vs_native_table;

/* Creates the procedures of a table, and calls define(vm, context, symbol, procedure) with each. The caller supplies
 * `define`. */
bool vs_native_define(vs_scheme *vm, const vs_native_table *table,
                      bool (*define)(vs_scheme *vm, void *context, vs_value symbol, vs_value procedure), void *context);

/* ---- requesting calls from the run loop; the arguments in argv are copied ---- */
vs_status vs_call(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv);       /* Stores the call for the
                                                                                             * run loop, and returns
                                                                                             * VS_CALL. */
vs_status vs_tailcall(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv);   /* Stores the call for the
                                                                                             * run loop, and returns
                                                                                             * VS_TAILCALL. */
/* Starts a call with a long argument list. vs_call_push then adds each argument, and the native returns VS_CALL or
 * VS_TAILCALL. */
void vs_call_begin(vs_scheme *vm, vs_value procedure);
/* Adds an argument to the call that vs_call_begin has started. call_count never exceeds call_room. */
bool vs_call_push(vs_scheme *vm, vs_value v);
/* Sets *out to an object with n values; `at` points to roots of the garbage collector or to arguments. The run loop
 * checks that the caller accepts several values. */
static inline vs_status vs_several(vs_scheme *vm, const vs_value *at, size_t n, vs_value *out) {
  return !vs_make_values(vm, at, n, out) ? VS_ERROR : n == 1 ? VS_OK : VS_SEVERAL;
}

/* Returns the current value of a parameter object. */
vs_value vs_parameter_value(const vs_scheme *vm, vs_value parameter);

/* ---- errors; all functions return VS_ERROR (false) ---- */
/* Sets the error "NAME: PARAM must be EXPECTED, got VALUE". NAME is that of the running native, and PARAM the name of
 * argument a[arg] in the native's signature. */
vs_status vs_fail_type(vs_scheme *vm, int arg, const char *expected, vs_value got);
/* Sets the error "NAME: PARAM is out of range: VALUE, must be from LOW to HIGH". HIGH itself is allowed. */
vs_status vs_fail_range(vs_scheme *vm, int arg, vs_value got, int64_t low, int64_t high);
/* Sets an error with a text in printf's format. If a native is running, "NAME: " precedes the text. kind is a symbol
 * such as vm->sym.error. */
vs_status vs_fail(vs_scheme *vm, vs_value kind, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* Sets an error as vs_fail does, with a list of irritants that is written after the text. */
vs_status vs_fail_with(vs_scheme *vm, vs_value kind, vs_value irritants, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Sets an error as vs_fail_with does, with the given place instead of that of the call, and without NAME and call
 * chain. Reader and expander use it. */
vs_status vs_fail_at(vs_scheme *vm, vs_value kind, vs_pos place, vs_value irritants, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
vs_status vs_fail_memory(vs_scheme *vm);
/* Raises any Scheme object, as (raise object) does. */
vs_status vs_fail_object(vs_scheme *vm, vs_value object);

/* ---- checking arguments; functions return false with a type error set ---- */
/* Sets *out to a[arg], which must be an exact integer from low to high. */
bool vs_arg_index(vs_scheme *vm, const vs_value *a, int arg, int64_t low, int64_t high, int64_t *out);

/* ---- limits: a native that runs long calls vs_poll with the work since its last call; the unit is a simple step, some
 * 5 ns ---- */
bool vs_poll(vs_scheme *vm, uint64_t work);
/* Calls vs_poll once in 1024 iterations of a loop. i: number of the current iteration. cost: work of one iteration, in
 * steps of about 5 ns. */
static inline bool vs_poll_turn(vs_scheme *vm, uint64_t i, unsigned cost) {
  return (i & 1023) != 1023 || vs_poll(vm, 1024 * (uint64_t)cost);
}

/* ---- foreign objects ---- */
typedef struct vs_foreign_type {
  const char *name;                                             /* noun for messages, with an article, such as "an
                                                                 * object" */
  /* Releases one reference to the object. It must not call the VM, nor recurse deeply. */
  void (*release)(void *object);
  bool (*equal)(const void *a, const void *b);                  /* implements equal?; NULL: two objects are equal only
                                                                 * if they are the same object */
  uint64_t (*hash)(const void *object);                         /* returns a hash, which must be equal for objects that
                                                                 * `equal` finds equal; NULL: there is none */
  /* Appends the object's text, in UTF-8, by calling `put`. NULL: the object is printed as #<name>. */
  bool (*print)(vs_scheme *vm, const void *object, bool (*put)(void *to, const char *s, size_t n), void *to);
  /* Passes the Scheme values in the object to the garbage collector, by calling `mark`. NULL: the object has none. If
   * it is not NULL, every collection calls it. */
  void (*trace)(vs_scheme *vm, void *object, void (*mark)(vs_scheme *vm, vs_value *slot));
  /* unused and always false, since the heap image contains no foreign objects */
  bool callable_image;
} vs_foreign_type;

/* Returns the host's pointer if v is a foreign object of this type, otherwise NULL. */
static inline void *vs_foreign_get(vs_value v, const vs_foreign_type *type) {
  return vs_is(v, VS_T_FOREIGN) && vs_as_foreign(v)->type == type ? vs_as_foreign(v)->object : NULL;
}

#endif
