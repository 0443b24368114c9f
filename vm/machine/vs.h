/* Owns struct vs_scheme: the whole state of one interpreter. There are no globals; two interpreters share nothing. */
#ifndef VS_VM_MACHINE_VS_H
#define VS_VM_MACHINE_VS_H

#include "vm/values/debug.h"
#include "vm/values/value.h"

/* The symbols that C code compares, made once: vm->sym.quote and so on. A list. */
#define VS_SYMBOLS(S) \
  S(quote, "quote") S(quasiquote, "quasiquote") S(unquote, "unquote") S(unquote_splicing, "unquote-splicing") \
  S(error, "error") S(type, "type") S(range, "range") S(arity, "arity") S(contract, "contract") S(unbound, "unbound") \
  S(syntax, "syntax") S(read, "read") S(file, "file") S(limit, "limit") S(interrupt, "interrupt") S(memory, "memory") \
  S(divide, "divide") S(recursion, "recursion") S(raise, "raise") S(internal, "internal") S(stop, "stop") \
  S(self, "this")

/* Persistent Scheme values for C code. The heap image contains them. A list. */
#define VS_ANCHORS(A) \
  A(symbols)       /* vector: the interned symbols, open addressing */ \
  A(files)         /* vector of file names (strings), indexed by the files of positions; slot 0 is #f */ \
  A(libraries)     /* vm/front: name -> environment */ \
  A(core)          /* vm/front: the environment of the natives */ \
  A(program)       /* the host's program environment */ \
  A(required)      /* list of (path . #t) of the required files; #f in place of #t while a file is being loaded */ \
  A(checks)        /* the waiting checks (check_queue.h): none, a queue, or #t while a check runs */ \
  A(included)      /* list of (file number . number of the file with the include that read it) */ \
  A(lib)           /* vm/library: its persistent values */ \
  A(nearby)        /* identifier table or #f, for messages: undefined names -> a similar local name */ \
                   /* the same; names bound by a let with nothing around it -> themselves */ \
  A(host)          /* bind: its persistent values */ \
  A(standard_out) A(standard_in) A(standard_error)    /* ports */ \
  A(flat_names)    /* vector: tag -> constructor's name (symbol) or #f */ \
  A(raise) A(check) A(throw) A(guarded) /* natives that the run loop itself calls */ \
  A(no_memory)     /* the condition raised when there is no room to make one */ \
  A(self_call)     /* the keywords of a call with #:this, the object of a script's method call */ \
  A(stop)          /* procedure of the bottom activation */ \
  A(stops)         /* list of the conditions of stopped programs (step.h), the last one first */

/* phases of source text; RUN: the program itself */
typedef enum { VS_VM_READ, VS_VM_EXPAND, VS_VM_COMPILE, VS_VM_RUN } vs_vm_phase;

typedef struct vs_config {
  /* Supplies all memory: p NULL allocates, bytes 0 frees, else resizes; returns NULL to refuse. NULL: realloc and
   * free. */
  void *(*memory)(void *user, void *p, size_t old_bytes, size_t bytes);
  void *user;
  size_t memory_limit;       /* bytes, 0: none */
  uint64_t step_limit;       /* calls and loop turns, 0: none */
  uint64_t output_limit;     /* bytes that the program may print or write, 0: none */
  double time_limit;         /* seconds by the clock below, 0: none */
  bool keep_calls;          /* errors keep the parameters of the calls that they end (vs_condition.calls) */
  /* is called when a phase begins; returns the phase that ends; NULL: not needed */
  vs_vm_phase (*phase)(void *user, vs_vm_phase phase);
  double (*clock)(void *user);                 /* seconds, monotonic; NULL: no time limit */
  bool (*interrupted)(void *user);             /* polled; returns true once to interrupt */
  /* natives besides the VM's own, NULL-terminated; in the order of when the image was made */
  const struct vs_native_table *const *tables;
  const struct vs_image *image;                /* a heap image to start from, or NULL */
  /* files, console, time of day (port.h), called with `user`; NULL: none of them */
  const struct vs_io *io;
  const char *library_path;  /* folders for load, include, require, import, ':' between them, or NULL; lives like vm */
  const struct vs_shipped *shipped; /* libraries in Scheme that come with the language (program.h), or NULL */
  const char *const *command_line; size_t command_line_count; /* the result of (command-line); 0: "vs" alone; lives as
                                                               * long as the interpreter */
  /* Gets the value of a top-level expression of the program or of a file it loaded; returns false with the error set.
   * NULL: not needed. */
  bool (*value)(vs_scheme *vm, vs_value v, vs_pos place);
  /* Gets the foreign object, alone or first in a list, that was the value of an expression before a body's last one. It
   * may not allocate in the heap. NULL: not needed. */
  void (*dropped)(vs_scheme *vm, vs_value v);
  /* Warns of a construct that is allowed but surely not intended; the text lives until the call returns. It may not
   * allocate in the heap. NULL: not needed. */
  void (*warn)(vs_scheme *vm, vs_pos place, const char *message);
  /* Warns of a construct that is allowed but seldom intended, once for a place and a kind (any constant text). A NULL
   * message means that the place is never reported. NULL: not needed. */
  void (*suspect)(vs_scheme *vm, const char *kind, const char *message);
} vs_config;

/* How a program is stepped (step.h): not at all; to the next call of its own text; to the next in this activation or
 * its callers'; to the next in its callers'. SAME, for continuing: as before. */
typedef enum { VS_STEP_CONTINUE, VS_STEP_ENTER, VS_STEP_OVER, VS_STEP_OUT, VS_STEP_SAME } vs_step_mode;

typedef struct vs_stepping {
  uint8_t mode;              /* a vs_step_mode; CONTINUE: the plain run loop */
  bool stops;                /* (break) stops */
  bool passes;               /* else: (break) gives no warning either */
  uint8_t told;              /* a VS_TOLD_: the stop of the next instruction that the host has seen already */
  uint32_t first_file;       /* files with smaller numbers belong to the library */
  uint64_t target;           /* stepping does not stop in activations above this level */
  uint64_t seen_level;       /* the instruction last checked: its activation's level, its code, its index */
  const void *seen_code;
  uint32_t seen_at;
} vs_stepping;
enum { VS_TOLD_NOTHING, VS_TOLD_VALUE, VS_TOLD_CALL };

struct vs_gc_block;
struct vs_gc_large;
struct vs_roots;
struct vs_ast;

struct vs_scheme {
  /* the nursery: allocation from `free` to `end` */
  char *free, *end;
  char *nursery;
  size_t nursery_bytes;

  /* stack of the run loop (run_loop.c) */
  vs_value *stack, *stack_end;     /* the working stretch */
  vs_value *base, *top;            /* current activation's registers; first unused slot: all below is traced */
  vs_value under;                  /* STACK object with the activations below the working stretch, or #f */
  uint64_t under_depth;            /* number of its slots into which calls have yet to return */
  const uint32_t *pc;              /* of the current activation when a native or the collector runs */

  /* dynamic state, part of every continuation */
  vs_value winders, handlers, parameters;

  /* between a native and the run loop (native.h) */
  const vs_native *native;         /* the running native, named in error messages; NULL outside */
  vs_value call_procedure;
  bool call_self;            /* the last of call_args has the keyword of vm->at.self_call */
  vs_value *call_args; size_t call_count, call_room;
  const struct vs_traceback *traceback; /* the functions that give an error its running calls (activation.c) */
  vs_value condition;              /* the raised object, after a function returned false / VS_ERROR */
  vs_value value;                  /* a native's result */

  /* limits */
  int64_t fuel;                    /* turns until the next poll */
  uint64_t work;                   /* steps of builtins that do not make a turn yet */
  uint64_t steps;                  /* turns taken, up to the last poll */
  double started;
  uint64_t written;                /* bytes printed and written by this evaluation */
  bool over_limit;                 /* the limit, not the machine, last refused memory */
  size_t fail_after;               /* debug: refuse the n-th allocation from now; 0: off */

  /* collector (gc.c) */
  struct vs_roots *roots;
  struct vs_ast *asts;             /* trees being built or compiled: their constants are roots */
  struct vs_gc *gc;
  uint64_t captures;               /* continuations made; a call without a new one is entered once */
  uint64_t collections;            /* times that the nursery was emptied; young addresses are valid within one */
  size_t bytes, peak_bytes;        /* of the machine's memory, now and at most */

  /* registered by the host */
  struct vs_flat_rules *flat;      /* flat record types and their arithmetic (native.h) */

  struct {
#define S(field, text) vs_value field;
    VS_SYMBOLS(S)
#undef S
  } sym;
  struct {
#define A(field) vs_value field;
    VS_ANCHORS(A)
#undef A
  } at;

  vs_stepping step;

  /* expander */
  uint64_t aliases;                /* number of renamed identifiers made: their hash */
  int64_t expansions;              /* number of top-level forms expanded */
  bool scripted;                   /* the program begins with a file in another language */
  uint32_t program_file;           /* number of the file that the host runs; 0: none */
  uint64_t top_place;              /* vs_pos of the top-level form, or of the macro use in it, that began last */

  void *host;                      /* the embedder's own context */
  vs_config config;
};

/* Reports to the host that the phase begins; returns the phase before. */
static inline vs_vm_phase vs_enter_phase(vs_scheme *vm, vs_vm_phase phase) {
  return vm->config.phase ? vm->config.phase(vm->config.user, phase) : phase;
}

#endif
