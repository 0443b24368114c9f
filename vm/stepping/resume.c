/* Continues stopped programs (vm/stepping/step.h). */
#include "vm/stepping/resume.h"

#include "vm/front/environment.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

bool vs_step_resume(vs_scheme *vm, vs_value stop, vs_step_mode mode, vs_value *out) {
  vs_stepping *s = &vm->step;
  VS_ROOTS(vm, r, 2);
  const vs_vector *v = vs_as_vector(vs_as_condition(stop)->payload);
  VS_ASSERT(vs_is_stop(vm, stop));
  r[0] = v->at[VS_STOP_CONTINUATION];
  uint64_t level = (uint64_t)vs_fixnum(v->at[VS_STOP_LEVEL]);
  vs_stop_kind kind = (vs_stop_kind)vs_fixnum(v->at[VS_STOP_KIND]);
  const uint64_t any = UINT64_MAX >> 18;
  switch (mode) {
    case VS_STEP_SAME:
      mode = (vs_step_mode)vs_fixnum(v->at[VS_STOP_MODE]);
      s->target = (uint64_t)vs_fixnum(v->at[VS_STOP_TARGET]);
      break;
    case VS_STEP_CONTINUE: case VS_STEP_ENTER: s->target = any; break;
    case VS_STEP_OVER: s->target = v->at[VS_STOP_TAIL] == VS_TRUE ? level - 1 : level; break;
    case VS_STEP_OUT: s->target = level - 1; break;
  }
  s->mode = (uint8_t)mode;
  s->told = kind == VS_STOP_CALL ? VS_TOLD_CALL : kind == VS_STOP_VALUE ? VS_TOLD_VALUE : VS_TOLD_NOTHING;
  s->seen_level = level, s->seen_code = NULL, s->seen_at = 0;
  if (!vs_intern_c(vm, "%resume", &r[1])) return false;
  return vs_run(vm, vs_environment_value(vm->at.core, r[1]), 1, r, out);
}
