/* Owns one interpreter's outside: what the embedder gave, memory, files, sources kept for messages, the interrupt flag.
 * session/visualscheme.c is the public face of it; vm->host and vm->config.user both point to it. */
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

/* The text of a source, for the line that a message shows. */
typedef struct {
  char *name, *text;
  size_t name_bytes, length, room, lines /* that end in it */;
  unsigned first_line;
  bool before; /* it was read before vs_restart, and not since */
} vs_source;

/* A file that was read, or that the program has begun itself (inputs.c). */
typedef struct { uint64_t device, node; char *path; bool made; } vs_known_file;

enum { VS_STREAMS = 64 };
typedef struct {
  bool open, reading;
  FILE *file;               /* being written, or a large file being read */
  char *text; size_t length, at; /* a file read whole: freed by free() */
} vs_stream;

/* The stages that a drawing goes through on its way to an output (spine.c). */
typedef enum {
#define VS_STAGE(upper, lower, when, formats, doc) VS_STAGE_##upper,
#include "session/stages.def"
  VS_STAGE_COUNT
} vs_stage;

/* The account of one output: time, memory and counts. NAN: was not counted. */
typedef struct {
  char *path; size_t path_bytes; /* path "" where it went into a callback */
  const char *format;       /* the library's */
  bool done;
  vs_tally tally;           /* the differences that it made; peaks its own */
  double nodes, distinct;   /* of the drawing, as a tree; by value */
  vs_pass_stats passes;
  /* commands with this pass only; with all others that were asked for */
  double alone[VS_PASS_COUNT], without[VS_PASS_COUNT];
  vs_cache_stats cache;     /* hits and misses: the differences */
  double stages[VS_STAGE_COUNT]; /* seconds of each stage; NAN: the format does without it, or the output had failed
                                  * before */
} vs_output_record;

/* A procedure that was seen running (names.c). */
typedef struct { vs_value name; vs_pos place; uint64_t own, whole; } vs_profile_row;

typedef struct vs_own_format vs_own_format;
typedef struct vs_handles vs_handles;
typedef struct vs_host_meshes vs_host_meshes;
typedef struct vs_scan_fit vs_scan_fit;

typedef struct {
  vs_bind bind;             /* first: vm->host points to it */
  vs_options options;
  void *texts; size_t text_bytes; /* what the options' texts were copied into */
  size_t bytes;             /* handed out by the allocator, heap and model together */
  vs_tally tally;           /* what took how long, and how much of them */
  bool limited;             /* the last refusal of memory was the limit's, not the machine's */
  atomic_bool interrupted;
  bool exit_requested;
  int exit_code;
  double told_progress;     /* clock of the last progress call */
  const char *phase;        /* what a progress line says while the program runs */
  vs_stream stream[VS_STREAMS];
  vs_source *sources;
  size_t source_count, source_room;
  vs_known_file *inputs;
  size_t input_count, input_room;
  char why[256];            /* of the last failed file operation */
  double evaluate_seconds, write_seconds;
  bool writing, late;       /* an output is under way; it was stopped by the limit of time */
  double write_began, write_worker; /* clock when it began; what workers had taken by then, in seconds */
  vs_output_record *outputs; /* of the last ones, oldest first */
  size_t output_count, output_room;
  vs_ref *kept; size_t kept_count; /* what vs_drawing_keep keeps; nodes retained (comparison.c) */
  vs_ref *change; size_t change_count; /* what vs_drawing_compare found, to be shown; nodes retained */
  vs_own_format *own_formats; /* that the host brought, newest first (own_formats.c) */
  vs_scan_fit *fit;         /* the last fit (fit/scan_fit.c); NULL: there was none */
  vs_handles *handles;      /* what the host holds (handles.c); NULL: nothing so far */
  vs_host_meshes *meshes;   /* that the host was handed (host_meshes.c); NULL: none */
  unsigned flags;           /* VS_EVAL_... of the evaluation under way */
  unsigned results;         /* how many have the names $1, $2 ... */
  bool profiling;
  uint64_t looks;
  vs_profile_row profile[256];
  size_t profile_count;
} vs_session;

static inline vs_session *vs_session_of(const vs_scheme *vm) { return (vs_session *)vm->host; }

#endif
