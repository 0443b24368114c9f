/* Declares the limits that the process itself enforces in addition to the library's. Implemented in limits.c. */
#ifndef VS_CLI_LIMITS_H
#define VS_CLI_LIMITS_H

#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct {
  double limit;               /* seconds allowed for one step (an evaluation or an output); 0: no watch */
  const char *name;           /* name of the model, for the message */
  bool prompt;                /* whether the steps are those of the prompt; set before the watch begins */
  int scheduling;             /* descriptor of the system's statistics that show how long this process waited for a
                               * processor, or -1 */
  _Atomic double began;       /* clock at the start of the current step, or 0 between steps */
  _Atomic double polled;      /* clock when the library last polled */
  _Atomic bool evaluating;    /* whether the step is an evaluation, in which one limit applies to all of its parts
                               * together */
  _Atomic bool told;          /* whether a message has already reported that the limit was exceeded */
  bool watching;              /* whether the watching thread runs */
  pthread_t thread;
  sem_t closed;               /* semaphore, posted to end the thread */
} cli_watch;

/* Limits the data memory of the process to 1.1 times `limit` (in bytes) and some megabytes. Has no effect if the system
 * does not support it. */
void cli_limits_memory(size_t limit);
/* Limits the data of the process and its children to `most` bytes, permanently. */
void cli_limits_memory_for_good(size_t most);
/* Prepares a watch. Opens the files that it needs, since a confined process cannot open them later. */
void cli_watch_open(cli_watch *w);
/* Starts the thread that watches steps; it reads *w until cli_watch_close. Returns false if no thread could be
 * started. */
bool cli_limits_watch(cli_watch *w);

/* Ends the watching thread, if there is one. Call it before *w or its name is freed. */
void cli_watch_close(cli_watch *w);

/* Begins to watch a library call that has a time limit. cli_watch_end ends this. */
void cli_watch_begin(cli_watch *w, bool evaluating);
/* Ends the watch of a library call. */
void cli_watch_end(cli_watch *w);
/* Records that the library polls now. vs_host.poll calls it. */
void cli_watch_poll(cli_watch *w);

#endif
