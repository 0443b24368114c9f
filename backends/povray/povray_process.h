/* Declares a process of POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PROCESS_H
#define VS_BACKENDS_POVRAY_POVRAY_PROCESS_H

#include <sys/types.h>

#include "backends/backend.h"

enum { VS_POVRAY_TEXT_ROOM = 1 << 15, VS_POVRAY_PATH_ROOM = 4096 };

typedef struct {
  pid_t process;              /* number of the process; 0: no process runs */
  int errors;                 /* reading end of a pipe from the process's standard error; -1: the process has closed its
                               * end */
  char text[VS_POVRAY_TEXT_ROOM]; /* messages of the process, without the progress; if they are too long, without their
                                   * beginning */
  size_t used;
  char piece[256];            /* progress text since the last carriage return */
  size_t piece_used;
  bool in_piece;
  struct {                    /* memory or disk space that the process needs for its picture */
    double megabytes;
    const char *folder;       /* folder of the file in which POV-Ray keeps the picture; NULL: POV-Ray keeps the picture
                               * in memory */
  } room;
  double fraction;            /* fraction of the process's pixels that are rendered; it never decreases */
} vs_povray_process;

/* Starts POV-Ray in its private folder, which contains an ini file. Returns false with the error set; no process then
 * runs. */
bool vs_povray_start(vs_emitter *e, vs_povray_process *p, const char *folder, char *const *arguments);
/* Reads POV-Ray's output since the last call. Call it when p->errors is readable. */
void vs_povray_hear(vs_povray_process *p);
/* Returns true if the process has ended. Then also ends the processes that it started, and sets *status to its exit
 * status. Call it when p->errors is -1. */
bool vs_povray_ended(vs_povray_process *p, int *status);
/* Ends `count` processes by a signal and, if they still run after two seconds, by SIGKILL. */
void vs_povray_stop(vs_povray_process *at, size_t count);
/* Returns true if an ended process has rendered its picture. If POV-Ray warned that the picture may be wrong, sets
 * e->flaw. If there is no picture, returns false with the error set. */
bool vs_povray_judge(vs_emitter *e, vs_povray_process *p, int status);
/* Returns true if the process gave up before it began, because the machine was too busy. */
bool vs_povray_was_starved(const vs_povray_process *p, int status);

#endif
