/* Owns the interface of povray_process.c: one process of POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PROCESS_H
#define VS_BACKENDS_POVRAY_POVRAY_PROCESS_H

#include <sys/types.h>

#include "backends/backend.h"

enum { VS_POVRAY_TEXT_ROOM = 1 << 15, VS_POVRAY_PATH_ROOM = 4096 };

typedef struct {
  pid_t process;              /* 0: none runs */
  int errors;                 /* the reading end of its standard error; -1: it has closed its own */
  char text[VS_POVRAY_TEXT_ROOM]; /* messages, without the progress; a text that is too long is cut at the front */
  size_t used;
  char piece[256];            /* of the progress: since the last carriage return */
  size_t piece_used;
  bool in_piece;
  double fraction;            /* the fraction of its pixels that are done; it never decreases */
} vs_povray_process;

/* Starts it in its private folder, with an existing ini file. Returns false with the error set; no process then
 * runs. */
bool vs_povray_start(vs_emitter *e, vs_povray_process *p, const char *folder, char *const *arguments);
/* Reads its output up to now; errors is readable. */
void vs_povray_hear(vs_povray_process *p);
/* Returns true if it has ended. Then the processes that it left are ended as well, and *status is its exit status. Call
 * it when errors is -1. */
bool vs_povray_ended(vs_povray_process *p, int *status);
/* Ends these, by a signal, and by SIGKILL after two seconds. */
void vs_povray_stop(vs_povray_process *at, size_t count);
/* Returns true if an ended process made its picture. If it did not, or wrote a warning, sets the error, with the place
 * in the model if its message names a line. */
bool vs_povray_judge(vs_emitter *e, vs_povray_process *p, int status);
/* Returns true if it gave up before it began, because the machine was too busy. */
bool vs_povray_was_starved(const vs_povray_process *p, int status);

#endif
