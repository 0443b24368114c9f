/* Counts how often each form of a program runs. */
#include "vm/compiler/coverage.h"

bool vs_cover_begin(vs_scheme *vm, uint32_t first_file) {
  if (!vm->coverage) {
    vm->coverage = vs_mem(vm, NULL, 0, sizeof *vm->coverage);
    if (!vm->coverage) return false;
    *vm->coverage = (vs_cover_table){ .first_file = first_file };
  }
  return vm->coverage->on = true;
}

void vs_cover_end(vs_scheme *vm) {
  if (vm->coverage) vm->coverage->on = false; /* compiled code still refers to its forms */
}

void vs_cover_close(vs_scheme *vm) {
  vs_cover_table *c = vm->coverage;
  if (!c) return;
  if (c->forms) vs_mem(vm, c->forms, c->room * sizeof *c->forms, 0);
  vs_mem(vm, c, sizeof *c, 0);
  vm->coverage = NULL;
}

bool vs_covers(const vs_scheme *vm, vs_pos pos) {
  const vs_cover_table *c = vm->coverage;
  return c && c->on && vs_pos_line(pos) && vs_pos_file(pos) >= c->first_file;
}

bool vs_cover_form(vs_scheme *vm, vs_pos pos, uint32_t *index) {
  vs_cover_table *c = vm->coverage;
  if (c->count == c->room) {
    size_t room = c->room ? 2 * c->room : 256;
    vs_covered *more = vs_mem(vm, c->forms, c->room * sizeof *more, room * sizeof *more);
    if (!more) return false;
    c->forms = more, c->room = room;
  }
  c->forms[c->count] = (vs_covered){ .pos = pos };
  *index = (uint32_t)c->count++;
  return true;
}
