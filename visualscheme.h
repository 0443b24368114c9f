/* Owns the public interface: embed a VisualScheme interpreter, run models in it, write what they draw.
 *
 *   vs_options o = vs_options_default();
 *   o.host.diagnose = print_it;
 *   vs_scheme *s = vs_new(&o);
 *   if (vs_eval_file(s, "house.vs", 0) == VS_OUTCOME_DONE) vs_write_drawing(s, "house.stl", NULL, NULL);
 *   vs_free(s);
 *
 * Conventions. Text is UTF-8; a (pointer, length) pair need not end in NUL, every other text does. A result of a
 * function or an argument of a callback belongs to the interpreter: texts from vs_..._get and arguments of callbacks
 * live until the next call on the same interpreter or until the callback returns; copy what you keep. Your arguments
 * are copied. Angles are radians, lengths model units, times seconds, lines and columns count from 1 (columns in
 * characters, not bytes).
 *
 * Failure. Nothing aborts, exits or jumps. A vs_outcome is the exit code that a command should end with; why something
 * failed has been told to `diagnose` before the call returns. After any failure the interpreter is usable, its memory
 * limit included.
 *
 * Threads. An interpreter is used by one thread at a time; different interpreters share nothing. vs_interrupt alone may
 * come from anywhere, a signal handler included. Callbacks run in the calling thread and must not call back into the
 * same interpreter, except vs_interrupt. */
#ifndef VISUALSCHEME_H
#define VISUALSCHEME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define VS_API __attribute__((visibility("default")))
#else
#define VS_API
#endif

#define VS_VERSION "0.1.0"

VS_API const char *vs_version(void); /* of the library, which may differ from the header's VS_VERSION */

typedef struct vs_scheme vs_scheme; /* an interpreter: its heap, its program, its drawing */

/* How a call ended. */
typedef enum {
  VS_OUTCOME_DONE = 0,
  VS_OUTCOME_MODEL = 1,         /* the model is at fault; the diagnostic says where */
  VS_OUTCOME_USAGE = 2,         /* bad arguments, or a file that cannot be read or written */
  VS_OUTCOME_WORKER = 3,        /* a worker program (POV-Ray, ...) is missing or failed */
  VS_OUTCOME_MACHINE = 4,       /* out of memory past the limits, and the like */
  VS_OUTCOME_STOPPED = -1,      /* no exit code: the program stands still in the middle, only with VS_EVAL_STOP;
      vs_stop_get says where, vs_resume goes on */
  VS_OUTCOME_INTERRUPTED = 130
} vs_outcome;

/* ---- diagnostics ---- */

typedef enum { VS_SEVERITY_ERROR, VS_SEVERITY_WARNING, VS_SEVERITY_NOTE } vs_severity;

typedef struct {
  const char *file;         /* as it was named when opened; NULL: nowhere in a source text */
  uint32_t line, column;    /* of the first character; 0: not known */
  uint32_t end_line, end_column; /* just past the last character; 0: not known, show one caret */
} vs_span;

typedef struct {
  vs_span at;
  const char *message; /* "called from (tower 5)", ... */
} vs_diagnostic_note;

typedef struct {
  vs_severity severity;
  vs_outcome outcome;      /* what kind of failure; DONE for warnings and notes */
  vs_span at;
  const char *message;     /* without place: "make-sphere: r must be positive, got -2" */
  const char *source_line; /* line `at.line` of the text without its newline; NULL: not known */
  const vs_diagnostic_note *notes; /* the user's own call chain, innermost first, then hints */
  size_t note_count;
} vs_diagnostic;

/* ---- progress ---- */

typedef struct {
  const char *phase;     /* "evaluating", "meshing", "rendering", ... in English, for a status line */
  const char *subject;   /* the output file or NULL */
  double fraction;       /* 0..1; negative: not known */
} vs_progress;

/* ---- the host ---- */

/* Every member may be NULL. `context` is handed to each. */
typedef struct {
  void *context;
  /* Text that the program prints (display, write ...). False: could not be written; the program gets an error. NULL: it
   * is dropped. */
  bool (*output)(void *context, const char *text, size_t length);
  /* A line for (read-line) and (read) from the program's console input, newline included; NULL at the end. Lives until
   * the next call. */
  const char *(*input)(void *context, size_t *length);
  void (*diagnose)(void *context, const vs_diagnostic *d);
  /* At most some ten times a second while something long is under way. */
  void (*progress)(void *context, const vs_progress *p);
  /* Polled every few milliseconds; true interrupts what runs. (vs_interrupt does the same from outside.) */
  bool (*poll)(void *context);
  /* A top-level expression's value, printed as the REPL shows it ("1/3 ; 0.333333"), when VS_EVAL_PRINT is set; once a
   * value. A long one ends in " ...". */
  void (*value)(void *context, const char *text, size_t length);
  /* Reads a whole source file for load, include, require, load-mesh and vs_eval_file. True: *text was allocated with
   * malloc and now belongs to the interpreter, which frees it. False: *why says so ("no such file"); static or living
   * until the next call. NULL: the file system. */
  bool (*read_file)(void *context, const char *path, char **text, size_t *length, const char **why);
  /* Gives each name in a folder to take, in any order, until that returns false, for directory-files. False: *why says
   * so, as above, or take returned false. NULL: the file system, where read_file is NULL too; else no folder is
   * read. */
  bool (*list_folder)(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                      void *to, const char **why);
} vs_host;

/* As realloc: new_size 0 frees, NULL is failure; old_size is what was asked for. */
typedef void *vs_alloc_fn(void *context, void *old, size_t old_size, size_t new_size);

typedef struct {
  vs_host host;
  vs_alloc_fn *alloc;     /* NULL: the C library's */
  void *alloc_context;
  double limit_time;      /* seconds of one evaluation, and of one output without its worker's; 0: no limit, here and
                           * below */
  size_t limit_memory;    /* bytes of heap and model together, and of what combining solids for an output takes beside
                           * them */
  uint64_t limit_steps;   /* calls and loop turns of one evaluation */
  size_t limit_output;    /* bytes that one evaluation may print */
  double limit_worker;    /* seconds of a worker program */
  size_t limit_triangles; /* of the mesh of one output */
  size_t cache;           /* bytes of results kept for later drawings and outputs (meshes): 0: 256 MB, or a quarter of
                           * limit_memory; SIZE_MAX: keep nothing */
  /* an error keeps its calls' parameters, for vs_call_get: a prompt's wish, it costs every error some time */
  bool keep_calls;
  bool untrusted;         /* no file access but read_file and list_folder, no native text */
  const char *library_path; /* folders for load, require and import, ':' between them, after the folders of the file
                             * that asks and of the program; NULL: none */
  /* what (command-line) gives: the program's name, then its arguments; 0: "vs" */
  const char *const *command_line; size_t command_line_count;
} vs_options;

VS_API vs_options vs_options_default(void);

/* NULL: out of memory. o NULL: the defaults. The data that o points to is copied, callbacks are called until
 * vs_free. */
VS_API vs_scheme *vs_new(const vs_options *o);
VS_API void vs_free(vs_scheme *s); /* NULL is fine */

/* Makes what runs now end soon (within some 50 ms) with VS_OUTCOME_INTERRUPTED; when nothing runs, the next call ends
 * so unless vs_interrupt_clear came first. Async-signal-safe, and the one function another thread may call. */
VS_API void vs_interrupt(vs_scheme *s);
VS_API void vs_interrupt_clear(vs_scheme *s);

/* ---- running programs ---- */

/* flags */
enum {
  VS_EVAL_PRINT = 1u,  /* hand the values of top-level expressions to `value` (the REPL) */
  /* the text is a whole program, as a file is: if it begins with an import it sees just what it imports; else
   * imports add */
  VS_EVAL_PROGRAM = 2u,
  /* with PRINT: the n-th value that is handed to `value` since vs_new or vs_restart gets the name $n; an object is
   * told in one line */
  VS_EVAL_NUMBER = 4u,
  /* (break) stops the program, with the outcome VS_OUTCOME_STOPPED; without this flag it warns and goes on */
  VS_EVAL_STOP = 8u,
  /* with STOP: stop before the first call in the text */
  VS_EVAL_STEP = 16u,
  /* where a program is stopped, expressions of the text see the variables of the place where it is (vs_eval_text) */
  VS_EVAL_WITHIN = 32u,
  /* (break) does nothing, and no warning says so: the text has run before */
  VS_EVAL_PASS = 64u,
  /* (check-expect ...) and the like wait for vs_check_next; without this flag and PASS they run at the text's end, and
   * those that fail are warnings */
  VS_EVAL_CHECK_LATER = 128u
};

/* Both evaluate every top-level form in the one program of this interpreter, in order, and stop at the first error.
 * Objects that top-level expressions return are remembered: they are the model if the program never draws. */
VS_API vs_outcome vs_eval_file(vs_scheme *s, const char *path, unsigned flags);
/* The other language that a file of this name is in, in words, as its ending says; it runs like any. NULL: it is in
 * this one. */
VS_API const char *vs_language_of(const char *path);
/* name: for diagnostics ("house.vs", "-e"); first_line: the number of the text's first line there. Relative loads start
 * at name's folder. */
VS_API vs_outcome vs_eval_text(vs_scheme *s, const char *name, unsigned first_line, const char *text, size_t length,
                               unsigned flags);

/* Begins anew, as after vs_new: definitions, what was required, parameters, drawing, camera and the like and random
 * numbers are forgotten. Values given by vs_parameter_set stay, and so do kept meshes, options, statistics. For running
 * a changed file, or the same with other parameters: what it writes then are the bytes of a fresh process, in the time
 * that the change takes. Out of memory: all is as it was. */
VS_API vs_outcome vs_restart(vs_scheme *s);

/* The program called (exit code): the evaluation ended there with VS_OUTCOME_DONE and nothing more should be run.
 * False: it did not. code: 0 for (exit) and (exit #t), 1 for (exit #f), else what was given. */
VS_API bool vs_exit_requested(const vs_scheme *s, int *code);

/* Is this text whole data that could be evaluated? For continuation lines and editors; evaluates and changes
 * nothing. */
typedef enum {
  VS_READ_EMPTY,      /* blanks and comments only */
  VS_READ_COMPLETE,
  VS_READ_INCOMPLETE, /* more text could complete it: an open parenthesis, string or comment */
  VS_READ_BAD         /* nothing that follows could make it right; line, column and message say why */
} vs_read_state;
typedef struct {
  vs_read_state state;
  unsigned depth;          /* INCOMPLETE: parentheses still open */
  unsigned line, column;   /* INCOMPLETE: of what was opened last; BAD: of the trouble; from 1 */
  const char *message;     /* BAD: "( is closed by ]"; else NULL */
} vs_read_status;
VS_API vs_read_status vs_read_check(vs_scheme *s, const char *text, size_t length);

/* Hands every name visible at top level that begins with prefix to `each`, sorted, until it returns false. Returns how
 * many were handed out. */
VS_API size_t vs_complete(vs_scheme *s, const char *prefix, bool (*each)(void *context, const char *name),
                          void *context);

/* ---- what a name means, for help and editors ---- */

typedef struct {
  const char *kind;     /* "procedure", "form" (if, define ...), "value" */
  /* how it is called, "(make-sphere c r)"; several ways a line each; "" where that is not known */
  const char *call;
  const char *keywords; /* "#:segments #:plane"; "": it has none */
  const char *doc;      /* half a line in English; "": there is none */
  const char *value;    /* a value as it is written, cut to a line; "" for procedures and forms */
  bool own;             /* the program or a library defines it, not the language */
  vs_span at;           /* where; file NULL: that is not known, or it is the language's */
} vs_name_info;
/* False: no such name is visible at top level. */
VS_API bool vs_name_get(vs_scheme *s, const char *name, vs_name_info *out);
/* The advice for a name that does not exist, as errors have it: "make-box is the name here: ...", "did you mean
 * make-box?"; "" where nothing comes to mind. */
VS_API const char *vs_name_advice(vs_scheme *s, const char *name);
/* The instructions that a procedure was compiled to, a line each, to `each` until it returns false. False: it is no
 * procedure of Scheme code. */
VS_API bool vs_disassemble(vs_scheme *s, const char *name, bool (*each)(void *context, const char *line),
                           void *context);

/* ---- programs that are stopped: by (break), or stepped through ---- */

/* While one is stopped, everything else may be evaluated; that may stop too, on top of it. vs_restart forgets them
 * all. */

typedef enum {
  VS_STOPPED_BREAK,       /* it called (break) */
  VS_STOPPED_CALL,        /* it is about to make a call */
  VS_STOPPED_VALUE        /* a call has given its value: told where one steps,
      to be gone on from at once with VS_RESUME_SAME */
} vs_stopped;
typedef struct {
  vs_stopped kind;
  vs_span at;             /* the expression, to its end where that is on the same line */
  const char *source_line; /* the line, or NULL */
  const char *procedure;  /* that the expression stands in; "" */
  const char *text;       /* CALL: "(area 3 4)", with the values of its arguments; VALUE: the value; BREAK: "" */
} vs_stop_info;
/* The texts live until the next call of any function of this interpreter. False: nothing is stopped. vs_call_get tells
 * of its calls until something else fails. */
VS_API bool vs_stop_get(vs_scheme *s, vs_stop_info *out);
/* How many are stopped, one on top of the other. */
VS_API size_t vs_stop_depth(const vs_scheme *s);

typedef enum {
  VS_RESUME_CONTINUE,     /* to the next (break) */
  VS_RESUME_ENTER,        /* to the next call, within what is called too */
  VS_RESUME_OVER,         /* to the next call in the same procedure or its callers */
  VS_RESUME_OUT,          /* to the next call in its callers */
  VS_RESUME_SAME          /* as before */
} vs_resume_way;
/* Goes on with what was stopped last: as vs_eval_text, with the flags that it was begun with. VS_OUTCOME_USAGE:
 * nothing is stopped. */
VS_API vs_outcome vs_resume(vs_scheme *s, vs_resume_way way);
/* Gives up what was stopped last. */
VS_API void vs_stop_drop(vs_scheme *s);

/* ---- the calls that the last error ended, with their variables (vs_options.keep_calls) ---- */

typedef struct {
  const char *procedure;  /* "": it has no name */
  const char *variables;  /* "n = 3, points = (...)": parameters, local and captured variables where it was */
  vs_span at;             /* the call it was in */
} vs_call_info;
/* Innermost first. False: there are no more, or there was no error. */
VS_API bool vs_call_get(vs_scheme *s, size_t index, vs_call_info *out);

/* ---- where time goes ---- */

/* Begins (on) or ends to look, every few milliseconds, which procedure runs. Beginning forgets what was seen before. */
VS_API void vs_profile(vs_scheme *s, bool on);
typedef struct { const char *procedure; vs_span at; double own, whole;
    /* shares of all looks: it ran itself; it or what it called ran */ } vs_profile_info;
/* Most time first. False: there are no more. *looks: how many there were. */
VS_API bool vs_profile_get(vs_scheme *s, size_t index, vs_profile_info *out, size_t *looks);

/* ---- parameters: what (define-parameter ...) made, as data for sliders and -D ---- */

typedef enum {
  VS_PARAMETER_BOOLEAN,
  VS_PARAMETER_INTEGER /* exact */,
  VS_PARAMETER_REAL,
  VS_PARAMETER_STRING,
  VS_PARAMETER_DATUM
} vs_parameter_type;
typedef struct {
  const char *name, *label, *group;     /* label: the name if none was given; group: "" if none */
  vs_parameter_type type;               /* the default's */
  const char *value, *default_value;    /* as written data; strings bare, without quotes */
  bool has_range;                       /* the three are set: numbers without choices */
  double min, max, step;                /* step 0: continuous */
  const char *const *choices;           /* written as value is; NULL: any */
  size_t choice_count;
  vs_span at;
  const char *unit;                     /* what stands behind the number, as "m"; "" if none was given */
  bool has_min, has_max;                /* the program says min, max; an end that it does not say goes by the default */
} vs_parameter_info;

/* Sets what a later (define-parameter name ...) will hold. datum is one datum, read and never evaluated, or bare text
 * where the default is a string. False: the name or the datum cannot be read (a diagnostic has said so). A value that
 * the definition then refuses (another type, out of range, not a choice) ends the evaluation with VS_OUTCOME_USAGE. */
VS_API bool vs_parameter_set(vs_scheme *s, const char *name, const char *datum);
/* Forgets what vs_parameter_set gave: a later (define-parameter name ...) holds its default. */
VS_API void vs_parameter_unset(vs_scheme *s, const char *name);
VS_API size_t vs_parameter_count(const vs_scheme *s);
VS_API bool vs_parameter_get(vs_scheme *s, size_t index, vs_parameter_info *out);
/* A name that vs_parameter_set gave and no define-parameter took so far, or NULL past the last. */
VS_API const char *vs_parameter_unused(const vs_scheme *s, size_t index);

/* ---- the drawing ---- */

typedef struct {
  size_t objects;                 /* drawn (or returned), each counted once a placement */
  size_t solids, surfaces, regions, curves; /* those of the objects; a mixed union counts as solid */
  bool has_bounds;                /* false: empty, or only infinite lines */
  double min[3], max[3];
  bool bounds_at_most;            /* what is cut is bounded by what it is cut from: to work out the result would take
                                   * long */
  const char *units;              /* "m" by default */
  /* no objects: what the program defines and never calls, "the program defines ..."; else NULL */
  const char *advice;
} vs_summary;
VS_API vs_outcome vs_drawing_summary(vs_scheme *s, vs_summary *out);

/* The names of the views that the model has made, (view "name" ...), in their order; NULL past the last. */
VS_API const char *vs_view_name(const vs_scheme *s, size_t index);

/* Has the interpreter read what stands at path: a program, a picture, a mesh, data, under this name or another? Writing
 * there is refused (VS_OUTCOME_USAGE) by everything that this library writes; a host asks before it writes itself. */
VS_API bool vs_is_input(const vs_scheme *s, const char *path);
/* The names of the files that it has read, in their order; NULL past the last. */
VS_API const char *vs_input_name(const vs_scheme *s, size_t index);
/* Notes a file that the host read itself, for vs_is_input. False: out of memory. */
VS_API bool vs_note_input(vs_scheme *s, const char *path);

VS_API void vs_drawing_clear(vs_scheme *s); /* as (erase-all); forgets returned objects too */

/* ---- what differs between two drawings ----
 *
 * vs_drawing_keep after the first program, vs_restart, then the second program and vs_drawing_compare. Parts are what
 * stands in unions, placements, materials and layers: primitives, sweeps, differences ... */

/* Keeps what is drawn now, for vs_drawing_compare; vs_restart leaves it kept. Outputs that were kept before are let
 * go. */
VS_API vs_outcome vs_drawing_keep(vs_scheme *s);

typedef enum {
  VS_PART_WAS_ADDED, VS_PART_WAS_REMOVED,
  VS_PART_WAS_CHANGED,   /* made of the same kinds of things, painted alike, with other numbers */
  VS_PART_WAS_MOVED,     /* the same shape in another place */
  VS_PART_WAS_REPAINTED  /* the same shape in the same place, with another material or on another layer */
} vs_part_difference;

typedef struct {
  const char *layer, *material; /* names; "" where there is none */
  const char *text;             /* the expression that makes it, cut to a line */
  vs_span at;                   /* the place in the program that made it; file NULL: not known */
} vs_part_info;

typedef struct {
  size_t same, repainted, moved, changed, added, removed; /* parts */
  double volume_before, volume_after; /* of all solids together */
  double volume_added, volume_removed; /* of what only the second drawing has; of what only the first has */
} vs_comparison;

/* Compares what was kept with what is drawn now. Parts that differ go to `each`, in order, those that were removed
 * first, until it returns false; *out is filled by then. before is NULL of one that was added, after of one that was
 * removed. Nothing kept counts as an empty drawing. The found values stay for vs_output_options.change until the next
 * comparison. */
VS_API vs_outcome vs_drawing_compare(vs_scheme *s, vs_comparison *out,
                                     bool (*each)(void *context, vs_part_difference what, const vs_part_info *before,
                                                  const vs_part_info *after),
                                     void *context);

/* ---- checks: (check-expect expression value) and the like ---- */

typedef struct {
  vs_span at;
  bool passed;
  const char *form;       /* "check-expect" ... */
  const char *expression; /* as it is written, cut to a line */
  const char *gives;      /* what it gave: a value as an expression, or "an error: ..." */
  const char *expected;   /* what it should have given */
} vs_checked;

typedef struct {
  void *context;
  void (*told)(void *context, const vs_checked *result); /* the texts live until it returns */
  /* behind it, of a check that failed in objects: their parts that differ, as in vs_drawing_compare; before is what was
   * expected. Or NULL. */
  bool (*part)(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after);
} vs_check_listener;

/* Does a check wait, of what ran with VS_EVAL_CHECK_LATER since vs_new or vs_restart? */
VS_API bool vs_check_waits(const vs_scheme *s);
/* Runs the oldest check that waits, with limits of its own, whatever became of the program; the drawing stays as it is.
 * Done: it was told, passed or failed. An interrupt ends it: nothing was told. */
VS_API vs_outcome vs_check_next(vs_scheme *s, const vs_check_listener *listener);
/* A form of the checks that the program has defined anew, so that its uses are no checks; NULL: none. */
VS_API const char *vs_check_redefined(vs_scheme *s);

/* ---- fitting a model to a scan ----
 *
 * vs_fit runs the program again and again, until the points of a scan lie as near to its solids as they can: it looks
 * for the values of the program's parameters, and for the place of the scan. Values given by vs_parameter_set before
 * are the start. Afterwards the program has run with the values found, and vs_parameter_set has them. */

typedef struct {
  bool placed;   /* the scan lies where the model does, and is not moved */
  bool near;     /* it lies about there: no other place is tried */
  bool any_pose; /* up in the scan need not be up in the model */
  const char *const *held;
  size_t held_count; /* names of parameters that keep their values */
  size_t points;     /* of the scan, that the last steps use at most; 0: 20,000 */
  double confidence; /* of the intervals, between 0 and 1; 0: .95 */
} vs_fit_options;
VS_API vs_fit_options vs_fit_options_default(void);

typedef enum {
  VS_FIT_FITTED,
  VS_FIT_HELD,        /* it was to keep its value */
  VS_FIT_NO_NUMBER,   /* its default is exact, or no number: it keeps its value */
  VS_FIT_AT_BOUND,    /* fitted, and stopped by #:min or #:max */
  VS_FIT_UNDETERMINED /* the scan does not say what it is: by half of itself more or less, nothing would change much */
} vs_fit_state;
typedef struct {
  const char *name;
  vs_fit_state state;
  double start, value;
  double error;     /* standard error; infinite where undetermined, 0 where it keeps its value */
  double low, high; /* the interval of that confidence */
} vs_fit_parameter;

typedef struct {
  size_t points, nowhere; /* of the file; those without a finite place, which are left out */
  size_t samples,
      used; /* places that were measured: the points, or, of a mesh, spread over its faces; used in the last step */
  size_t outliers; /* samples further off than 4.685 spreads, which had no say */
  double spread;   /* 1.4826 times the median distance: the standard deviation where errors are normal */
  double median, root_mean_square; /* of the distances of all samples */
  double correlation;              /* of the distances of neighbours: near 0 where they are mere noise */
  double size;                     /* of the scan: the root of the mean square distance from its centre */
  double place[3][4];              /* from the model's coordinates to the scan's */
  const char *doubt; /* why it is not trusted: "far" "tilted" "strays" "shape" "rival"; or "none" */
  bool converged;                  /* false: the last step still moved */
  unsigned iterations, runs;       /* times that all distances were measured; runs of the program */
  const char *units;
} vs_fit_result;

/* Fits the program in the file `model` to the scan in the file `scan` (.ply .obj .off .stl; a cloud or a mesh). *out is
 * filled, and stays until the next vs_fit, where anything was found: with VS_OUTCOME_DONE; with VS_OUTCOME_MODEL and
 * result.samples above 0, where what was found is not trusted (result.doubt);
 * with VS_OUTCOME_INTERRUPTED (or VS_OUTCOME_MACHINE, past
 * limit_time) and result.samples above 0, where it is the best so far. Doubts about it are told as warnings.
 */
VS_API vs_outcome vs_fit(vs_scheme *s, const char *model, const char *scan, const vs_fit_options *o,
                         vs_fit_result *out);
/* The parameters of the last fit, in the program's order. False: no such index. */
VS_API bool vs_fit_parameter_get(const vs_scheme *s, size_t index, vs_fit_parameter *out);
/* The signed distances of the scan's points from the fitted model, below 0 inside, in the file's order; NaN of a point
 * that is nowhere. They live until the next vs_fit. NULL: there was no fit. */
VS_API const double *vs_fit_distances(const vs_scheme *s, size_t *count);
/* Writes the scan with colours by these distances, as .ply or .x3d by the path's ending: blue at -range, grey at 0, red
 * at range. range 0: what 98 of 100 points lie within. *used: the range. */
VS_API vs_outcome vs_fit_map(vs_scheme *s, const char *path, double range, double *used);

/* Output formats. The list is constant and the library's. */
typedef struct {
  const char *name;    /* "povray", for --format beside the suffix */
  const char *suffix;  /* "pov", without the dot */
  const char *doc;     /* half a line in English */
  const char *worker;  /* the program that must be installed, or NULL */
  bool binary;
} vs_format_info;
VS_API const vs_format_info *vs_format_list(size_t *count);
VS_API const char *vs_format_endings(void); /* ".pov .png ...", for messages */
/* "stl", ".stl", "out/a.stl" or a name; NULL: none such */
VS_API const vs_format_info *vs_format_find(const char *name_or_suffix);

/* The same among those and the formats that the program of this interpreter has brought (define-back-end). The data at
 * *out lives until the next evaluation. False: none such. */
VS_API bool vs_format_of(const vs_scheme *s, const char *name_or_suffix, vs_format_info *out);

/* Optimisation passes by name; bit i of a mask is the i-th name. */
#define VS_PASSES_ALL (~0u)
VS_API const char *const *vs_pass_list(size_t *count);

typedef enum { VS_QUALITY_DRAFT, VS_QUALITY_GOOD, VS_QUALITY_FINAL } vs_quality;

/* How linear light becomes the numbers of a screen: the manual's page 'Pictures' names the formulas' sources. */
typedef enum { VS_CURVE_NEUTRAL, VS_CURVE_AGX, VS_CURVE_FILMIC, VS_CURVE_LINEAR } vs_curve;
typedef struct {
  vs_curve curve;
  bool fixed;            /* exposure is over the light as it is; else over what the picture's histogram asks for */
  double exposure;       /* stops (EV): each doubles the light */
} vs_development;

typedef struct {
  int width, height;     /* pixels; 0: 1024 by 768, or what keeps 4:3 with the other */
  vs_quality quality;
  vs_development development; /* of a .png */
  bool layers;           /* an .exr has depth, normal, albedo, id, material and ambient occlusion as well */
  const char *view;      /* the name of one of the model's views, or NULL; "*": all of them, on a drawing's sheet */
  bool has_camera;       /* over what the model and the view say */
  double camera[7];      /* eye, target, lens in mm of a 35 mm film */
  bool has_sun;          /* over what the model says */
  double sun[2];         /* azimuth from north by east and altitude, degrees */
  double tolerance;      /* chord height in model units; 0: the model's, or the rule's */
  int segments;          /* facets a turn; 0: by tolerance */
  unsigned passes;       /* a mask; VS_PASSES_ALL by default */
  bool count;            /* count nodes, and commands with and without each pass, for the statistics: the passes run
                          * once more for each */
  bool strict;           /* what the format leaves out, or shows otherwise than modelled, is an error instead of a
                          * warning */
  bool change;           /* what vs_drawing_compare found, in place of the drawing: green was added, red removed */
  bool last;             /* no drawing and no output follows: nothing is kept for them */
  int crop[4];           /* of a .png or .exr, the part that is made: left, top, width, height in pixels; all 0: the
                          * whole */
} vs_output_options;
VS_API vs_output_options vs_output_options_default(void);

/* Writes the drawing to path; what stood there stays until the new file is whole and on disk. format: a name or suffix;
 * NULL: by the path's ending. o NULL: the defaults. Formats with a worker run it, tell `progress`, and stop it when
 * interrupted. */
VS_API vs_outcome vs_write_drawing(vs_scheme *s, const char *path, const char *format, const vs_output_options *o);
/* The same into a callback, in pieces; false from it ends the writing with VS_OUTCOME_USAGE. Formats of several files
 * refuse. */
VS_API vs_outcome vs_write_drawing_to(vs_scheme *s, const char *format, const vs_output_options *o,
                                      bool (*write)(void *context, const void *bytes, size_t count), void *context);

/* ---- pictures in linear light: EXR files ----
 *
 * Of a picture red, green and blue (R, G, B) are read, else its luminance (Y). A written file appears whole or not at
 * all. Paths are the file system's, whatever the host reads programs from. */

/* Develops a picture: a PNG. how NULL: as vs_output_options_default has it. *stops: by how many it was brightened. */
VS_API vs_outcome vs_picture_tone(vs_scheme *s, const char *from, const char *to, const vs_development *how,
    double *stops);
/* Luminance as false colours with a legend, by its logarithm: a PNG. unit: cd/m2 of the number 1. *least, *most: the
 * legend's ends. */
VS_API vs_outcome vs_picture_false_color(vs_scheme *s, const char *from, const char *to, double unit, double *least,
    double *most);

/* The same of the illuminance of floors, from a picture with the layers of albedo and normal. unit: as above, so that
 * it is lux. */
VS_API vs_outcome vs_picture_illuminance(vs_scheme *s, const char *from, const char *to, double unit, double *least,
    double *most);

typedef struct {
  double color[3];       /* linear light */
  double depth;          /* channel Z; a NaN: the picture has none */
  bool has_normal;       /* channels N.X, N.Y, N.Z */
  double normal[3];
  long id;               /* channel id; 0: nothing was met there; negative: the picture has no such channel */
  char place[512];       /* "house.vs:12:3", what made it; "": not known */
  char material[128];    /* its name, "#rrggbb" of a plain colour; "": none */
  double openness;       /* channel AO: 1 on an open field, 0 in a crack; a NaN: the picture has none */
  double illuminance;    /* of a matt surface, in the picture's numbers; a NaN: not known */
} vs_picture_point;
/* The data that a picture has of a pixel, columns and rows counted from 0 at the upper left. */
VS_API vs_outcome vs_picture_pick(vs_scheme *s, const char *from, long column, long row, vs_picture_point *out);

typedef struct {
  uint32_t columns, rows;
  double most, mean, root_mean_square; /* differences of red, green and blue in linear light */
  long column, row;      /* of the largest */
  double psnr;           /* dB, where 1 is the peak; infinite: equal */
  double ssim;           /* structural similarity of the developed pictures, 1: equal */
} vs_picture_difference;
/* How far two pictures of one size are apart. to: a PNG of the differences in false colours; NULL: none. */
VS_API vs_outcome vs_picture_compare(vs_scheme *s, const char *a, const char *b, const char *to,
    vs_picture_difference *out);
/* Takes noise out, into another EXR with the same channels. *layers: by albedo and normal; else by the colours
 * alone. */
VS_API vs_outcome vs_picture_denoise(vs_scheme *s, const char *from, const char *to, bool *layers);

/* ---- the sun through a day ---- */

typedef struct {
  double latitude, longitude; /* degrees, north and east positive */
  int year, month, day;
  double from, to, step; /* hours of mean local time, 0 to 24 */
} vs_sun_span;
typedef struct { size_t pictures, faces, dark; /* steps in which the sun is below the horizon */ } vs_sun_summary;
/* Writes into the folder, which is made where there is none: hours.csv, the hours of sun of every face of the drawing's
 * solids; hours-plan.png and hours-model.png, the same in false colours from above and as the camera looks;
 * shadow-001.png and so on, a picture for the middle of each step with the sun up (drafts but for VS_QUALITY_FINAL),
 * and shadows.png, all of them on a sheet. Without POV-Ray the hours are written, and the outcome is
 * VS_OUTCOME_WORKER. */
VS_API vs_outcome vs_sun_study(vs_scheme *s, const vs_sun_span *span, const char *folder, const vs_output_options *o,
    vs_sun_summary *out);

/* ---- formats of the host's own ----
 *
 * A format is a table of callbacks, one for each kind of thing that it has words for. The library walks the drawing
 * as for its own formats: sections and the
 * like are worked out, the passes have run, and what has no callback is made simpler until it is of a kind that has
 * one: curves become
 * "line", everything else in the end "polyface-mesh", which therefore must be there. Curves are left out, which is
 * said, where there is no "line". */

typedef struct vs_output vs_output; /* the file being written; valid in callbacks alone */

typedef enum {
  VS_THING_LEAF,  /* a primitive, or a profile with its sweep: it comes once */
  VS_THING_ENTER, /* an operation ("unite", "intersect", "subtract", "transform" ...): before what is in it */
  VS_THING_LEAVE  /* behind it */
} vs_thing_phase;

typedef struct {
  const char *kind;      /* as object-kind answers: "sphere" */
  vs_thing_phase phase;
  size_t child_count;    /* at VS_THING_ENTER: how many things follow before VS_THING_LEAVE */
  /* from the thing's coordinates to the drawing's: a row each of x, y and z, the shift last; of an operation, those
   * of what is in it */
  double place[3][4];
  bool painted;
  double color[4];       /* sRGB and opacity, 0 to 1, where it is painted */
  const char *material, *layer; /* names; "" where there is none */
  const char *file;      /* the place in the program that made it; NULL: not known */
  uint32_t line, column;
  const void *thing;     /* the library's own */
} vs_thing;

typedef enum {
  VS_KIND_WRITTEN,
  VS_KIND_WHOLE,   /* at VS_THING_ENTER: written with all that is in it, which is not gone into */
  VS_KIND_SIMPLER, /* not this one: the library is to make it simpler. Nothing may have been written */
  VS_KIND_FAILED   /* with vs_output_fail, which says why */
} vs_kind_status;

typedef struct {
  const char *kind;
  vs_kind_status (*write)(void *context, vs_output *out, const vs_thing *thing);
} vs_format_kind;

typedef struct {
  const char *name, *suffix, *doc; /* as in vs_format_info; doc may be NULL */
  bool binary;
  const vs_format_kind *kinds;
  size_t kind_count;
  bool (*begin)(void *context, vs_output *out); /* round all things; false: failed. NULL: nothing */
  bool (*end)(void *context, vs_output *out);
  void *context;                   /* handed to the callbacks; must live as long as the interpreter */
} vs_format_own;

/* Adds a format to this interpreter: -o file.suffix and its name mean it from then on, and the newest of several.
 * False: the name or suffix is one of the library's or
 * none at all, a kind is none, "polyface-mesh" is missing, or memory is. */
VS_API bool vs_register_format(vs_scheme *s, const vs_format_own *format);

/* For callbacks. Each returns false where the output has failed; then the callback returns VS_KIND_FAILED or false. */
VS_API bool vs_output_write(vs_output *out, const void *bytes, size_t count);
VS_API bool vs_output_print(vs_output *out, const char *text);
/* the shortest text of 12 significant digits, as all formats have it */
VS_API bool vs_output_number(vs_output *out, double x);
/* a fault of the model at the thing's place; returns false */
VS_API bool vs_output_fail(vs_output *out, const char *message);

/* The numbers in a field of the thing, under the name that the tree dump (-o x.tree) shows: a number, flag (0 or 1),
 * point (3 numbers), list of points or matrix. Copies at
 * most room of them to out, returns how many there are; 0: it has no such field. */
VS_API size_t vs_thing_numbers(const vs_thing *t, const char *field, double *out, size_t room);
VS_API const char *vs_thing_text(const vs_thing *t, const char *field); /* NULL: it has no such field of text */
/* The thing as triangles in its own coordinates, counter-clockwise from outside, as fine as the output asks; also of
 * an operation, with all in it. The arrays
 * live until the next call. False: failed. */
typedef struct {
  const double (*points)[3];
  size_t point_count;
  const uint32_t (*corners)[3];
  size_t count;
} vs_triangles;
VS_API bool vs_thing_triangles(vs_output *out, const vs_thing *t, vs_triangles *result);

/* ---- meshes for hosts that draw ----
 *
 * vs_meshes_begin works out what the drawing is, the scene's nodes with it, as triangles and curves; then vs_mesh_next
 * hands over, one by one, what differs from what it handed over before: first what is gone, then what is new or stands
 * elsewhere. Equal shapes are one mesh with several places. A shape that the host has is not meshed again; what is
 * round is another mesh where it is to be finer, as it may be in a larger drawing. */

typedef enum {
  VS_MESH_REMOVED, /* the id alone is told */
  VS_MESH_CHANGED, /* it stands elsewhere: the id and all its places are told */
  VS_MESH_ADDED
} vs_mesh_change;

typedef struct {
  const char *material;  /* its name; "" where it has none */
  uint64_t material_id;  /* what vs_material_handler's procedure gave for the name; 0: none */
  bool painted;          /* false: no material was given, and what follows is a matt grey */
  double color[4];       /* sRGB and opacity, 0 to 1 */
  double roughness, metallic, ior;
  const char *layer;     /* "": none */
  const char *file;      /* the place in the program that made it; NULL: not known */
  uint32_t line, column;
} vs_mesh_part;

typedef struct {
  vs_mesh_change change;
  uint64_t id;           /* equal for equal shapes of one fineness and paint, in every run */
  const double (*points)[3]; size_t point_count;
  /* counter-clockwise from outside; none: points are a curve's, in their order */
  const uint32_t (*corners)[3]; size_t triangle_count;
  /* A unit normal for each corner of each triangle: round where the shape is round, sharp at its creases. */
  const double (*normals)[3]; size_t normal_count; const uint32_t (*normal_corners)[3];
  const uint32_t *part_of; /* of each triangle; NULL: all are of the first */
  const vs_mesh_part *parts; size_t part_count;
  /* From the mesh's coordinates to the drawing's: a row each of x, y and z, the shift last. */
  const double (*places)[3][4]; size_t place_count;
} vs_mesh_info;

/* o NULL: the defaults. After a failure the host has what it had. An empty drawing is one, as for vs_write_drawing; yet
 * vs_mesh_next then tells of what is gone. */
VS_API vs_outcome vs_meshes_begin(vs_scheme *s, const vs_output_options *o);
/* False: that was all. The arrays live until the next call; the host that keeps them makes the one copy. */
VS_API bool vs_mesh_next(vs_scheme *s, vs_mesh_info *out);
VS_API void vs_meshes_forget(vs_scheme *s); /* the next round hands over everything; the material handler goes, too */
/* The procedure is asked once for each material's name, in vs_mesh_next, and gives the host's own number for it. */
VS_API void vs_material_handler(vs_scheme *s, uint64_t (*ask)(void *context, const char *name), void *context);

/* ---- values that a host holds ----
 *
 * A handle stands for a value of the interpreter: a number, a text, an object, a node. It keeps the value until it is
 * released as often as it was made and retained; vs_restart ends all. 0 is no handle: a function that gives one gives 0
 * where it failed, and has told `diagnose`. A handle that was released, or another interpreter's, is an error and
 * changes nothing.
 *
 * While a program runs, what it calls back may make, read and release handles and call vs_post; everything that would
 * run something in the same interpreter is refused with VS_OUTCOME_USAGE. */

typedef uint64_t vs_handle;

typedef enum {
  VS_HANDLE_NONE, /* the handle is none */
  VS_HANDLE_BOOLEAN, VS_HANDLE_NUMBER, VS_HANDLE_TEXT, VS_HANDLE_SYMBOL,
  VS_HANDLE_LIST, /* one that ends: a pair such as (1 . 2) is VS_HANDLE_OTHER */ VS_HANDLE_POINT,
      VS_HANDLE_VECTOR,
  VS_HANDLE_MATRIX, VS_HANDLE_OBJECT, VS_HANDLE_NODE, VS_HANDLE_PROPERTY, VS_HANDLE_PROCEDURE, VS_HANDLE_OTHER,
  VS_HANDLE_HOST /* what vs_handle_host made */
} vs_handle_kind;

VS_API vs_handle vs_handle_retain(vs_scheme *s, vs_handle h); /* gives h */
VS_API void vs_handle_release(vs_scheme *s, vs_handle h);     /* 0 is fine */

VS_API vs_handle vs_handle_boolean(vs_scheme *s, bool b);
VS_API vs_handle vs_handle_number(vs_scheme *s, double x);
VS_API vs_handle vs_handle_integer(vs_scheme *s, int64_t n); /* exact */
/* The number of that text, as a program writes it: "1/3", an integer of any size. 0: it is none, or memory is out. */
VS_API vs_handle vs_handle_number_text(vs_scheme *s, const char *text);
VS_API vs_handle vs_handle_text(vs_scheme *s, const char *text);
VS_API vs_handle vs_handle_text_bytes(vs_scheme *s, const char *text, size_t length); /* may hold zero bytes */
VS_API vs_handle vs_handle_symbol(vs_scheme *s, const char *name);
VS_API vs_handle vs_handle_point(vs_scheme *s, double x, double y, double z);
VS_API vs_handle vs_handle_vector(vs_scheme *s, double x, double y, double z);
VS_API vs_handle vs_handle_list(vs_scheme *s, const vs_handle *items, size_t count);

/* An object of the host's own: programs hand it around and cannot look into it. As the value of a property it goes
 * where the node goes. Owned: release is called with it once nothing holds it any more, at the end of a later
 * evaluation, by vs_restart or by vs_free; it may call nothing of the interpreter. Not owned: release is NULL, and the
 * object has to live as long as the interpreter. */
VS_API vs_handle vs_handle_host(vs_scheme *s, void *object, void (*release)(void *context, void *object),
    void *context);
VS_API void *vs_handle_get_host(vs_scheme *s, vs_handle h); /* NULL: it is none */

VS_API vs_handle_kind vs_handle_kind_of(vs_scheme *s, vs_handle h);
VS_API bool vs_handle_get_boolean(vs_scheme *s, vs_handle h); /* all but #f is true */
/* The numbers of a number (1), point, vector (3) or matrix (16, row by row): copies at most room of them, returns how
 * many there are; 0: it is none of these. */
VS_API size_t vs_handle_get_numbers(vs_scheme *s, vs_handle h, double *out, size_t room);
VS_API bool vs_handle_is_exact(vs_scheme *s, vs_handle h); /* an exact number: its text has all digits */
/* Of a text or symbol, and of a number as a program writes it; lives until the next call of this function or the next
 * one. NULL: it is none of these. */
VS_API const char *vs_handle_get_text(vs_scheme *s, vs_handle h);
VS_API const char *vs_handle_get_text_bytes(vs_scheme *s, vs_handle h, size_t *length); /* may hold zero bytes */
VS_API size_t vs_handle_count(vs_scheme *s, vs_handle list); /* 0: it is no list */
VS_API vs_handle vs_handle_item(vs_scheme *s, vs_handle list, size_t index);
VS_API bool vs_handle_same(vs_scheme *s, vs_handle a, vs_handle b); /* do both stand for one and the same (eq?) */

/* A name of the program or of the language; a procedure of either, called. An error of the program is told and has no
 * result. result may be NULL. */
VS_API vs_handle vs_lookup(vs_scheme *s, const char *name);
VS_API bool vs_define(vs_scheme *s, const char *name, vs_handle value);
VS_API vs_outcome vs_apply(vs_scheme *s, vs_handle procedure, const vs_handle *arguments, size_t count,
    vs_handle *result);

/* A procedure of the host's. The arguments are released after it; *result, 0 at first, is a handle that it gives away,
 * or stays 0 for no value. False: the program gets an error, whose text vs_host_fail gave. context must live as long as
 * the interpreter. name: for messages. */
typedef bool vs_host_fn(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result);
VS_API vs_handle vs_host_procedure(vs_scheme *s, const char *name, vs_host_fn *fn, void *context);
VS_API void vs_host_fail(vs_scheme *s, const char *message);

/* ---- the scene: nodes, as the manual's page 'Scenes' has them ----
 *
 * Each function does what the procedure beside it does, with the same rules and messages. */

VS_API vs_handle vs_scene_controller(vs_scheme *s); /* (node-controller): its properties are the events */
VS_API vs_handle vs_node_root(vs_scheme *s);
/* (node-create type #:name name #:parent parent); type NULL: 'context; name NULL: none; parent 0: none */
VS_API vs_handle vs_node_create(vs_scheme *s, const char *type, const char *name, vs_handle parent);
VS_API vs_handle vs_node_find(vs_scheme *s, const char *name); /* 0: there is none, which is no error */
VS_API vs_handle vs_node_parent(vs_scheme *s, vs_handle node); /* 0: it hangs nowhere */
VS_API vs_handle vs_node_children(vs_scheme *s, vs_handle node); /* a list */
VS_API const char *vs_node_name(vs_scheme *s, vs_handle node); /* as vs_handle_get_text; NULL: it has none */
VS_API vs_outcome vs_node_add_child(vs_scheme *s, vs_handle parent, vs_handle child);
VS_API vs_outcome vs_node_remove_child(vs_scheme *s, vs_handle parent, vs_handle child);
/* Three numbers each; the turn in degrees about X, Y and Z. NULL: as it is. */
VS_API vs_outcome vs_node_place(vs_scheme *s, vs_handle node, const double *translate, const double *degrees,
    const double *scale);
/* Into the parent's coordinates, or the world's: row by row, for column vectors. */
VS_API bool vs_node_matrix(vs_scheme *s, vs_handle node, bool world, double out[16]);
VS_API vs_outcome vs_node_set_drawing(vs_scheme *s, vs_handle node, vs_handle drawing); /* an object, or a list */
VS_API vs_handle vs_node_object(vs_scheme *s, vs_handle node); /* all that it shows */

/* The focus, whose drawing draw adds to; the root's cannot be ended. */
VS_API vs_outcome vs_node_begin(vs_scheme *s, vs_handle node);
VS_API vs_outcome vs_node_end(vs_scheme *s);
VS_API vs_handle vs_node_focus(vs_scheme *s);
/* Evaluates the text's expressions in the node's own program, with its focus. *result: the last value. */
VS_API vs_outcome vs_node_eval(vs_scheme *s, vs_handle node, const char *text, vs_handle *result);

/* ---- properties of nodes, groups and the controller ---- */

VS_API vs_handle vs_property_of(vs_scheme *s, vs_handle group, const char *name); /* the property itself */
VS_API vs_outcome vs_property_get(vs_scheme *s, vs_handle group, const char *name, vs_handle *value);
/* An equal value is no change; subscribers are called before it returns. Makes the property where there is none. */
VS_API vs_outcome vs_property_put(vs_scheme *s, vs_handle group, const char *name, vs_handle value);
/* The subscriber gets the new value. Returns the subscription's number; 0: failed. */
VS_API uint64_t vs_property_subscribe(vs_scheme *s, vs_handle property, vs_host_fn *fn, void *context);
VS_API vs_outcome vs_property_unsubscribe(vs_scheme *s, vs_handle property, uint64_t id);
/* Leaves a change for the next vs_update; this may be called while the interpreter is at work. */
VS_API bool vs_post(vs_scheme *s, vs_handle property, vs_handle value);
/* Makes the changes that were left, in their order. A callback that fails is told and does not keep the others. The
 * rest waits for the next. */
VS_API vs_outcome vs_update(vs_scheme *s);

/* ---- actions and picks ---- */

VS_API vs_outcome vs_action_apply(vs_scheme *s, const char *action, vs_handle node); /* (action-apply 'action node) */
VS_API vs_outcome vs_scene_frame(vs_scheme *s, double seconds); /* update, draw and finish through the whole tree */

typedef struct {
  double distance;      /* from the ray's start, in model units */
  double point[3];
  vs_handle node, path; /* the node that was met, and the list of nodes down to it; valid in the callback,
      unless retained */
  const char *file;     /* the place in the program that made what was met; NULL: not known */
  uint32_t line, column;
} vs_hit;
/* Hands all nodes whose own drawing the ray meets to `each`, nearest first, until it returns false. The nearest is
 * selected: the event Node.selected tells of it. */
VS_API vs_outcome vs_pick(vs_scheme *s, const double from[3], const double direction[3], bool (*each)(void *context,
    vs_scheme *s, const vs_hit *hit),
                          void *context);

/* ---- gizmos and input, as the manual's page 'Scenes' has them ---- */

typedef enum { VS_GIZMO_TRIGGER, VS_GIZMO_SLIDER, VS_GIZMO_ARROW, VS_GIZMO_TRIPOD } vs_gizmo_kind;

typedef struct {
  vs_handle node;       /* valid in the callback, unless retained */
  vs_gizmo_kind kind;
  double at[3];         /* where value 0 is, or a slider's least; like all places, in the world's coordinates */
  double size;          /* a handle's diameter; an arrow's and a tripod's length */
  size_t value_count;   /* 3 of a tripod, else 1 */
  double value[3];      /* a trigger's: its clicks so far */
  double low[3], high[3]; /* of the value; a tripod's: how far one drag goes; a trigger's: 0 */
  double step;          /* between two values of a slider; 0: any value */
  size_t handle_count;  /* 0 to 3 */
  double handles[3][3]; /* what the user takes hold of */
  /* What the handle moves by: of a slider, from its least value to its greatest; else for a value greater by 1. A
   * trigger's: 0. */
  double axes[3][3];
} vs_gizmo;
/* Hands all gizmos below the root to `each`, parents before children, until it returns false. A gizmo's value is its
 * property "value": vs_property_put sets it and refuses what is out of range or between two steps,
 * vs_property_subscribe follows it. */
VS_API vs_outcome vs_gizmos(vs_scheme *s, bool (*each)(void *context, vs_scheme *s, const vs_gizmo *gizmo),
                            void *context);

typedef enum { VS_INPUT_PRESS, VS_INPUT_DRAG, VS_INPUT_RELEASE, VS_INPUT_MOVE, VS_INPUT_KEY } vs_input_kind;
typedef enum { VS_BUTTON_LEFT, VS_BUTTON_MIDDLE, VS_BUTTON_RIGHT, VS_BUTTON_NONE } vs_input_button;
/* An event of the mouse, with the ray under it, or of a key, with its name and no ray: (node-input ...), so that gizmos
 * are dragged within their constraints. *node: what it went to, 0 where that is nothing; may be NULL. */
VS_API vs_outcome vs_input(vs_scheme *s, vs_input_kind kind, vs_input_button button, const double from[3],
                           const double direction[3], const char *key, vs_handle *node);

/* ---- statistics ---- */

typedef struct {
  const char *key;   /* stable: "nodes.distinct", "time.mesh" ... */
  double value;
  const char *unit;  /* "s", "bytes", "" (a count) */
} vs_statistic;
/* Of everything since vs_new, in a fixed order; the manual's page on the command says what each key means. A value that
 * was not counted is a NaN. Copies at most room of them to out, returns how many there are. */
VS_API size_t vs_statistics(const vs_scheme *s, vs_statistic *out, size_t room);

typedef struct {
  const char *path;   /* "" where it went into a callback */
  const char *format; /* as vs_format_info.name */
  bool done;          /* false: it failed */
} vs_output_info;
/* The same of single outputs, the latest 64, oldest first; keys are those of vs_statistics that belong to one output.
 * False: no such index. *count is how many there are, whatever room is. */
VS_API bool vs_output_statistics(const vs_scheme *s, size_t index, vs_output_info *info, vs_statistic *out, size_t room,
    size_t *count);

#ifdef __cplusplus
}
#endif

#endif
