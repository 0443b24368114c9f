/* Owns the choice of threads that handle signals: only the host's, because each thread that the library or the command
 * starts blocks them. A handler may use data of the host's thread, and so never runs beside that thread. */
#ifndef VS_MODEL_SIGNALS_H
#define VS_MODEL_SIGNALS_H

#include <pthread.h>
#include <signal.h>

/* Blocks the signals from outside, for this thread and those that it starts, until *was is restored. Does not block a
 * fault of the program itself: a sanitizer or debugger reports it in any thread. */
static inline void vs_signals_hold(sigset_t *was) {
  static const int faults[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGPROF };
  sigset_t outside;
  sigfillset(&outside);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) sigdelset(&outside, faults[i]);
  pthread_sigmask(SIG_BLOCK, &outside, was);
}

static inline void vs_signals_release(const sigset_t *was) { pthread_sigmask(SIG_SETMASK, was, NULL); }

/* Starts a thread as pthread_create does; it receives no signals. */
static inline int vs_thread_start(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *context) {
  sigset_t was;
  vs_signals_hold(&was);
  int problem = pthread_create(thread, how, run, context);
  vs_signals_release(&was);
  return problem;
}

#endif
