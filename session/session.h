/* Owns one interpreter's outside: what the embedder gave, memory, files, sources kept for messages, the interrupt flag.
 * session/visualscheme.c is the public face of it; vm->host and vm->config.user both point to it. */
#ifndef VS_SESSION_SESSION_H
#define VS_SESSION_SESSION_H

#include <stdatomic.h>
#include <stdio.h>

#include "backends/export.h"
#include "bind/bind.h"
#include "model/store/cache.h"
#include "passes/passes.h"
#include "model/scene.h"
#include "model/tally.h"
#include "bind/scene/node_natives.h"
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

/* ---- visualscheme.c ---- */
/* Begins an evaluation: the limits count from here, and what the last one left behind is forgotten. */
void vs_session_begin(vs_session *s, unsigned flags);
/* Ends it: what it made is told, or its condition is; usage: its fault is the caller's, exit 2. */
vs_outcome vs_session_finish(vs_session *s, bool ok, bool usage);
vs_outcome vs_session_out_of_memory(vs_session *s); /* Reports it to the host. */

static inline vs_session *vs_session_of(const vs_scheme *vm) { return (vs_session *)vm->host; }

/* ---- host.c ---- */
void *vs_session_memory(void *session, void *old, size_t old_bytes, size_t bytes);  /* of the VM and of the store */
double vs_session_clock(void *session);                                            /* seconds, monotonic */
bool vs_session_interrupted(void *session);
extern const vs_io vs_session_io;
/* A whole file as malloc'ed text; false: *why. source: it is kept as one, for messages. */
bool vs_session_read(vs_session *s, const char *path, bool source, char **text, size_t *length, const char **why);
bool vs_session_keep_source(vs_session *s, const char *name, unsigned first_line, const char *text, size_t length);
void vs_session_close_files(vs_session *s);
void vs_session_free_sources(vs_session *s);

/* ---- statistics.c ---- */
/* Round an output: begin before anything is done for it, count when the drawing is ready for the passes, end when it is
 * written or has failed. False: out of memory. */
/* The host's format of this name, ending or path; NULL: it brought none such. */
const vs_format *vs_session_own_format(const vs_session *s, const char *text);
void vs_session_free_own_formats(vs_session *s);
bool vs_session_output_begin(vs_session *s, const char *path, const char *format);
bool vs_session_output_nodes(vs_session *s, const vs_scene *scene, unsigned passes, vs_error *e);
void vs_session_output_end(vs_session *s, bool done);
void vs_session_free_outputs(vs_session *s);

/* ---- report.c ---- */
/* Copies the line into room; NULL: the source is not kept or has no such line. */
const char *vs_session_source_line(const vs_session *s, const char *file, uint32_t line, char *room, size_t size);
vs_outcome vs_session_report_condition(vs_session *s, vs_value condition,
                                       bool usage /* its own fault is the caller's: exit 2 */);
bool vs_session_span(vs_session *s, vs_pos place, vs_span *out); /* false: nowhere in the user sources */
vs_outcome vs_session_report_error(vs_session *s, const vs_error *e);
void vs_session_report(vs_session *s, vs_severity severity, vs_outcome outcome, const vs_origin *origin,
                       const char *message);
void vs_session_report_at(vs_session *s, vs_severity severity, vs_outcome outcome, const char *file, uint32_t line,
                          uint32_t column, const char *message);
void vs_session_warn(void *session, const vs_origin *origin, const char *message); /* vs_bind.warn */

#endif
