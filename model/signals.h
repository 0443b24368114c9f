/* Owns which threads handle signals: those of the host alone, because each thread that the library or the command
 * starts holds them back. A handler, which may use what the host's thread owns, then never runs beside that thread. */
#ifndef VS_MODEL_SIGNALS_H
#define VS_MODEL_SIGNALS_H

#include <pthread.h>
#include <signal.h>

/* Holds back the signals that come from outside, for this thread and those that it starts, until *was is given back. A
 * fault of the program itself is not held back: a sanitizer or debugger reports it in any thread. */
static inline void vs_signals_hold(sigset_t *was) {
  static const int faults[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGPROF };
  sigset_t outside;
  sigfillset(&outside);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) sigdelset(&outside, faults[i]);
  pthread_sigmask(SIG_BLOCK, &outside, was);
}

static inline void vs_signals_release(const sigset_t *was) { pthread_sigmask(SIG_SETMASK, was, NULL); }

/* Starts a thread as pthread_create does; signals do not reach it. */
static inline int vs_thread_start(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *context) {
  sigset_t was;
  vs_signals_hold(&was);
  int problem = pthread_create(thread, how, run, context);
  vs_signals_release(&was);
  return problem;
}

#endif
