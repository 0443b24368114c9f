/* Owns the limits that the process itself holds, below those of the library: see limits.c. */
#ifndef VS_CLI_LIMITS_H
#define VS_CLI_LIMITS_H

#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct {
  double limit;               /* seconds of one step; 0: nobody watches */
  const char *name;           /* of the model, for the message */
  bool prompt;                /* set before the watch begins: the steps are those of a prompt */
  int scheduling;             /* the system's account of when we ran; -1: none */
  _Atomic double began;       /* clock when the step under way began; 0: none is */
  _Atomic double polled;      /* clock when the library last asked whether to go on */
  _Atomic bool evaluating;    /* the step is an evaluation, whose time is one stretch */
  _Atomic bool told;          /* a diagnostic has said that a limit was reached */
  bool watching;              /* the thread runs */
  pthread_t thread;
  sem_t closed;               /* posted when the thread has to end */
} cli_watch;

/* Bounds the memory that the process may write to at a tenth and some megabytes above the limit. Does nothing where the
 * system has no such bound. */
void cli_limits_memory(size_t limit);
/* Bounds all the memory that the process and its children may ever write to. */
void cli_limits_memory_for_good(size_t most);
/* Makes a watch that watches nothing yet; opens what it will need when the process is confined. */
void cli_watch_open(cli_watch *w);
/* Begins to watch the steps. The thread reads w and its name until cli_watch_close. False: no thread could be
 * started. */
bool cli_limits_watch(cli_watch *w);

/* Ends the thread; before w or its name goes. Does nothing where no thread was started. */
void cli_watch_close(cli_watch *w);

/* Round every call of the library that a limit of time holds for. */
void cli_watch_begin(cli_watch *w, bool evaluating);
void cli_watch_end(cli_watch *w);
/* The library is alive: to be called from vs_host.poll. */
void cli_watch_poll(cli_watch *w);

#endif
