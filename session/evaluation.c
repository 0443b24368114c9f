/* Begins and ends an evaluation. The limits of time, steps and output are counted from its beginning. Its outcome is
 * computed at its end. */
#include "session/evaluation.h"

#include <string.h>

#include "bind/state.h"
#include "model/store/cache.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/profile/call_profile.h"
#include "session/report.h"
#include "session/stops.h"
#include "vm/machine/vs.h"
#include "vm/stepping/step.h"

void vs_session_begin(vs_session *s, unsigned flags) {
  s->flags = flags;
  vs_cache_turn(vs_store_cache(s->bind.store), true);
  vs_scheme *vm = s->bind.vm;
  vs_tally_enter(&s->tally, VS_WORK_RUN);
  vm->steps = vm->written = 0;
  vm->started = vs_session_clock(s);
  s->bind.bad_parameter = s->bind.handing = false;
  s->phase = "evaluating", s->told_progress = vm->started;
  vs_session_arm(s, flags);
  vs_session_resume_profile(s);
}

bool vs_session_is_exit(vs_value condition) {
  if (!vs_is(condition, VS_T_CONDITION)) return false;
  const vs_condition *c = vs_as_condition(condition);
  return vs_is_symbol(c->kind) && !strcmp(vs_as_symbol(c->kind)->name, "exit") && vs_is_fixnum(c->payload);
}

vs_outcome vs_session_finish(vs_session *s, bool ok, bool usage) {
  vs_scheme *vm = s->bind.vm;
  ok = vs_session_pass(s, ok);
  vm->step.mode = VS_STEP_CONTINUE, vm->step.stops = false; /* calls after the evaluation, such as those of drawing
                                                             * functions, do not stop for a debugger */
  vs_session_release_objects(s);
  s->phase = NULL;
  vs_tally_enter(&s->tally, VS_WORK_NONE);
  s->evaluate_seconds += vs_session_clock(s) - vm->started;
  if (!ok && vs_session_is_exit(vm->condition)) {
    s->exit_requested = ok = true;
    s->exit_code = (int)vs_fixnum(vs_as_condition(vm->condition)->payload);
  }
  if (!ok && vs_is_stop(vm, vm->condition)) return vs_session_stopped(s);
  if (ok) vs_bind_finish(&s->bind); /* warns about objects that the program does not use */
  /* If the program has stopped, reports the calls that led to the stop, not those of an earlier error. */
  if (ok && vs_is_pair(vm->at.stops)) vm->condition = vs_car(vm->at.stops);
  if (ok) return VS_OUTCOME_DONE;
  vs_outcome outcome = vs_session_report_condition(s, vm->condition, usage);
  if (outcome == VS_OUTCOME_MACHINE) {
    vm->condition = vm->value = VS_FALSE;
    vs_gc_major(vm); /* frees the values that filled the memory, so that the interpreter can continue after running out
                      * of memory */
  }
  return outcome;
}
