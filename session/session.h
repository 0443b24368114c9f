/* Declares the session: one interpreter with the embedder's options, memory, files, kept source texts and the
 * interrupt flag. session/visualscheme.c implements the public functions. vm->host and vm->config.user both point to
 * the session. */
#ifndef VS_SESSION_SESSION_H
#define VS_SESSION_SESSION_H

#include <stdatomic.h>
#include <stdio.h>

#include "backends/export.h"
#include "bind/state.h"
#include "model/store/cache.h"
#include "passes/passes.h"
#include "model/scene.h"
#include "model/job.h"
#include "visualscheme.h"
#include "vm/library/port.h"
#include "vm/values/text.h"

/* The text of a source file, kept because messages show its lines. */
typedef struct {
  char *name, *text;
  size_t name_bytes, length, room, lines /* lines: number of line ends in the text */;
  unsigned first_line;
  bool before; /* whether the source was read before the last vs_restart but not since then */
} vs_source;

enum { VS_STREAMS = 64 };
typedef struct {
  bool open, reading;
  FILE *file;               /* a file open for writing, or a large file open for reading */
  char *text; size_t length, at; /* text of a file that was read completely; freed by free() */
} vs_stream;

/* The stages through which a drawing becomes an output (spine.c). Each is a row of stages.def. */
typedef enum {
#define VS_STAGE(upper, lower, when, formats, doc) VS_STAGE_##upper,
#include "session/stages.def"
  VS_STAGE_COUNT
} vs_stage;

/* Times, memory and counts of one output. A number that was not counted is NAN. */
typedef struct {
  char *path; size_t path_bytes; /* path of the output file; "" if the output goes to a callback */
  const char *format;       /* name of the format, owned by the library */
  bool done;
  vs_tally tally;           /* times and counts of this output alone; peaks of memory are those since the output
                             * began */
  double nodes, distinct;   /* nodes: number of nodes of the drawing, in which a shared node counts once for each use;
                             * distinct: number of different nodes */
  vs_pass_stats passes;
  /* alone[i]: number of commands if pass i is the only pass that runs; without[i]: number of commands if all requested
   * passes except pass i run. */
  double alone[VS_PASS_COUNT], without[VS_PASS_COUNT];
  vs_cache_stats cache;     /* cache: counts of the results that this output looked for in the cache, and found or did
                             * not find */
  double stages[VS_STAGE_COUNT]; /* stages[i]: seconds of stage i; NAN if the format skips the stage, or the output
                                  * failed before the stage */
} vs_output_record;

#define VS_INPUT_KEPT "it was read by this run, and no output takes the place of what it is made from"

typedef struct vs_own_format vs_own_format;
typedef struct vs_handles vs_handles;
typedef struct vs_host_meshes vs_host_meshes;
typedef struct vs_scan_fit vs_scan_fit;
typedef struct vs_call_profile vs_call_profile;

typedef struct {
  vs_bind bind;             /* must be the first member: vs_bind pointers are converted to vs_session */
  vs_options options;
  void *texts; size_t text_bytes; /* one block of memory with copies of all texts in the options */
  size_t bytes;             /* number of bytes allocated for the interpreter's heap and the model together */
  vs_tally tally;           /* time and memory of each phase of work */
  bool limited;             /* whether the last refusal of memory was caused by the user's limit, not by the system */
  atomic_bool interrupted;
  bool exit_requested;
  int exit_code;
  double told_progress;     /* clock in seconds when progress was last reported to the host */
  const char *phase;        /* name of the phase that progress reports show while a program runs; NULL if no program
                             * runs */
  vs_stream stream[VS_STREAMS];
  vs_source *sources;
  size_t source_count, source_room;
  vs_known_files inputs;    /* the files that the program has read or created */
  char why[256];            /* reason why the last file operation failed */
  double evaluate_seconds, write_seconds;
  vs_job job;               /* job (limits, progress and messages) for work between outputs, which has no limits of its
                             * own */
  vs_job *writing;          /* job (limits, progress and messages) of the output that is being written; NULL if there is
                             * none */
  vs_output_record *outputs; /* times and counts of the latest outputs, oldest first */
  size_t output_count, output_room;
  vs_ref *kept; size_t kept_count; /* objects of vs_drawing_keep, whose nodes are retained (comparison.c) */
  vs_ref *change; size_t change_count; /* objects that show the differences of vs_drawing_compare, whose nodes are
                                        * retained */
  vs_own_format *own_formats; /* formats of the host, newest first (own_formats.c) */
  vs_scan_fit *fit;         /* the latest fit to a scan (fit/scan_fit.c), or NULL */
  vs_handles *handles;      /* handles of the host (handles.c), or NULL if it has none yet */
  vs_host_meshes *meshes;   /* meshes passed to the host (host_meshes.c), or NULL if there are none */
  unsigned flags;           /* flags VS_EVAL_... of the current evaluation */
  unsigned results;         /* number of names $1, $2 ... that the prompt has given to results */
  bool profiling;           /* whether the profiler takes samples of the running program */
  vs_call_profile *profile; /* samples of the profiler (profile/call_profile.c), or NULL */
} vs_session;

static inline vs_session *vs_session_of(const vs_scheme *vm) { return (vs_session *)vm->host; }

#endif
