/* Owns the outside of one interpreter: the embedder's options, memory, files, sources kept for messages, the
 * interrupt flag. session/visualscheme.c implements the public functions; vm->host and vm->config.user both point to
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
#include "model/tally.h"
#include "visualscheme.h"
#include "vm/library/port.h"
#include "vm/values/text.h"

/* The text of a source, from which messages show lines. */
typedef struct {
  char *name, *text;
  size_t name_bytes, length, room, lines /* lines: the number of lines that end in it */;
  unsigned first_line;
  bool before; /* it was read before vs_restart, and not since */
} vs_source;

/* A file that the program has read or created (inputs.c). */
typedef struct { uint64_t device, node; char *path; bool made; } vs_known_file;

enum { VS_STREAMS = 64 };
typedef struct {
  bool open, reading;
  FILE *file;               /* a file being written, or a large file being read */
  char *text; size_t length, at; /* a file read whole; free() frees it */
} vs_stream;

/* The stages of a drawing on its way to an output (spine.c). */
typedef enum {
#define VS_STAGE(upper, lower, when, formats, doc) VS_STAGE_##upper,
#include "session/stages.def"
  VS_STAGE_COUNT
} vs_stage;

/* The account of one output: time, memory and counts. NAN: not counted. */
typedef struct {
  char *path; size_t path_bytes; /* path: "" for an output to a callback */
  const char *format;       /* owned by the library */
  bool done;
  vs_tally tally;           /* the differences from begin to end; the peaks are the output's own */
  double nodes, distinct;   /* of the drawing as a tree: all nodes, and different ones by value */
  vs_pass_stats passes;
  /* commands with this pass only; with all other requested passes */
  double alone[VS_PASS_COUNT], without[VS_PASS_COUNT];
  vs_cache_stats cache;     /* hits and misses: the differences */
  double stages[VS_STAGE_COUNT]; /* seconds of each stage; NAN: the format skips it, or the output had failed before */
} vs_output_record;

/* A procedure that samples have found running (names.c). */
typedef struct { vs_value name; vs_pos place; uint64_t own, whole; } vs_profile_row;

typedef struct vs_own_format vs_own_format;
typedef struct vs_handles vs_handles;
typedef struct vs_host_meshes vs_host_meshes;
typedef struct vs_scan_fit vs_scan_fit;

typedef struct {
  vs_bind bind;             /* first: vm->host points to it */
  vs_options options;
  void *texts; size_t text_bytes; /* the block with the copied texts of the options */
  size_t bytes;             /* the bytes allocated for heap and model together */
  vs_tally tally;           /* the time and memory of each kind of work */
  bool limited;             /* the limit refused the last request for memory, not the machine */
  atomic_bool interrupted;
  bool exit_requested;
  int exit_code;
  double told_progress;     /* clock of the last progress call */
  const char *phase;        /* the text of the progress line while the program runs; NULL: nothing runs */
  vs_stream stream[VS_STREAMS];
  vs_source *sources;
  size_t source_count, source_room;
  vs_known_file *inputs;
  size_t input_count, input_room;
  char why[256];            /* the reason of the last failed file operation */
  double evaluate_seconds, write_seconds;
  bool writing, late;       /* an output is being written; the limit of time has stopped it */
  double write_began, write_worker; /* the clock at its begin; the seconds that workers had taken by then */
  vs_output_record *outputs; /* the last ones, oldest first */
  size_t output_count, output_room;
  vs_ref *kept; size_t kept_count; /* the objects of vs_drawing_keep; nodes retained (comparison.c) */
  vs_ref *change; size_t change_count; /* the objects that show the differences of vs_drawing_compare; nodes retained */
  vs_own_format *own_formats; /* the host's formats, newest first (own_formats.c) */
  vs_scan_fit *fit;         /* the last fit (fit/scan_fit.c); NULL: there was none */
  vs_handles *handles;      /* the host's handles (handles.c); NULL: none so far */
  vs_host_meshes *meshes;   /* the host's meshes (host_meshes.c); NULL: none */
  unsigned flags;           /* VS_EVAL_... of the current evaluation */
  unsigned results;         /* the number of names $1, $2 ... in use */
  bool profiling;
  uint64_t looks;
  vs_profile_row profile[256];
  size_t profile_count;
} vs_session;

static inline vs_session *vs_session_of(const vs_scheme *vm) { return (vs_session *)vm->host; }

#endif
