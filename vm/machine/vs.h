/* Declares struct vs_scheme, the state of one interpreter. There are no global variables; two interpreters share
 * nothing. */
#ifndef VS_VM_MACHINE_VS_H
#define VS_VM_MACHINE_VS_H

#include "vm/values/debug.h"
#include "vm/values/value.h"

/* The symbols that C code compares, as members of vm->sym, such as vm->sym.quote. */
#define VS_SYMBOLS(S) \
  S(quote, "quote") S(quasiquote, "quasiquote") S(unquote, "unquote") S(unquote_splicing, "unquote-splicing") \
  S(error, "error") S(type, "type") S(range, "range") S(arity, "arity") S(contract, "contract") S(unbound, "unbound") \
  S(syntax, "syntax") S(read, "read") S(file, "file") S(limit, "limit") S(interrupt, "interrupt") S(memory, "memory") \
  S(divide, "divide") S(recursion, "recursion") S(raise, "raise") S(internal, "internal") S(stop, "stop") \
  S(self, "this")

/* The Scheme values to which C code refers, as members of vm->at. The heap image contains them. */
#define VS_ANCHORS(A) \
  A(symbols)       /* vector: hash table of the interned symbols, with open addressing */ \
  A(files)         /* vector of file names (strings), indexed by the file numbers of places; slot 0 is #f */ \
  A(libraries)     /* association list from a library's name to its environment (vm/front) */ \
  A(core)          /* the environment of the complete library (vm/front) */ \
  A(program)       /* environment of the program that the host runs */ \
  A(required)      /* list of (path . #t) for the files that require has loaded; #f instead of #t while a file is being
                    * loaded */ \
  A(checks)        /* queue of waiting checks (check_queue.h), or #t while a check runs */ \
  A(included)      /* list of pairs: number of a file, number of the file that includes it */ \
  A(lib)           /* values that vm/library keeps */ \
  A(nearby)        /* identifier table or #f, for messages: maps an undefined name to the most similar local name, or to
                    * itself if a let binds it */ \
  A(host)          /* values that bind/ keeps */ \
  A(standard_out) A(standard_in) A(standard_error)    /* output, input and error port of the standard streams */ \
  A(flat_names)    /* vector: constructors of flat records (symbols or #f), indexed by the record's tag */ \
  A(raise) A(check) A(throw) A(guarded) /* natives that the run loop itself calls */ \
  A(no_memory)     /* error object that is raised if there is no memory for a new error object */ \
  A(self_call)     /* KEYWORDS object of a call whose only keyword is #:this, which passes the object of a script's
                    * method call */ \
  A(stop)          /* procedure of the first activation on the stack, whose return ends the run loop */ \
  A(stops)         /* list of the error objects that represent stopped programs (step.h), the latest first */

/* The phases of a program's work. VS_VM_RUN: the program itself runs. */
typedef enum { VS_VM_READ, VS_VM_EXPAND, VS_VM_COMPILE, VS_VM_RUN } vs_vm_phase;

typedef struct vs_config {
  /* Allocates (p NULL), frees (bytes 0) or resizes memory. Returns NULL to refuse. If the member is NULL, realloc and
   * free are used. */
  void *(*memory)(void *user, void *p, size_t old_bytes, size_t bytes);
  void *user;
  size_t memory_limit;       /* limit of the interpreter's memory in bytes; 0: none */
  size_t stack_limit;        /* limit in bytes of the activations of nested calls; 0: 1 GB (256 MB where an address has
                              * 4 bytes), or a third of memory_limit if that is less */
  uint64_t step_limit;       /* greatest number of calls and loop iterations; 0: no limit */
  uint64_t output_limit;     /* greatest number of bytes that the program may print or write; 0: no limit */
  double time_limit;         /* limit of the running time in seconds, measured by the function `clock`; 0: none */
  bool keep_calls;          /* whether error objects keep the variables of the calls that led to them
                             * (vs_condition.calls) */
  /* Called when a phase begins. Returns the phase that ends. May be NULL. */
  vs_vm_phase (*phase)(void *user, vs_vm_phase phase);
  double (*clock)(void *user);                 /* returns monotonic time in seconds; NULL: the time limit is ignored */
  bool (*interrupted)(void *user);             /* called regularly; returns true once to interrupt the program */
  /* Tables of the host's natives, in addition to the VM's own. They end with NULL, and are in the order in which the
   * heap image was made. */
  const struct vs_native_table *const *tables;
  const struct vs_image *image;                /* heap image from which the interpreter starts, or NULL */
  /* Functions for files, console and time of day (port.h), which receive `user`; NULL: there are none. */
  const struct vs_io *io;
  const char *library_path;  /* folders for load, include, require and import, separated by ':', or NULL; the text must
                              * exist as long as the interpreter */
  const struct vs_shipped *shipped; /* libraries in Scheme that vs itself contains (source.h), or NULL */
  const char *const *command_line; size_t command_line_count; /* elements of the value of (command-line),
                                                               * command_line_count of them; 0: the value is ("vs").
                                                               * The texts must exist as long as the interpreter */
  /* Receives the value of a top-level expression of the program or of a file that it loads. Returns false with the
   * error set. May be NULL. */
  bool (*value)(vs_scheme *vm, vs_value v, vs_pos place);
  /* Receives a foreign object that a body of the program has computed but not used, or that is the first element of
   * such a list. Must not allocate in the heap. May be NULL. */
  void (*dropped)(vs_scheme *vm, vs_value v);
  /* Warns about a construct that is permitted but surely not intended. Must not allocate in the heap. May be NULL. */
  void (*warn)(vs_scheme *vm, vs_pos place, const char *message);
  /* Warns about a construct that is permitted but seldom intended, once for each place and kind (any constant text). A
   * NULL message means that this place needs no warning of this kind. May be NULL. */
  void (*suspect)(vs_scheme *vm, const char *kind, const char *message);
} vs_config;

/* The ways to step through a program (step.h). CONTINUE: without stops. ENTER: to the next call in the program's text.
 * OVER: to the next call in this activation or its callers. OUT: to the next call in its callers. SAME: repeats the way
 * of the previous step. */
typedef enum { VS_STEP_CONTINUE, VS_STEP_ENTER, VS_STEP_OVER, VS_STEP_OUT, VS_STEP_SAME } vs_step_mode;

typedef struct vs_stepping {
  uint8_t mode;              /* a vs_step_mode; with VS_STEP_CONTINUE the normal run loop is used */
  bool stops;                /* whether (break) stops the program */
  bool passes;               /* whether (break) also gives no warning; used if the member `stops` is false */
  uint8_t told;              /* a VS_TOLD_... value: the host's information about the stop at the next instruction */
  uint32_t first_file;       /* number of the first file that is not part of the library */
  uint64_t target;           /* greatest level of an activation (number of stack slots below it) in which stepping
                              * stops */
  uint64_t seen_level;       /* the instruction that was checked last: level of its activation, its code, its index in
                              * the code */
  const void *seen_code;
  uint32_t seen_at;
} vs_stepping;
enum { VS_TOLD_NOTHING, VS_TOLD_VALUE, VS_TOLD_CALL };

struct vs_gc_block;
struct vs_gc_large;
struct vs_roots;
struct vs_ast;
struct vs_cover_table;

struct vs_scheme {
  /* The nursery; objects are allocated from `free` to `end`. */
  char *free, *end;
  char *nursery;
  size_t nursery_bytes;

  /* The stack of the run loop (run_loop.c). Its working part contains the innermost activations. */
  vs_value *stack, *stack_end;     /* start and end of the stack's working part */
  vs_value *base, *top;            /* base: registers of the current activation; top: end of the slots in use, all of
                                    * which the garbage collector visits */
  vs_value under;                  /* STACK object with the activations below the stack's working part, or #f */
  uint64_t under_depth;            /* number of slots of `under` that belong to calls which have not returned */
  const uint32_t *pc;              /* pc of the current activation while a native or the garbage collector runs */

  /* Dynamic state of the program, which continuations contain. */
  vs_value winders, handlers, parameters;

  /* Data that natives and the run loop exchange (native.h). */
  const vs_native *native;         /* the running native, which error messages name, or NULL */
  vs_value call_procedure;
  bool call_self;            /* whether vm->call_args ends with the object of a method call, whose keyword is in
                              * vm->at.self_call */
  vs_value *call_args; size_t call_count, call_room;
  const struct vs_traceback *traceback; /* functions of activation.c that describe the running calls for errors */
  vs_value condition;              /* the raised object; set when a function returns false or VS_ERROR */
  vs_value value;                  /* result of the native that returned last */

  /* Counts of work and memory, which are compared with the limits. */
  int64_t fuel;                    /* number of turns (calls and loop iterations) until the next poll */
  uint32_t poll_turns;             /* number of turns between two polls; 0: the default */
  uint64_t work;                   /* steps reported by natives that are less than a turn */
  uint64_t steps;                  /* number of turns used up to the last poll */
  double started;
  uint64_t written;                /* number of bytes that the current evaluation has printed and written */
  bool over_limit;                 /* whether the last refusal of memory was due to the user's memory limit, and not to
                                    * the system */
  size_t fail_after;               /* for debugging: number of allocations that succeed before one fails; 0: none
                                    * fails */

  /* Data of the garbage collector (gc.c). */
  struct vs_roots *roots;
  struct vs_ast *asts;             /* list of the core trees that are being built or compiled; their constants are roots
                                    * of the garbage collector */
  struct vs_gc *gc;
  uint64_t captures;               /* number of continuations created so far; if it is unchanged after a call, no
                                    * continuation can return to the call a second time */
  uint64_t collections;            /* number of times that the nursery was emptied; while it is unchanged, the addresses
                                    * of young objects remain valid */
  double pause;                    /* duration of the longest collection so far, in seconds */
  size_t bytes, peak_bytes;        /* bytes: memory of this interpreter in bytes; peak_bytes: its greatest value so
                                    * far */

  /* Data that the host registers. */
  struct vs_flat_rules *flat;      /* types of flat records and their arithmetic (flat.h) */

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

  /* A counter of the expander. */
  uint64_t aliases;                /* number of aliases created, from which their hashes are computed */
  int64_t expansions;              /* number of top-level forms expanded */
  bool scripted;                   /* whether the first file of the program is in another language than Scheme */
  uint32_t program_file;           /* number of the file that the host runs, or 0 */
  uint64_t top_place;              /* vs_pos of the top-level form that began last, or of a macro use in this form */

  void *host;                      /* pointer for the program that embeds the interpreter */
  vs_config config;
  struct vs_cover_table *coverage; /* how often each form of the program has run, or NULL if nothing counts it */
};

/* Informs the host, by vm->config.phase, that the phase begins. Returns the previous phase. */
static inline vs_vm_phase vs_enter_phase(vs_scheme *vm, vs_vm_phase phase) {
  return vm->config.phase ? vm->config.phase(vm->config.user, phase) : phase;
}

#endif
