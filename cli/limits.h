/* Owns the limits that the process itself enforces, in addition to the library's: see limits.c. */
#ifndef VS_CLI_LIMITS_H
#define VS_CLI_LIMITS_H

#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct {
  double limit;               /* seconds of one step; 0: no watch */
  const char *name;           /* of the model, for the message */
  bool prompt;                /* set before the watch begins: the steps are those of a prompt */
  int scheduling;             /* the system's account of our run time; -1: none */
  _Atomic double began;       /* clock at the start of the current step; 0: none */
  _Atomic double polled;      /* clock at the library's last poll */
  _Atomic bool evaluating;    /* the step is an evaluation, whose time is one stretch */
  _Atomic bool told;          /* a diagnostic has reported a limit */
  bool watching;              /* the thread runs */
  pthread_t thread;
  sem_t closed;               /* posted when the thread must end */
} cli_watch;

/* Limits the memory that the process may write to, to a tenth and some megabytes above the limit. Does nothing if the
 * system has no such limit. */
void cli_limits_memory(size_t limit);
/* Limits all the memory that the process and its children may ever write to. */
void cli_limits_memory_for_good(size_t most);
/* Prepares a watch; opens the files that it will need, before the process is confined. */
void cli_watch_open(cli_watch *w);
/* Starts to watch the steps. The thread reads w and its name until cli_watch_close. Returns false if no thread could be
 * started. */
bool cli_limits_watch(cli_watch *w);

/* Ends the thread; call it before w or its name is freed. Does nothing without a thread. */
void cli_watch_close(cli_watch *w);

/* Call these before and after each library call that has a time limit. */
void cli_watch_begin(cli_watch *w, bool evaluating);
void cli_watch_end(cli_watch *w);
/* Records a sign of life of the library: call it from vs_host.poll. */
void cli_watch_poll(cli_watch *w);

#endif
