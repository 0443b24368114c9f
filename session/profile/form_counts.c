/* Gives the host the counts of how often each form of a program has run. */
#include "vm/compiler/coverage.h"

#include "session/host.h"
#include "session/report.h"

bool vs_coverage(vs_scheme *vm, bool on) {
  if (on) return vs_cover_begin(vm, vs_session_of(vm)->bind.library_files);
  vs_cover_end(vm);
  return true;
}

bool vs_coverage_get(vs_scheme *vm, size_t index, vs_coverage_info *out) {
  if (!vm->coverage || index >= vm->coverage->count) return false;
  const vs_covered *f = &vm->coverage->forms[index];
  *out = (vs_coverage_info){ .count = f->count };
  vs_session_span(vs_session_of(vm), f->pos, &out->at);
  return true;
}
