/* Declares the public interface: a host runs VisualScheme programs, and writes the objects that they draw.
 *
 *   vs_options o = vs_options_default();
 *   o.host.diagnose = print_it;
 *   vs_scheme *s = vs_new(&o);
 *   if (vs_eval_file(s, "house.vs", 0) == VS_OUTCOME_DONE) vs_write_drawing(s, "house.stl", NULL, NULL);
 *   vs_free(s);
 *
 * Units. Text is UTF-8. A text given as pointer and length may lack the final NUL; every other text ends in one. Angles
 * are radians, lengths are model units, times are seconds. Lines and columns count from 1; a column counts characters,
 * not bytes.
 *
 * Ownership. The interpreter copies the arguments of each call. It owns each text that a function returns or that a
 * callback receives. Such a text is valid until the next call on the same interpreter, or until the callback returns.
 *
 * Failure. No function aborts, exits or jumps. A vs_outcome is the exit code with which a command should end. Before a
 * failed call returns, it passes the reason to `diagnose`. After any failure the interpreter is usable, even when it
 * reached its memory limit.
 *
 * Versions. A host may be compiled with the header of an earlier version than the library's. As long as the version's
 * first number stays (0.N, for the versions 0.N.M), so do functions, their arguments, values of enums and offsets of
 * members. New functions and enumerators may come. Structs of options contain their size and grow at their end, and so
 * do the structs that only callbacks receive. No other struct grows: a further result gets a function of its own, and a
 * further callback of vs_host a member of vs_options. The library's file has the number, as libvisualscheme.so.0.
 *
 * Threads. A single thread at a time uses an interpreter. Different interpreters share nothing. Only vs_interrupt may
 * be called from any thread, and from a signal handler. Callbacks run in the calling thread. A callback must not call
 * into the same interpreter; the exceptions are vs_interrupt and the functions that the section on handles names. */
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

VS_API const char *vs_version(void); /* Returns the library's version, which may differ from the header's VS_VERSION. */

typedef struct vs_scheme vs_scheme; /* An interpreter contains its heap, its program and its drawing. */

/* The result of a call. */
typedef enum {
  VS_OUTCOME_DONE = 0,
  VS_OUTCOME_MODEL = 1,         /* the model has a fault; the diagnostic names its place */
  VS_OUTCOME_USAGE = 2,         /* a bad argument, or a file that cannot be read or written */
  VS_OUTCOME_WORKER = 3,        /* a worker program (POV-Ray, ...) is missing or failed */
  VS_OUTCOME_MACHINE = 4,       /* a limit of memory, time or steps was reached, or the machine failed */
  VS_OUTCOME_STOPPED = -1,      /* (break) or a single step has paused the program; only with the flag VS_EVAL_STOP. It
                                 * is no exit code. vs_stop_get returns the place, vs_resume continues the program */
  VS_OUTCOME_INTERRUPTED = 130
} vs_outcome;

/* ---- diagnostics ---- */

typedef enum { VS_SEVERITY_ERROR, VS_SEVERITY_WARNING, VS_SEVERITY_NOTE } vs_severity;

typedef struct {
  const char *file;         /* name of the source file, as given when it was opened; NULL: there is no source text */
  uint32_t line, column;    /* place of the first character; 0: the place is not known */
  uint32_t end_line, end_column; /* place just after the last character; 0: the end is not known, and the host shows a
                                  * single caret */
} vs_span;

typedef struct {
  vs_span at;
  const char *message; /* text such as "called from (tower 5)" */
} vs_diagnostic_note;

typedef struct {
  vs_severity severity;
  vs_outcome outcome;      /* kind of the failure; VS_OUTCOME_DONE for warnings and notes */
  vs_span at;
  const char *message;     /* text without the place, such as "make-sphere: r must be positive, got -2" */
  const char *source_line; /* the text of line `at.line`, without its newline; NULL: the line is not known */
  const vs_diagnostic_note *notes; /* the calls that led to the error, innermost first, then hints */
  size_t note_count;
} vs_diagnostic;

/* ---- progress ---- */

typedef struct {
  const char *phase;     /* current work in English, for a status line: "evaluating", "meshing", "rendering", ... */
  const char *subject;   /* name of the file that is being written, or NULL */
  double fraction;       /* completed fraction, 0 to 1; negative: not known */
} vs_progress;

/* ---- the host ---- */

/* The host's callbacks. Each receives `context`. Every member may be NULL. */
typedef struct {
  void *context;
  /* Receives text that the program prints (display, write ...). Returns false on failure; the program then gets an
   * error. NULL: the interpreter discards the text. */
  bool (*output)(void *context, const char *text, size_t length);
  /* Returns a line of console input for (read-line) and (read), with its newline, or NULL at the end of the input. The
   * line must stay valid until the next call of `input`. */
  const char *(*input)(void *context, size_t *length);
  /* Receives each error, warning and note. NULL: the interpreter writes them to standard error. */
  void (*diagnose)(void *context, const vs_diagnostic *d);
  /* Receives the progress of long work, at most about ten times a second. */
  void (*progress)(void *context, const vs_progress *p);
  /* Returns true to interrupt the running program, as vs_interrupt does. Called every few milliseconds. */
  bool (*poll)(void *context);
  /* Receives each value of a top-level expression, once, when VS_EVAL_PRINT is set. `text` is the text that the prompt
   * prints ("1/3 ; 0.333333"); a long text is cut and ends in " ...". */
  void (*value)(void *context, const char *text, size_t length);
  /* Reads a whole source file for load, include, require, load-mesh and vs_eval_file. Returns true and sets *text to a
   * block from malloc, which the interpreter frees. On failure, returns false and sets *why to the reason ("no such
   * file"), a text that is valid until the next call. NULL: the interpreter reads from the file system. */
  bool (*read_file)(void *context, const char *path, char **text, size_t *length, const char **why);
  /* Lists a folder for directory-files: passes each name to `take`, in any order, until `take` returns false. Returns
   * false if `take` did, or on failure, after setting *why as read_file does. NULL: the interpreter lists folders of
   * the file system if read_file is NULL too, and no folder otherwise. */
  bool (*list_folder)(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                      void *to, const char **why);
} vs_host;

/* Allocates, resizes or frees a block, as realloc does. If new_size is 0, frees the block. A result of NULL means
 * failure. old_size: size of the last request for this block. */
typedef void *vs_alloc_fn(void *context, void *old, size_t old_size, size_t new_size);

/* The options of an interpreter. Each struct of options begins with its size in the compiled host, by which the library
 * finds the members that the host knows; the others have their defaults. vs_options_default sets the size. If it is 0,
 * as in an initialiser without it, the library reads the members of version 0.1. */
typedef struct {
  size_t size;
  vs_host host;
  vs_alloc_fn *alloc;     /* allocator; NULL: the C library's */
  void *alloc_context;
  double limit_time;      /* Time limit in seconds for an evaluation, and for an output without its worker program. For
                           * this member and the limits below, 0 means no limit */
  size_t limit_memory;    /* limit in bytes for the sum of the heap, the model, and the solids that an output
                           * combines */
  uint64_t limit_steps;   /* greatest number of calls and loop iterations of an evaluation */
  size_t limit_output;    /* greatest number of bytes that an evaluation may print */
  double limit_worker;    /* time limit in seconds of a worker program */
  size_t limit_triangles; /* greatest number of triangles in the mesh of an output */
  size_t cache;           /* greatest number of bytes of results (meshes) that the interpreter keeps for later outputs.
                           * 0: 256 MB, or a quarter of limit_memory; SIZE_MAX: the interpreter keeps no results */
  bool keep_calls;        /* whether an error keeps the variables of the calls that led to it, for vs_call_get at a
                           * prompt; each error then takes more time */
  bool untrusted;         /* whether the program is untrusted: it reads no files except by read_file and list_folder,
                           * and writes no native text */
  bool ends_after_interrupt; /* whether the host ends the process after an interrupted call; such a call then returns
                              * sooner, because it does not free the model's memory */
  const char *library_path; /* folders for load, require and import, separated by ':'. The interpreter searches them
                             * after the folders of the requesting file and of the program. NULL: none */
  /* The result of (command-line): the program's name, then its arguments. If the count is 0, the result contains only
   * "vs". */
  const char *const *command_line; size_t command_line_count;
  size_t limit_stack; /* limit in bytes of the running calls, those that wait for another. 0: 1 GB, or a third of
                       * limit_memory if that is less */
} vs_options;

/* Sets *o to the default options. size: sizeof(vs_options) in the host. */
VS_API void vs_options_init(vs_options *o, size_t size);
static inline vs_options vs_options_default(void) {
  vs_options o;
  vs_options_init(&o, sizeof o);
  return o;
}

/* Returns a new interpreter, which the caller frees by vs_free. Returns NULL if memory is out. If o is NULL, uses the
 * default options. The interpreter copies the data of o, and calls its callbacks until vs_free. */
VS_API vs_scheme *vs_new(const vs_options *o);
VS_API void vs_free(vs_scheme *s); /* frees the interpreter; s may be NULL */

/* Ends the running call within about 50 ms, with VS_OUTCOME_INTERRUPTED. If no call is running, the next call ends in
 * this way, unless vs_interrupt_clear precedes it. Async-signal-safe; any thread may call vs_interrupt. */
VS_API void vs_interrupt(vs_scheme *s);
VS_API void vs_interrupt_clear(vs_scheme *s);

/* ---- running programs ---- */

/* Flags of an evaluation. */
enum {
  VS_EVAL_PRINT = 1u,  /* passes each value of a top-level expression to the callback `value`, as the prompt does */
  /* The text is a whole program, like a file. If the program begins with an import, it can use only the imported names.
   * Without this flag, an import adds names to the visible names. */
  VS_EVAL_PROGRAM = 2u,
  /* With VS_EVAL_PRINT: the n-th value since vs_new or vs_restart gets the name $n. If the value is an object, the
   * callback `value` receives a description in one line. */
  VS_EVAL_NUMBER = 4u,
  VS_EVAL_STOP = 8u,    /* (break) pauses the program (VS_OUTCOME_STOPPED). Without this flag, (break) causes a warning,
                         * and the program continues */
  VS_EVAL_STEP = 16u,   /* with VS_EVAL_STOP: pauses the program before the first call in the text */
  VS_EVAL_WITHIN = 32u, /* if a program is paused, the text's expressions can use the variables visible at the place of
                         * the pause */
  VS_EVAL_PASS = 64u,   /* the text has run before: (break) neither pauses the program nor warns */
  /* Checks (check-expect ...) wait for vs_check_next. Without this flag and without VS_EVAL_PASS, checks run at the end
   * of the text, and each failed check causes a warning. */
  VS_EVAL_CHECK_LATER = 128u,
  VS_EVAL_TRY = 256u    /* the text is unsaved: the program can neither write nor delete files */
};

/* vs_eval_file and vs_eval_text evaluate the top-level forms of a file or a text in order, in the single program of
 * this interpreter. They end at the first error. The interpreter remembers the objects that top-level expressions
 * return: if the program never draws, these objects are the model. */
VS_API vs_outcome vs_eval_file(vs_scheme *s, const char *path, unsigned flags);
/* Returns the name, in words, of the language that the path's suffix denotes, if it is a language other than
 * VisualScheme. Otherwise returns NULL. vs_eval_file runs files of each such language. */
VS_API const char *vs_language_of(const char *path);
/* Evaluates a text. name: the text's name in diagnostics ("house.vs", "-e"); relative paths in `load` start at the
 * folder of this name. first_line: line number of the text's first line in the file `name`. */
VS_API vs_outcome vs_eval_text(vs_scheme *s, const char *name, unsigned first_line, const char *text, size_t length,
                               unsigned flags);

/* Returns to the state after vs_new, to run a changed file, or the same file with other parameters. Forgets
 * definitions, required files, parameters, the drawing, the camera and other scene settings, and the state of random
 * numbers. Keeps the values from vs_parameter_set, cached meshes, options and statistics. Later outputs have the bytes
 * that a new process would write; unchanged parts take no time. Fails, and changes nothing, if memory is out. */
VS_API vs_outcome vs_restart(vs_scheme *s);

/* Returns true if the program called (exit code). The evaluation then ended with VS_OUTCOME_DONE, and the host should
 * run no more of the program. *code is 0 for (exit) and (exit #t), 1 for (exit #f), otherwise the given number. */
VS_API bool vs_exit_requested(const vs_scheme *s, int *code);

/* The state of a text that may be incomplete, for continuation lines and editors. vs_read_check neither evaluates the
 * text nor changes the interpreter. */
typedef enum {
  VS_READ_EMPTY,      /* the text contains only blanks and comments */
  VS_READ_COMPLETE,
  VS_READ_INCOMPLETE, /* more text could complete it: a parenthesis, string or comment is open */
  VS_READ_BAD         /* the text has a fault that no further text can repair; line, column and message describe it */
} vs_read_state;
typedef struct {
  vs_read_state state;
  unsigned depth;          /* if VS_READ_INCOMPLETE: number of open parentheses */
  unsigned line, column;   /* Line and column, from 1. VS_READ_INCOMPLETE: place of the innermost open parenthesis,
                            * string or comment. VS_READ_BAD: place of the fault */
  const char *message;     /* VS_READ_BAD: reason, such as "( is closed by ]"; otherwise NULL */
} vs_read_status;
VS_API vs_read_status vs_read_check(vs_scheme *s, const char *text, size_t length);

/* Passes each name that is visible at top level and begins with `prefix` to `each`, in sorted order, until `each`
 * returns false. Returns the number of names passed. */
VS_API size_t vs_complete(vs_scheme *s, const char *prefix, bool (*each)(void *context, const char *name),
                          void *context);

/* ---- names, for help and editors ---- */

typedef struct {
  const char *kind;     /* kind: "procedure", "form" (if, define ...) or "value" */
  /* How the name is called, such as "(make-sphere c r)", with a line for each possible list of arguments; "" if not
   * known. */
  const char *call;
  const char *keywords; /* the procedure's keyword arguments, such as "#:segments #:plane"; "" if it has none */
  const char *doc;      /* short description in English, half a line; "" if there is none */
  const char *value;    /* text of the value as a program writes it, cut to a line; "" for procedures and forms */
  bool own;             /* true if the program or a library defines the name, false if the language does */
  vs_span at;           /* place of the definition; its file is NULL if the place is not known, or the language defines
                         * the name */
} vs_name_info;
/* Describes a name that is visible at top level. Returns false if there is no such name. */
VS_API bool vs_name_get(vs_scheme *s, const char *name, vs_name_info *out);
/* Returns the advice that an error gives for an unknown name: "make-box is the name here: ...", "did you mean
 * make-box?". Returns "" if there is no advice. */
VS_API const char *vs_name_advice(vs_scheme *s, const char *name);
/* Adds advice to the message of an error, as a run of the text would. The error is at this byte of the text. It
 * concerns an unknown name ("x is not defined"), a called value that is no procedure, the name of a form without
 * parentheses, or a chain (< 1 x < 3). The result is valid until the next call with `s`. */
typedef enum { VS_ADVICE_NAME, VS_ADVICE_CALL, VS_ADVICE_WORD, VS_ADVICE_CHAIN } vs_advice_kind;
VS_API const char *vs_place_advice(vs_scheme *s, vs_advice_kind kind, const char *text, size_t length, size_t at,
                                   const char *message);
/* Passes each line of a procedure's compiled instructions to `each`, until `each` returns false. Returns false if the
 * name does not denote a procedure of Scheme code. */
VS_API bool vs_disassemble(vs_scheme *s, const char *name, bool (*each)(void *context, const char *line),
                           void *context);

/* ---- paused programs: by (break), or by single steps ---- */

/* While a program is paused, the host may evaluate another text, which may pause, too. The paused programs form a
 * stack. vs_restart removes all of them. */

typedef enum {
  VS_STOPPED_BREAK,       /* the program called (break) */
  VS_STOPPED_CALL,        /* the program is about to make a call */
  VS_STOPPED_VALUE        /* a call has returned a value; only during single steps. The host should continue at once
                           * with VS_RESUME_SAME */
} vs_stopped;
typedef struct {
  vs_stopped kind;
  vs_span at;             /* place of the expression at which the program is paused; its end is known only if it is on
                           * the same line */
  const char *source_line; /* source text of the line that contains this place, or NULL */
  const char *procedure;  /* name of the procedure that contains the expression; "" at top level or if it has no name */
  const char *text;       /* If kind is CALL: the call with the values of its arguments, such as "(area 3 4)". VALUE:
                           * the returned value. BREAK: "" */
} vs_stop_info;
/* Describes the latest pause. Returns false if no program is paused. The texts are valid until the next call of any
 * function of this interpreter. Until an error occurs, vs_call_get returns the calls that led to this pause. */
VS_API bool vs_stop_get(vs_scheme *s, vs_stop_info *out);
/* Returns the number of paused programs. */
VS_API size_t vs_stop_depth(const vs_scheme *s);

typedef enum {
  VS_RESUME_CONTINUE,     /* runs to the next (break) */
  VS_RESUME_ENTER,        /* runs to the next call, including calls inside the procedure that is called now */
  VS_RESUME_OVER,         /* runs to the next call in the same procedure or in its callers */
  VS_RESUME_OUT,          /* runs to the next call in the callers of the current procedure */
  VS_RESUME_SAME          /* continues as the previous vs_resume did */
} vs_resume_way;
/* Continues the program that paused last, with the flags of its evaluation. Returns an outcome as vs_eval_text does, or
 * VS_OUTCOME_USAGE if no program is paused. */
VS_API vs_outcome vs_resume(vs_scheme *s, vs_resume_way way);
/* Removes the program that paused last; it cannot be continued. */
VS_API void vs_stop_drop(vs_scheme *s);

/* ---- the calls of the last error, with their variables (vs_options.keep_calls) ---- */

typedef struct {
  const char *procedure;  /* name of the procedure; "" if it has no name */
  const char *variables;  /* names and values of the procedure's parameters, local and captured variables, such as "n =
                           * 3, points = (...)" */
  vs_span at;             /* place of the call that this procedure was making */
} vs_call_info;
/* Describes a call that led to the last error. Index 0 is the innermost call. Returns false for an index after the last
 * call, or if there was no error. */
VS_API bool vs_call_get(vs_scheme *s, size_t index, vs_call_info *out);

/* ---- profile ---- */

/* Starts (if `on`) or ends the profiler, which often records the procedures that are running. A start discards earlier
 * samples. */
VS_API void vs_profile(vs_scheme *s, bool on);
typedef struct { const char *procedure; vs_span at; double own, whole;
    /* fractions of the time of all samples, 0 to 1. own: in the procedure itself. whole: also in the procedures that it
     * calls */ } vs_profile_info;
/* Describes a procedure in the profile. Index 0 is the procedure with the most time. Returns false for an index after
 * the last. Sets *looks to the number of samples. */
VS_API bool vs_profile_get(vs_scheme *s, size_t index, vs_profile_info *out, size_t *looks);
typedef struct { const char *procedure; vs_span at; /* procedure: name of the called procedure, or "". at: place in the
                                                     * procedure that was running */
    size_t caller; /* 1 + the index of the calling entry, which has a smaller index; 0 if there is no caller */
    double seconds, bytes; /* seconds, and bytes of memory allocated, at this place, without those of called
                            * procedures */ } vs_profile_call_info;
/* Describes an entry of the profile's tree of calls. A caller's index is smaller than the indices of the calls below
 * it. Returns false for an index after the last. */
VS_API bool vs_profile_call(vs_scheme *s, size_t index, vs_profile_call_info *out);

/* ---- coverage ---- */

/* Starts (if `on`) or ends the counting of the forms that are read later: each is a call, a definition or another form
 * of a program or its libraries, not of the language's library. Returns false when memory is out. */
VS_API bool vs_coverage(vs_scheme *s, bool on);
typedef struct { vs_span at; uint64_t count; /* number of times that the form has run */ } vs_coverage_info;
/* Describes a form that is counted. Forms that a macro makes of one form have the same place. Returns false for an
 * index after the last. */
VS_API bool vs_coverage_get(vs_scheme *s, size_t index, vs_coverage_info *out);

/* ---- parameters: results of (define-parameter ...), as data for sliders and -D ---- */

typedef enum {
  VS_PARAMETER_BOOLEAN,
  VS_PARAMETER_INTEGER /* exact integer */,
  VS_PARAMETER_REAL,
  VS_PARAMETER_STRING,
  VS_PARAMETER_DATUM
} vs_parameter_type;
typedef struct {
  const char *name, *label, *group;     /* label: the label from the program, otherwise the name. group: the group from
                                         * the program, otherwise "" */
  vs_parameter_type type;               /* type of the parameter's default value */
  const char *value, *default_value;    /* value, default_value: texts of the values as a program writes them; strings
                                         * are without quotes */
  bool has_range;                       /* whether min, max and step are set, as for a number without a list of
                                         * choices */
  double min, max, step;                /* range of the value, and distance between two allowed values; if step is 0,
                                         * every value in the range is allowed */
  const char *const *choices;           /* allowed values, each written like `value`; NULL if any value is allowed */
  size_t choice_count;
  vs_span at;
  const char *unit;                     /* unit shown after the number, such as "m"; "" if there is none */
  bool has_min, has_max;                /* has_min, has_max: whether the program sets min and max; otherwise these are
                                         * computed from the default value */
} vs_parameter_info;

/* Sets the value of the parameter that a later (define-parameter name ...) defines. datum: a single datum, which is
 * read and never evaluated, or bare text if the default is a string. Returns false, after a diagnostic, if the name or
 * the datum cannot be read. If the definition refuses the value (another type, out of range, not a choice), the
 * evaluation ends with VS_OUTCOME_USAGE. */
VS_API bool vs_parameter_set(vs_scheme *s, const char *name, const char *datum);
/* Removes the value that vs_parameter_set has set: a later (define-parameter name ...) then uses its default value. */
VS_API void vs_parameter_unset(vs_scheme *s, const char *name);
VS_API size_t vs_parameter_count(const vs_scheme *s);
VS_API bool vs_parameter_get(vs_scheme *s, size_t index, vs_parameter_info *out);
/* Returns the index-th name that was given to vs_parameter_set and that no define-parameter has used; NULL after the
 * last. */
VS_API const char *vs_parameter_unused(const vs_scheme *s, size_t index);
/* Returns the index-th name that the program passed to (report name value), in the order of first use. Sets *value to
 * the name's last value. Returns NULL after the last. */
VS_API const char *vs_report_get(const vs_scheme *s, size_t index, double *value);
/* A rule of the design, which (require-that name condition) has tested. */
typedef struct {
  const char *name;
  const char *condition, *found; /* the tested expression, and the values in it, as text */
  double shortfall;        /* 0 if the rule is met; otherwise the greatest distance of a value from its bound, as a part
                            * of the larger of both, or 1 if the condition compares no numbers */
  vs_span at;
} vs_rule_info;
/* Describes the index-th rule that the program has tested. Returns false for an index after the last. */
VS_API bool vs_rule_get(const vs_scheme *s, size_t index, vs_rule_info *out);

/* ---- the drawing ---- */

typedef struct {
  size_t objects;                 /* number of drawn objects, or of returned objects if the program draws none; each
                                   * placement counts */
  size_t solids, surfaces, regions, curves; /* numbers of objects of each kind; a union of different kinds counts as a
                                             * solid */
  bool has_bounds;                /* whether the bounds are set; false for a drawing that is empty or contains only
                                   * infinite lines */
  double min[3], max[3];
  bool bounds_at_most;            /* Whether the bounds may be larger than the drawing. If it would take long to compute
                                   * a cut object, the bounds of the uncut object are used */
  const char *units;              /* model unit, "m" by default */
  /* If there are no objects: a list of the program's definitions that are not used, "the program defines ...".
   * Otherwise NULL. */
  const char *advice;
} vs_summary;
VS_API vs_outcome vs_drawing_summary(vs_scheme *s, vs_summary *out);

/* Returns the name of the model's index-th view, which (view "name" ...) defines; NULL after the last. */
VS_API const char *vs_view_name(const vs_scheme *s, size_t index);
/* Sets names[] to the names of the drawing's parts, at most `room`, and *count to their number. */
VS_API vs_outcome vs_part_names(vs_scheme *s, const char **names, size_t room, size_t *count);

/* Returns true if the interpreter has read the file at path (program, picture, mesh or data), perhaps by another name.
 * Every function that writes refuses such a path (VS_OUTCOME_USAGE). A host that writes a file itself should call this
 * function first. */
VS_API bool vs_is_input(const vs_scheme *s, const char *path);
/* Returns the name of the index-th file that the interpreter has read; NULL after the last. */
VS_API const char *vs_input_name(const vs_scheme *s, size_t index);
/* Records a file that the host itself has read, for vs_is_input. Returns false if memory is out. */
VS_API bool vs_note_input(vs_scheme *s, const char *path);

typedef struct {
  const char *form; /* "plane", "cylinder", "sphere", "cone" or "torus"; "surface" for others; NULL if there is none */
  double area;      /* area of the face on its surface, in square model units; for "surface" that of its facets */
  double at[3];     /* a point of the plane, or of the cylinder's axis; the centre of the sphere or torus; the cone's
                     * apex */
  double axis[3];   /* unit normal of the plane; unit direction of the axis of the cylinder, cone or torus */
  double radius;    /* of the cylinder, the sphere, or the torus's middle circle */
  double tube;      /* radius of the torus's tube */
  double angle;     /* angle between the cone's axis and its sides */
} vs_face_info;
/* Finds the face nearest to a point, among the faces of the drawn solids whose bounds contain the point. Solids are
 * evaluated for it. */
VS_API vs_outcome vs_drawing_face(vs_scheme *s, const double point[3], vs_face_info *out);

VS_API void vs_drawing_clear(vs_scheme *s); /* clears the drawing, as (erase-all) does; also forgets the objects that
                                             * top-level expressions returned */

/* ---- differences between two drawings ----
 *
 * Run the first program, vs_drawing_keep, vs_restart, run the second program, vs_drawing_compare. A part is an object
 * within unions, placements, materials and layers: a primitive, a sweep, a difference ... */

/* Keeps the current drawing for vs_drawing_compare; vs_restart does not delete it. Removes cached outputs. */
VS_API vs_outcome vs_drawing_keep(vs_scheme *s);

typedef enum {
  VS_PART_WAS_ADDED, VS_PART_WAS_REMOVED,
  VS_PART_WAS_CHANGED,   /* the part has equal kinds of objects and equal paint in both drawings, but other numbers */
  VS_PART_WAS_MOVED,     /* both drawings contain the part, with the same shape at different places */
  VS_PART_WAS_REPAINTED  /* the part has the same shape and place in both drawings, but another material or layer */
} vs_part_difference;

typedef struct {
  const char *layer, *material; /* names of the part's layer and material; "" if it has none */
  const char *text;             /* expression that makes the part, cut to a line */
  vs_span at;                   /* place of that expression in the program; its file is NULL if the place is not
                                 * known */
} vs_part_info;

typedef struct {
  size_t same, repainted, moved, changed, added, removed; /* numbers of parts with each result of the comparison */
  double volume_before, volume_after; /* total volume of all solids in the first and in the second drawing, in cubic
                                       * model units */
  double volume_added, volume_removed; /* volume_added: volume inside the second drawing only; volume_removed: volume
                                        * inside the first drawing only, in cubic model units */
} vs_comparison;

/* Compares the drawing from vs_drawing_keep with the current drawing. If no drawing was kept, compares an empty
 * drawing. Fills *out, then passes the parts that differ to `each`, removed parts first, until `each` returns false.
 * before is NULL for an added part, after is NULL for a removed part. vs_output_options.change uses this result until
 * the next comparison. */
VS_API vs_outcome vs_drawing_compare(vs_scheme *s, vs_comparison *out,
                                     bool (*each)(void *context, vs_part_difference what, const vs_part_info *before,
                                                  const vs_part_info *after),
                                     void *context);

/* ---- checks: (check-expect expression value) and its like ---- */

typedef struct {
  vs_span at;
  bool passed;
  const char *form;       /* name of the check form, such as "check-expect" */
  const char *expression; /* source text of the expression, cut to a line */
  const char *gives;      /* value of the expression, as a program writes it, or "an error: ..." */
  const char *expected;   /* expected value, as a program writes it, or "an error: ..." */
} vs_checked;

typedef struct {
  void *context;
  void (*told)(void *context, const vs_checked *result); /* receives the result of each check; the texts are valid only
                                                          * during the call */
  /* Receives, after a failed check of objects, the parts that differ, as vs_drawing_compare passes them; before is the
   * expected part. May be NULL. */
  bool (*part)(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after);
} vs_check_listener;

/* Returns true if a check waits from an evaluation with VS_EVAL_CHECK_LATER since vs_new or vs_restart. */
VS_API bool vs_check_waits(const vs_scheme *s);
/* Runs the oldest waiting check, with limits of its own, even if the program failed. The drawing does not change.
 * Returns VS_OUTCOME_DONE after `told` has received the result, whether the check passed or failed. If the check is
 * interrupted, `told` receives nothing. */
VS_API vs_outcome vs_check_next(vs_scheme *s, const vs_check_listener *listener);
/* Returns the name of a check form that the program has redefined, so that uses of the name are not checks. Returns
 * NULL if there is none. */
VS_API const char *vs_check_redefined(vs_scheme *s);

/* ---- fitting a model to a scan ----
 *
 * vs_fit runs the program repeatedly and changes the values of its parameters, and the place of the scan, until the
 * scan's points lie as near to the program's solids as possible. It starts at the values from vs_parameter_set. After
 * it, the program has run with the fitted values, and vs_parameter_set holds them. */

typedef struct {
  size_t size;   /* size of this struct in the host, as in vs_options */
  bool placed;   /* whether the scan is in the model's coordinates and must not be moved */
  bool near;     /* whether the scan is roughly in place, so that vs_fit does not try other places for it */
  bool any_pose; /* whether the scan's up direction may differ from the model's */
  const char *const *held;
  size_t held_count; /* names of the parameters that keep their values */
  size_t points;     /* greatest number of points of the scan in the last steps; 0: 20,000 */
  double confidence; /* confidence of the intervals, between 0 and 1; 0: .95 */
} vs_fit_options;
VS_API void vs_fit_options_init(vs_fit_options *o, size_t size); /* Sets *o to the default options. */
static inline vs_fit_options vs_fit_options_default(void) {
  vs_fit_options o;
  vs_fit_options_init(&o, sizeof o);
  return o;
}

typedef enum {
  VS_FIT_FITTED,
  VS_FIT_HELD,        /* the options hold the parameter at its value */
  VS_FIT_NO_NUMBER,   /* the parameter's default is exact, or not a number, so it keeps its value */
  VS_FIT_AT_BOUND,    /* the parameter is fitted, and limited by #:min or #:max */
  VS_FIT_UNDETERMINED /* the scan does not determine the parameter: a change by half of its value hardly changes the
                       * distances */
} vs_fit_state;
typedef struct {
  const char *name;
  vs_fit_state state;
  double start, value;
  double error;     /* standard error of the fitted value; infinite if the value is undetermined, 0 if the parameter
                     * keeps its value */
  double low, high; /* ends of the confidence interval of the value */
} vs_fit_parameter;

typedef struct {
  size_t points, nowhere; /* points: number of points in the file. nowhere: number of points without finite coordinates,
                           * which vs_fit omits */
  size_t samples,
      used; /* samples: number of places whose distance is measured: points of a cloud, or points spread over a mesh.
             * used: number of samples in the last step */
  size_t outliers; /* number of samples further away than 4.685 times `spread`, which have no weight */
  double spread;   /* 1.4826 times the median distance. If the errors are normally distributed, this is their standard
                    * deviation */
  double median, root_mean_square; /* median and root mean square of the distances of all samples */
  double correlation;              /* correlation between the distances of neighbouring samples; near 0 if the distances
                                    * are only noise */
  double size;                     /* size of the scan: root mean square distance of its points from their centre */
  double place[3][4];              /* matrix that maps the model's coordinates to the scan's */
  const char *doubt; /* reason not to trust the result: "far" "tilted" "strays" "shape" "rival"; or "none" */
  bool converged;                  /* whether the values no longer changed in the last step */
  unsigned iterations, runs;       /* iterations: number of measurements of all distances. runs: number of runs of the
                                    * program */
  const char *units;
} vs_fit_result;

/* Fits the program in the file `model` to the scan in the file `scan` (.ply .obj .off .stl; a cloud or a mesh). Doubts
 * are warnings. result.samples is above 0 if there is a result; it then stays valid until the next vs_fit:
 *   VS_OUTCOME_DONE         the result is trusted;
 *   VS_OUTCOME_MODEL        it is not trusted, for the reason in result.doubt;
 *   VS_OUTCOME_INTERRUPTED, or VS_OUTCOME_MACHINE past limit_time: it is the best so far. */
VS_API vs_outcome vs_fit(vs_scheme *s, const char *model, const char *scan, const vs_fit_options *o,
                         vs_fit_result *out);
/* Describes a parameter of the last fit. Parameters are in the program's order. Returns false if there is no such
 * index. */
VS_API bool vs_fit_parameter_get(const vs_scheme *s, size_t index, vs_fit_parameter *out);
/* Returns the signed distances of the scan's points from the fitted model, in the file's order. A distance is negative
 * inside the model, and NaN for a point without finite coordinates. The array is valid until the next vs_fit. Returns
 * NULL if there was no fit. */
VS_API const double *vs_fit_distances(const vs_scheme *s, size_t *count);
/* Writes the scan as .ply or .x3d, by the path's suffix, coloured by the distances of vs_fit_distances: blue at -range,
 * grey at 0, red at range. If range is 0, uses the range that contains 98 % of the points. Sets *used to the range. */
VS_API vs_outcome vs_fit_map(vs_scheme *s, const char *path, double range, double *used);

/* ---- output ---- */

typedef struct {
  const char *name;    /* name for --format, such as "povray" */
  const char *suffix;  /* suffix without the dot, such as "pov" */
  const char *doc;     /* short description in English, half a line */
  const char *worker;  /* name of the program that must be installed, or NULL */
  bool binary;
} vs_format_info;
/* Returns the constant list of the library's output formats. */
VS_API const vs_format_info *vs_format_list(size_t *count);
VS_API const char *vs_format_endings(void); /* returns the suffixes of all formats, ".pov .png ...", for messages */
/* Returns the format with this name, suffix or suffix of a path ("stl", ".stl", "out/a.stl"), or NULL if there is
 * none. */
VS_API const vs_format_info *vs_format_find(const char *name_or_suffix);

/* Finds a format as vs_format_find does, also among the formats that the program defines (define-back-end). Returns
 * false if there is none. The texts in *out are valid until the next evaluation. */
VS_API bool vs_format_of(const vs_scheme *s, const char *name_or_suffix, vs_format_info *out);

/* The names of the optimisation passes; bit i of a mask is the i-th name. */
#define VS_PASSES_ALL (~0u)
VS_API const char *const *vs_pass_list(size_t *count);

/* Returns the names of the looks (styles) of pictures. Sets *count to their number. */
VS_API const char *const *vs_look_list(size_t *count);
/* Returns the static name of the unit of length at this index, such as "mm", or NULL at the end of the list. */
VS_API const char *vs_unit_name(size_t index);

typedef enum { VS_QUALITY_DRAFT, VS_QUALITY_GOOD, VS_QUALITY_FINAL } vs_quality;

/* The curve from linear light to screen values. The manual's page 'Pictures' cites the formulas. */
typedef enum { VS_CURVE_NEUTRAL, VS_CURVE_AGX, VS_CURVE_FILMIC, VS_CURVE_LINEAR } vs_curve;
typedef struct {
  vs_curve curve;
  bool fixed;            /* whether `exposure` applies to the picture's light itself; otherwise it is added to the
                          * exposure computed from the picture's histogram */
  double exposure;       /* exposure in stops (EV); each stop doubles the light */
} vs_development;

typedef struct {
  size_t size;           /* size of this struct in the host, as in vs_options */
  int width, height;     /* size of a picture in pixels. If both numbers are 0: 1024 by 768. If one number is 0, it is
                          * computed from the other at 4:3 */
  vs_quality quality;
  vs_development development; /* tone mapping of a .png */
  bool layers;           /* whether an .exr also contains depth, normal, albedo, id, material and ambient occlusion */
  const char *view;      /* name of a view of the model, or NULL; "*" selects all views, on the sheet of a drawing */
  const char *part;      /* name of the part of the model that alone is written, or NULL */
  bool has_camera;       /* whether `camera` replaces the camera of the model and of the view */
  double camera[7];      /* eye (3 numbers), target (3 numbers), and focal length in mm for a 35 mm film */
  bool has_sun;          /* whether `sun` replaces the model's sun */
  double sun[2];         /* azimuth from north towards east, and altitude, in degrees */
  double tolerance;      /* greatest distance between a curve and the chords that approximate it, in model units; 0: the
                          * model's tolerance, or the tolerance that is the default for drawings */
  int segments;          /* number of facets in a full turn; 0: computed from the tolerance */
  int least_segments;    /* least number of facets in a full turn, when `segments` is 0; 0: 32 */
  unsigned passes;       /* mask of the optimisation passes that run; VS_PASSES_ALL by default */
  bool count;            /* Whether to count, for the statistics, nodes, and commands with and without each pass. The
                          * passes then run once more for each count */
  bool strict;           /* whether it is an error, not a warning, if the format omits or changes part of the model */
  bool change;           /* whether to write the result of vs_drawing_compare instead of the drawing: added parts green,
                          * removed parts red */
  bool up_y;             /* whether Y instead of Z points upwards in formats whose upward axis is not fixed, as game
                          * engines expect */
  const char *units;     /* the unit of lengths in .dxf drawings and in formats of meshes, a name from vs_unit_name;
                          * NULL: the model's unit */
  bool last;             /* whether no other drawing or output follows, so that the interpreter caches nothing */
  int crop[4];           /* part of a .png or .exr to write: left, top, width, height in pixels; all 0: the whole
                          * picture */
  unsigned threads;      /* number of processors that POV-Ray uses; 0: all. The number does not change the picture */
  const char *look;      /* name of a look (style) from vs_look_list, which replaces the model's look; NULL: the model's
                          * own look */
} vs_output_options;
VS_API void vs_output_options_init(vs_output_options *o, size_t size); /* Sets *o to the default options. */
static inline vs_output_options vs_output_options_default(void) {
  vs_output_options o;
  vs_output_options_init(&o, sizeof o);
  return o;
}

/* Writes the drawing to path. An existing file stays until the new file is complete and on disk. format: a name or
 * suffix; NULL: the suffix of the path determines the format. If o is NULL, uses the default options. If the format has
 * a worker program, this function starts it, passes its progress to `progress`, and ends it when interrupted. */
VS_API vs_outcome vs_write_drawing(vs_scheme *s, const char *path, const char *format, const vs_output_options *o);
/* Writes the drawing in pieces to a callback. If the callback returns false, this function returns VS_OUTCOME_USAGE.
 * Fails for a format that writes several files. */
VS_API vs_outcome vs_write_drawing_to(vs_scheme *s, const char *format, const vs_output_options *o,
                                      bool (*write)(void *context, const void *bytes, size_t count), void *context);

/* ---- pictures in linear light: EXR files ----
 *
 * These functions read red, green and blue of a picture (channels R, G, B), or else its luminance (Y). A file is
 * written whole, or not at all. Paths always refer to the file system, even if the host reads programs from
 * elsewhere. */

/* Applies tone mapping to the picture `from`, and writes the PNG `to`. If how is NULL, uses the defaults of
 * vs_output_options_default. Sets *stops to the exposure used. */
VS_API vs_outcome vs_picture_tone(vs_scheme *s, const char *from, const char *to, const vs_development *how,
    double *stops);
/* Writes the luminance as a PNG in false colours, on a logarithmic scale with a legend. unit: the luminance in cd/m2
 * that the number 1 in the picture means. Sets *least and *most to the ends of the legend. */
VS_API vs_outcome vs_picture_false_color(vs_scheme *s, const char *from, const char *to, double unit, double *least,
    double *most);
/* Writes the illuminance of floors in lux as a PNG in false colours. The picture must contain the layers albedo and
 * normal. unit: the luminance in cd/m2 that the number 1 in the picture means. */
VS_API vs_outcome vs_picture_illuminance(vs_scheme *s, const char *from, const char *to, double unit, double *least,
    double *most);

typedef struct {
  double color[3];       /* red, green and blue in linear light */
  double depth;          /* depth from channel Z; NaN if the picture has no such channel */
  bool has_normal;       /* whether the picture has the channels N.X, N.Y, N.Z */
  double normal[3];
  long id;               /* number of the object from channel id; 0: no object; negative: the picture has no such
                          * channel */
  char place[512];       /* place in the program that made the object, such as "house.vs:12:3"; "" if not known */
  char material[128];    /* name of the material, or "#rrggbb" for a plain colour; "" if there is no material */
  double openness;       /* ambient openness from channel AO, from 0 in a narrow gap to 1 on an open plane; NaN if the
                          * picture has no such channel */
  double illuminance;    /* illuminance if the surface is matt, in the picture's numbers; NaN if not known */
} vs_picture_point;
/* Sets *out to the picture's data at a pixel. Columns and rows count from 0 at the upper left. */
VS_API vs_outcome vs_picture_pick(vs_scheme *s, const char *from, long column, long row, vs_picture_point *out);

typedef struct {
  uint32_t columns, rows;
  double most, mean, root_mean_square; /* greatest, mean and root mean square difference of red, green and blue in
                                        * linear light */
  long column, row;      /* pixel of the largest difference */
  double psnr;           /* peak signal-to-noise ratio in dB, for a peak of 1; infinite if the pictures are equal */
  double ssim;           /* structural similarity of the pictures after tone mapping; 1 if they are equal */
} vs_picture_difference;
/* Compares two pictures of equal size. to: path for a PNG of the differences in false colours; NULL: no PNG is
 * written. */
VS_API vs_outcome vs_picture_compare(vs_scheme *s, const char *a, const char *b, const char *to,
    vs_picture_difference *out);
/* Removes noise from a picture, and writes the result as another EXR with the same channels. Sets *layers to true if
 * the picture's albedo and normal were used, to false if only its colours were used. */
VS_API vs_outcome vs_picture_denoise(vs_scheme *s, const char *from, const char *to, bool *layers);
/* Returns the first row of tile `tile` of a picture that is divided into tiles, one above the other, each a crop of the
 * whole width; for tile = tiles, the picture's height. Tiles of other sizes take longer, because POV-Ray then renders
 * some rows for two tiles. tiles: from 1 to height. */
VS_API int vs_picture_tile_top(int width, int height, int tiles, int tile);
/* Joins tiles, all PNG or all EXR, row by row. If the tiles are crops of one picture, the result has the bytes of the
 * uncropped picture. */
VS_API vs_outcome vs_picture_join(vs_scheme *s, const char *const *tiles, size_t columns, size_t rows, const char *to);

/* ---- the sun through a day ---- */

typedef struct {
  double latitude, longitude; /* position on the earth in degrees, north and east positive */
  int year, month, day;
  double from, to, step; /* time span and time step, in hours of local mean time, 0 to 24 */
} vs_sun_span;
typedef struct { size_t pictures, faces, dark; /* dark: steps with the sun below the horizon */ } vs_sun_summary;
/* Writes these files into the folder, and makes the folder if needed:
 *   hours.csv                        the hours of sun on each face of the drawing's solids
 *   hours-plan.png, hours-model.png  these hours in false colours, from above and by the camera
 *   shadow-001.png, ...              a picture for the middle of each step with the sun up
 *   shadows.png                      all of these pictures on a sheet
 * The pictures are drafts, unless the options request VS_QUALITY_FINAL. Without POV-Ray the function writes the hours
 * and returns VS_OUTCOME_WORKER. */
VS_API vs_outcome vs_sun_study(vs_scheme *s, const vs_sun_span *span, const char *folder, const vs_output_options *o,
    vs_sun_summary *out);

/* A format is a table of callbacks, one for each kind of object that the format can express. As for its own formats,
 * the library visits the objects of the drawing, computes sections and the like, and runs the passes. It replaces an
 * object without a callback by simpler objects, in the end by "line" for curves and "polyface-mesh" for all other
 * objects. The table must therefore contain "polyface-mesh". Without "line", the library omits curves and warns. */

typedef struct vs_output vs_output; /* the output that is being written; valid only in callbacks */

typedef enum {
  VS_THING_LEAF,  /* a primitive, or a sweep with its profile; the callback receives it once */
  VS_THING_ENTER, /* the beginning of an operation ("unite", "intersect", "subtract", "transform" ...); the children
                   * follow */
  VS_THING_LEAVE  /* the end of an operation, after its children */
} vs_thing_phase;

typedef struct {
  const char *kind;      /* kind of the thing: a name that object-kind returns, such as "sphere" */
  vs_thing_phase phase;
  size_t child_count;    /* at VS_THING_ENTER: number of things before VS_THING_LEAVE */
  /* Map from the thing's coordinates to the drawing's: a row for each of x, y and z, with the translation last. For an
   * operation: map from the coordinates of its children. */
  double place[3][4];
  bool painted;
  double color[4];       /* colour in sRGB and opacity, each 0 to 1, if the thing is painted */
  const char *material, *layer; /* names of the thing's material and layer; "" if it has none */
  const char *file;      /* name of the file in which the program makes the thing; NULL if not known */
  uint32_t line, column;
  const void *thing;     /* the library's own data about the thing */
} vs_thing;

typedef enum {
  VS_KIND_WRITTEN,
  VS_KIND_WHOLE,   /* at VS_THING_ENTER: the callback has written the thing with all of its children, which the library
                    * then skips */
  VS_KIND_SIMPLER, /* the callback has written nothing, and the library must replace the thing by simpler things */
  VS_KIND_FAILED   /* the callback has failed, and has passed the reason to vs_output_fail */
} vs_kind_status;

typedef struct {
  const char *kind;
  vs_kind_status (*write)(void *context, vs_output *out, const vs_thing *thing);
} vs_format_kind;

typedef struct {
  const char *name, *suffix, *doc; /* name, suffix and description, as in vs_format_info; doc may be NULL */
  bool binary;
  const vs_format_kind *kinds;
  size_t kind_count;
  bool (*begin)(void *context, vs_output *out); /* writes the file's beginning; returns false on failure; may be NULL */
  bool (*end)(void *context, vs_output *out);   /* writes the file's end; returns false on failure; may be NULL */
  void *context;                   /* argument of each callback; must exist as long as the interpreter */
} vs_format_own;

/* Adds a format to this interpreter, for -o file.suffix and for its name. Of several formats with the same suffix, the
 * newest is used. Returns false if the library already has the name or suffix, if these are not valid, if a kind does
 * not exist, if "polyface-mesh" is missing, or if memory is out. */
VS_API bool vs_register_format(vs_scheme *s, const vs_format_own *format);

/* vs_output_write, vs_output_number and vs_output_fail are for callbacks. They return false if the output has failed;
 * the callback then returns VS_KIND_FAILED or false. */
VS_API bool vs_output_write(vs_output *out, const void *bytes, size_t count);
VS_API bool vs_output_print(vs_output *out, const char *text);
/* Writes x as the library's own formats do: as the shortest text of at most 12 significant digits. */
VS_API bool vs_output_number(vs_output *out, double x);
/* Reports an error at the place of the current thing in the program. Returns false. */
VS_API bool vs_output_fail(vs_output *out, const char *message);

/* Reads a field of a thing: a number, flag (0 or 1), point (3 numbers), list of points or matrix. field: the field's
 * name in the tree dump (-o x.tree). Copies at most `room` numbers to out. Returns how many numbers the field has, or 0
 * if there is no such field. */
VS_API size_t vs_thing_numbers(const vs_thing *t, const char *field, double *out, size_t room);
VS_API const char *vs_thing_text(const vs_thing *t, const char *field); /* Returns the text of a thing's field, or NULL
                                                                         * if the thing has no such field with text. */
/* Computes a mesh of the thing, or of an operation with all of its children. The triangles are in the thing's own
 * coordinates, counter-clockwise from outside, at the output's tolerance. The arrays are valid until the next call.
 * Returns false on failure. */
typedef struct {
  const double (*points)[3];
  size_t point_count;
  const uint32_t (*corners)[3];
  size_t count;
} vs_triangles;
VS_API bool vs_thing_triangles(vs_output *out, const vs_thing *t, vs_triangles *result);

/* ---- meshes for hosts that draw ----
 *
 * vs_meshes_begin computes the drawing, with the scene's nodes, as triangles and curves. Then vs_mesh_next returns the
 * differences from the last call of vs_meshes_begin, one by one: removed meshes first, then new and moved meshes. Equal
 * shapes share a mesh, which has several places. The library does not compute the mesh of a shape again if the host has
 * it. A round shape gets a new mesh if a smaller tolerance applies. */

typedef enum {
  VS_MESH_REMOVED, /* the mesh was removed; only the id is set */
  VS_MESH_CHANGED, /* the mesh moved; only the id and the places are set */
  VS_MESH_ADDED
} vs_mesh_change;

typedef struct {
  const char *material;  /* name of the part's material; "" if it has none */
  uint64_t material_id;  /* number that the material handler has returned for the name of the material; 0 if there is
                          * none */
  bool painted;          /* whether the part has a material or colour; if not, the values below are those of a matt
                          * grey */
  double color[4];       /* colour in sRGB and opacity, each 0 to 1 */
  double roughness, metallic, ior;
  const char *layer;     /* name of the part's layer; "" if it has none */
  const char *file;      /* name of the file in which the program makes the part; NULL if not known */
  uint32_t line, column;
} vs_mesh_part;

typedef struct {
  vs_mesh_change change;
  uint64_t id;           /* number of the mesh: in every run, equal for equal shapes with equal tolerance and
                          * material */
  const double (*points)[3]; size_t point_count;
  /* indices in `points` of the corners of each triangle, counter-clockwise from outside. If there are no triangles, the
   * points are those of a curve, in order. */
  const uint32_t (*corners)[3]; size_t triangle_count;
  /* Unit normals, and for each corner of each triangle the index of its normal. Normals are smooth on curved faces, and
   * differ at sharp edges. */
  const double (*normals)[3]; size_t normal_count; const uint32_t (*normal_corners)[3];
  const uint32_t *part_of; /* part_of[i]: index of the part that contains triangle i; if part_of is NULL, all triangles
                            * belong to part 0 */
  const vs_mesh_part *parts; size_t part_count;
  /* Matrices of the mesh's places, which map the mesh's coordinates to the drawing's: a row for each of x, y and z,
   * with the translation last. */
  const double (*places)[3][4]; size_t place_count;
} vs_mesh_info;

/* Begins to pass the meshes of the current drawing. If o is NULL, uses the default options. After a failure, the host
 * keeps its meshes. An empty drawing is a failure, as for vs_write_drawing, but vs_mesh_next then returns the removed
 * meshes. */
VS_API vs_outcome vs_meshes_begin(vs_scheme *s, const vs_output_options *o);
/* Sets *out to the next mesh that differs. Returns false if there are no more. The arrays are valid until the next
 * call; a host that needs them longer must copy them. */
VS_API bool vs_mesh_next(vs_scheme *s, vs_mesh_info *out);
VS_API void vs_meshes_forget(vs_scheme *s); /* Forgets the meshes that the host has, so that the next vs_meshes_begin
                                             * passes all meshes. Also removes the material handler. */
/* Sets a callback that vs_mesh_next calls once for the name of each material. The callback returns the number by which
 * the host identifies the material. */
VS_API void vs_material_handler(vs_scheme *s, uint64_t (*ask)(void *context, const char *name), void *context);

/* ---- values that a host holds ----
 *
 * A handle refers to a value of the interpreter: a number, a text, an object, a node. The value lives until the host
 * has released the handle as often as it made and retained it; vs_restart ends all handles. 0 is not a handle. A
 * function that returns a handle returns 0 on failure, after a call of `diagnose`. A released handle, or one of another
 * interpreter, is an error and changes nothing.
 *
 * A callback of a running program may make, read and release handles, read a node's name, parent and children, and call
 * vs_post. Every function that would run code in the same interpreter fails there with VS_OUTCOME_USAGE. */

typedef uint64_t vs_handle;

typedef enum {
  VS_HANDLE_NONE, /* the value 0, which is not a handle */
  VS_HANDLE_BOOLEAN, VS_HANDLE_NUMBER, VS_HANDLE_TEXT, VS_HANDLE_SYMBOL,
  VS_HANDLE_LIST, /* a proper list; a pair such as (1 . 2) is VS_HANDLE_OTHER */
  VS_HANDLE_POINT, VS_HANDLE_VECTOR, VS_HANDLE_MATRIX, VS_HANDLE_OBJECT, VS_HANDLE_NODE, VS_HANDLE_PROPERTY,
  VS_HANDLE_PROCEDURE, VS_HANDLE_OTHER,
  VS_HANDLE_HOST /* an object of the host, made by vs_handle_host */
} vs_handle_kind;

VS_API vs_handle vs_handle_retain(vs_scheme *s, vs_handle h); /* Retains the handle h and returns it. */
VS_API void vs_handle_release(vs_scheme *s, vs_handle h);     /* Releases the handle; h may be 0. */

VS_API vs_handle vs_handle_boolean(vs_scheme *s, bool b);
VS_API vs_handle vs_handle_number(vs_scheme *s, double x);
VS_API vs_handle vs_handle_integer(vs_scheme *s, int64_t n); /* Returns a handle to the exact integer n. */
/* Returns a handle to the number that the text denotes in a program, such as "1/3" or an integer of any size. Returns 0
 * if the text is not a number, or memory is out. */
VS_API vs_handle vs_handle_number_text(vs_scheme *s, const char *text);
VS_API vs_handle vs_handle_text(vs_scheme *s, const char *text);
/* Returns a handle to a text of `length` bytes, which may contain zero bytes. */
VS_API vs_handle vs_handle_text_bytes(vs_scheme *s, const char *text, size_t length);
VS_API vs_handle vs_handle_symbol(vs_scheme *s, const char *name);
VS_API vs_handle vs_handle_point(vs_scheme *s, double x, double y, double z);
VS_API vs_handle vs_handle_vector(vs_scheme *s, double x, double y, double z);
VS_API vs_handle vs_handle_list(vs_scheme *s, const vs_handle *items, size_t count);

/* Makes an opaque value from an object of the host. Programs can pass the value on, but cannot inspect it. If release
 * is not NULL, the interpreter owns the object. It calls release once no value refers to the object: at the end of a
 * later evaluation, in vs_restart or in vs_free. release must not call the interpreter. If release is NULL, the host
 * owns the object, which must exist as long as the interpreter. */
VS_API vs_handle vs_handle_host(vs_scheme *s, void *object, void (*release)(void *context, void *object),
    void *context);
VS_API void *vs_handle_get_host(vs_scheme *s, vs_handle h); /* Returns the object that was passed to vs_handle_host, or
                                                             * NULL if h refers to another kind of value. */

VS_API vs_handle_kind vs_handle_kind_of(vs_scheme *s, vs_handle h);
VS_API bool vs_handle_get_boolean(vs_scheme *s, vs_handle h); /* Returns false for #f, true for every other value. */
/* Reads a value that consists of numbers: a number (1), a point or vector (3), or a matrix (16, row by row). Copies at
 * most `room` numbers to out. Returns how many numbers the value has, or 0 for any other value. */
VS_API size_t vs_handle_get_numbers(vs_scheme *s, vs_handle h, double *out, size_t room);
/* Sets *out to the value of an exact integer of at most 64 bits. Returns false for any other value. */
VS_API bool vs_handle_get_integer(vs_scheme *s, vs_handle h, int64_t *out);
VS_API bool vs_handle_is_exact(vs_scheme *s, vs_handle h); /* Returns true if the value is an exact number, whose text
                                                            * contains all digits. */
/* Returns the text of a string or symbol, or a number as a program writes it; NULL for any other value. The text is
 * valid until the next call of this function or of vs_handle_get_text_bytes. */
VS_API const char *vs_handle_get_text(vs_scheme *s, vs_handle h);
VS_API const char *vs_handle_get_text_bytes(vs_scheme *s, vs_handle h, size_t *length); /* As vs_handle_get_text, for a
                                                                                         * text that may contain zero
                                                                                         * bytes; sets *length to its
                                                                                         * length in bytes. */
/* Returns the number of elements of a list, or 0 for any other value. */
VS_API size_t vs_handle_count(vs_scheme *s, vs_handle list);
VS_API vs_handle vs_handle_item(vs_scheme *s, vs_handle list, size_t index);
VS_API bool vs_handle_same(vs_scheme *s, vs_handle a, vs_handle b); /* Returns true if both handles refer to the same
                                                                     * value (eq?). */

/* vs_lookup returns a handle to the value of a name of the program or the language. vs_apply calls a procedure. If the
 * program fails, vs_apply passes the error to `diagnose` and sets no result. result may be NULL. */
VS_API vs_handle vs_lookup(vs_scheme *s, const char *name);
VS_API bool vs_define(vs_scheme *s, const char *name, vs_handle value);
/* Evaluates a text as vs_eval_text does. Sets *value to a handle to the value of the text's last form, or to 0 if the
 * evaluation did not end with VS_OUTCOME_DONE. */
VS_API vs_outcome vs_eval_value(vs_scheme *s, const char *name, unsigned first_line, const char *text, size_t length,
    unsigned flags, vs_handle *value);
VS_API vs_outcome vs_apply(vs_scheme *s, vs_handle procedure, const vs_handle *arguments, size_t count,
    vs_handle *result);

/* A procedure of the host. The interpreter releases the arguments after the call. *result is 0 at first, which means no
 * value. The procedure may set *result to a handle, which the interpreter then owns. If the procedure returns false,
 * the program gets an error with the text from vs_host_fail. context must exist as long as the interpreter. name: the
 * procedure's name in messages. */
typedef bool vs_host_fn(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *result);
VS_API vs_handle vs_host_procedure(vs_scheme *s, const char *name, vs_host_fn *fn, void *context);
VS_API void vs_host_fail(vs_scheme *s, const char *message);

/* ---- the scene: nodes, as on the manual's page 'Scenes' ----
 *
 * Each function does the same as a procedure of the language, whose name is in the comment or follows from the
 * function's name. The rules and messages are equal, too. */

VS_API vs_handle vs_scene_controller(vs_scheme *s); /* as (node-controller): returns the controller, whose properties
                                                     * are the events of the scene */
VS_API vs_handle vs_node_root(vs_scheme *s);
/* as (node-create type #:name name #:parent parent). If type is NULL, the type is 'context. A NULL name or a parent of
 * 0 means that the node has none */
VS_API vs_handle vs_node_create(vs_scheme *s, const char *type, const char *name, vs_handle parent);
/* Returns the node with this name. Returns 0, without an error, if there is no such node. */
VS_API vs_handle vs_node_find(vs_scheme *s, const char *name);
/* vs_node_parent, vs_node_children and vs_node_name run no code of the program, so a callback of a running program may
 * call them too. */
VS_API vs_handle vs_node_parent(vs_scheme *s, vs_handle node); /* Returns the node's parent, or 0 if the node has
                                                                * none. */
VS_API vs_handle vs_node_children(vs_scheme *s, vs_handle node); /* Returns a list of the node's children. */
/* Returns the node's name, or NULL if the node has none. The text is valid as long as that of vs_handle_get_text. */
VS_API const char *vs_node_name(vs_scheme *s, vs_handle node);
VS_API vs_outcome vs_node_add_child(vs_scheme *s, vs_handle parent, vs_handle child);
VS_API vs_outcome vs_node_remove_child(vs_scheme *s, vs_handle parent, vs_handle child);
/* Places a node. Each array has three numbers; the rotation is in degrees about X, Y and Z. If an array is NULL, that
 * part of the placement stays unchanged. */
VS_API vs_outcome vs_node_place(vs_scheme *s, vs_handle node, const double *translate, const double *degrees,
    const double *scale);
/* Computes the matrix from the node's coordinates to those of its parent, or of the world if `world` is true. The
 * matrix is stored row by row, for column vectors. */
VS_API bool vs_node_matrix(vs_scheme *s, vs_handle node, bool world, double out[16]);
/* Sets the node's own drawing. drawing: an object, or a list of objects. */
VS_API vs_outcome vs_node_set_drawing(vs_scheme *s, vs_handle node, vs_handle drawing);
VS_API vs_handle vs_node_object(vs_scheme *s, vs_handle node); /* Returns an object that contains all visible drawings
                                                                * of the node and the nodes below it. */

/* vs_node_begin and vs_node_end begin and end a focus. The focus is the node to whose drawing `draw` adds. vs_node_end
 * cannot end the focus of the root. */
VS_API vs_outcome vs_node_begin(vs_scheme *s, vs_handle node);
VS_API vs_outcome vs_node_end(vs_scheme *s);
VS_API vs_handle vs_node_focus(vs_scheme *s);
/* Evaluates the text's expressions in the node's own program, with the focus on the node. Sets *result to the last
 * expression's value. */
VS_API vs_outcome vs_node_eval(vs_scheme *s, vs_handle node, const char *text, vs_handle *result);

/* ---- properties of nodes, groups and the controller ---- */

VS_API vs_handle vs_property_of(vs_scheme *s, vs_handle group, const char *name); /* Returns the property itself, not
                                                                                   * its value. */
VS_API vs_outcome vs_property_get(vs_scheme *s, vs_handle group, const char *name, vs_handle *value);
/* Sets the value of a property, and creates the property if needed. If the value changes, calls the subscribers before
 * it returns; if it is equal, calls none. */
VS_API vs_outcome vs_property_put(vs_scheme *s, vs_handle group, const char *name, vs_handle value);
/* Adds a callback, which receives each new value of the property. Returns the number of this subscription, or 0 on
 * failure. */
VS_API uint64_t vs_property_subscribe(vs_scheme *s, vs_handle property, vs_host_fn *fn, void *context);
VS_API vs_outcome vs_property_unsubscribe(vs_scheme *s, vs_handle property, uint64_t id);
/* Queues a new value for the property until the next vs_update. A callback may call this function while the interpreter
 * runs. */
VS_API bool vs_post(vs_scheme *s, vs_handle property, vs_handle value);
/* Makes the changes that vs_post has queued, in order. If a callback fails, reports its error and calls the remaining
 * callbacks. A change that is queued during vs_update waits for the next vs_update. */
VS_API vs_outcome vs_update(vs_scheme *s);

/* ---- actions and picks ---- */

VS_API vs_outcome vs_action_apply(vs_scheme *s, const char *action, vs_handle node); /* as (action-apply 'action
                                                                                      * node) */
/* Applies the actions update, draw and finish to the whole tree of nodes. */
VS_API vs_outcome vs_scene_frame(vs_scheme *s, double seconds);

typedef struct {
  double distance;      /* distance of the intersection from the ray's start, in model units */
  double point[3];
  vs_handle node, path; /* node: the node that the ray intersects. path: list of the nodes from the root to it. Both
                         * handles are valid only in the callback, unless retained */
  const char *file;     /* name of the file in which the program makes the object; NULL if not known */
  uint32_t line, column;
} vs_hit;
/* Passes each node whose own drawing the ray intersects to `each`, nearest first, until `each` returns false. Selects
 * the nearest node, which triggers the event Node.selected. */
VS_API vs_outcome vs_pick(vs_scheme *s, const double from[3], const double direction[3], bool (*each)(void *context,
    vs_scheme *s, const vs_hit *hit),
                          void *context);

/* ---- gizmos and input, as on the manual's page 'Scenes' ---- */

typedef enum { VS_GIZMO_TRIGGER, VS_GIZMO_SLIDER, VS_GIZMO_ARROW, VS_GIZMO_TRIPOD } vs_gizmo_kind;

typedef struct {
  vs_handle node;       /* node of the gizmo; the handle is valid only in the callback, unless retained */
  vs_gizmo_kind kind;
  double at[3];         /* position of the gizmo for value 0, or for a slider's least value. All positions are in world
                         * coordinates */
  double size;          /* diameter of a handle, or length of an arrow or a tripod */
  size_t value_count;   /* number of the gizmo's values: 3 for a tripod, otherwise 1 */
  double value[3];      /* values of the gizmo; for a trigger, the number of clicks */
  double low[3], high[3]; /* least and greatest value; for a tripod, those of a single drag; for a trigger, 0 */
  double step;          /* distance between two allowed values of a slider; 0 if any value is allowed */
  size_t handle_count;  /* number of points that the user can drag, 0 to 3 */
  double handles[3][3]; /* positions of the points that the user drags */
  /* How far each handle moves. For a slider: when its value goes from the least to the greatest. For a trigger: 0.
   * Otherwise: when the value grows by 1. */
  double axes[3][3];
} vs_gizmo;
/* Passes each gizmo below the root to `each`, parents before children, until `each` returns false. The gizmo's value is
 * its property "value". vs_property_put sets the value, and refuses a value out of range or between two steps.
 * vs_property_subscribe reports changes of the value. */
VS_API vs_outcome vs_gizmos(vs_scheme *s, bool (*each)(void *context, vs_scheme *s, const vs_gizmo *gizmo),
                            void *context);

typedef enum { VS_INPUT_PRESS, VS_INPUT_DRAG, VS_INPUT_RELEASE, VS_INPUT_MOVE, VS_INPUT_KEY } vs_input_kind;
typedef enum { VS_BUTTON_LEFT, VS_BUTTON_MIDDLE, VS_BUTTON_RIGHT, VS_BUTTON_NONE } vs_input_button;
/* Handles an event as (node-input ...) does: gizmos move within their constraints. from, direction: the ray under the
 * mouse, for a mouse event. An event of a key has the key's name and no ray. Sets *node to the node that received the
 * event, or to 0 if none did; node may be NULL. */
VS_API vs_outcome vs_input(vs_scheme *s, vs_input_kind kind, vs_input_button button, const double from[3],
                           const double direction[3], const char *key, vs_handle *node);

/* ---- statistics ---- */

typedef struct {
  const char *key;   /* key, equal in all versions of the library, such as "nodes.distinct" or "time.mesh" */
  double value;
  const char *unit;  /* unit of the value: "s", "bytes", or "" for a count */
} vs_statistic;
/* Copies at most `room` statistics since vs_new to out, in a fixed order. Returns how many statistics there are. A
 * value of NaN means that it was not counted. The manual's page on the command explains each key. */
VS_API size_t vs_statistics(const vs_scheme *s, vs_statistic *out, size_t room);

typedef struct {
  const char *path;   /* path of the output; "" if a callback received the output */
  const char *format; /* name of the format, as in vs_format_info.name */
  bool done;          /* whether the output succeeded */
} vs_output_info;
/* Copies at most `room` statistics of one output to out. Index 0 is the oldest of the latest 64 outputs. The keys are
 * those of vs_statistics that apply to a single output. Sets *count to the number of statistics, independent of `room`.
 * Returns false if there is no such index. */
VS_API bool vs_output_statistics(const vs_scheme *s, size_t index, vs_output_info *info, vs_statistic *out, size_t room,
    size_t *count);

#ifdef __cplusplus
}
#endif

#endif
