/* Owns the interface of povray_process.c: one process of POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PROCESS_H
#define VS_BACKENDS_POVRAY_POVRAY_PROCESS_H

#include <sys/types.h>

#include "backends/backend.h"

enum { VS_POVRAY_TEXT_ROOM = 1 << 15, VS_POVRAY_PATH_ROOM = 4096 };

typedef struct {
  pid_t process;              /* 0: none runs */
  int errors;                 /* our end of its standard error; -1: it has closed its own */
  char text[VS_POVRAY_TEXT_ROOM]; /* messages, without the progress; cut at the front if ever too long */
  size_t used;
  char piece[256];            /* of the progress: since the last carriage return */
  size_t piece_used;
  bool in_piece;
  double fraction;            /* of its pixels; it never falls */
} vs_povray_process;

/* Starts it in its private folder, with an ini file that is there. False: the error says why, and none runs. */
bool vs_povray_start(vs_emitter *e, vs_povray_process *p, const char *folder, char *const *arguments);
/* Takes what it has said by now; errors is readable. */
void vs_povray_hear(vs_povray_process *p);
/* Has it ended? Then what it started and left goes as well, and *status is how it ended. Asked when errors is -1. */
bool vs_povray_ended(vs_povray_process *p, int *status);
/* Ends these, hard if they do not listen within two seconds. */
void vs_povray_stop(vs_povray_process *at, size_t count);
/* Returns whether one that has ended made its picture; if not, or if it complained, the error is set, at the model's
 * place where its message names a line. */
bool vs_povray_judge(vs_emitter *e, vs_povray_process *p, int status);
/* Did it give up before it began, because the machine had too much other work? */
bool vs_povray_was_starved(const vs_povray_process *p, int status);

#endif
