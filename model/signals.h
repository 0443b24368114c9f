/* Blocks signals in all threads that the library or the command starts, so that only the host's threads handle them. A
 * handler therefore never runs in parallel with the host's thread, and may use its data. */
#ifndef VS_MODEL_SIGNALS_H
#define VS_MODEL_SIGNALS_H

#include <pthread.h>
#include <signal.h>

/* Blocks the signals that come from other processes, for this thread and for threads that it starts later. *was:
 * receives the previous mask, for vs_signals_release. Signals for faults of the program itself are not blocked, so that
 * a sanitizer or debugger reports the fault. */
static inline void vs_signals_hold(sigset_t *was) {
  static const int faults[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGPROF };
  sigset_t outside;
  sigfillset(&outside);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) sigdelset(&outside, faults[i]);
  pthread_sigmask(SIG_BLOCK, &outside, was);
}

static inline void vs_signals_release(const sigset_t *was) { pthread_sigmask(SIG_SETMASK, was, NULL); }

/* Starts a thread as pthread_create does. Signals from other processes are blocked in the new thread. */
static inline int vs_thread_start(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *context) {
  sigset_t was;
  vs_signals_hold(&was);
  int problem = pthread_create(thread, how, run, context);
  vs_signals_release(&was);
  return problem;
}

#endif
