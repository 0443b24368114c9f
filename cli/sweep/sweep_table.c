/* Implements the memory, the table and the hashes of a sweep. */
#include "cli/sweep/sweep_table.h"

#include <math.h>
#include <string.h>

#include "model/store/array.h"

enum { BLOCK = 1 << 16 };

struct sweep_block {
  sweep_block *before;
  size_t used, room;
  max_align_t at[];
};

bool sweep_no_memory(void) { return fputs("vs: out of memory\n", stderr), false; }

void *sweep_keep(sweep_memory *m, size_t count, size_t size) {
  if (count > (SIZE_MAX >> 2) / size) return sweep_no_memory(), NULL;
  size_t unit = sizeof(max_align_t), units = (count * size + unit - 1) / unit;
  if (!m->last || m->last->room - m->last->used < units) {
    size_t room = units > BLOCK / unit ? units : BLOCK / unit;
    sweep_block *b = vs_fresh(sizeof *b + room * unit, 1);
    if (!b) return sweep_no_memory(), NULL;
    *b = (sweep_block){.before = m->last, .room = room};
    m->last = b;
  }
  void *out = m->last->at + m->last->used;
  m->last->used += units;
  return out;
}

char *sweep_keep_text(sweep_memory *m, const char *text, size_t length) {
  char *out = sweep_keep(m, length + 1, 1);
  if (out) memcpy(out, text, length), out[length] = 0;
  return out;
}

void sweep_memory_free(sweep_memory *m) {
  for (sweep_block *b = m->last, *before; b; b = before) before = b->before, free(b);
  m->last = NULL;
}

size_t sweep_number_column(sweep_table *t, const char *name, size_t length) {
  for (size_t i = 0; i < t->number_count; i++)
    if (strlen(t->numbers[i]) == length && !memcmp(t->numbers[i], name, length)) return i;
  const char *kept = sweep_keep_text(t->memory, name, length);
  if (!kept) return SIZE_MAX;
  if (!VS_GROW(t->numbers, t->number_room, t->number_count + 1)) return sweep_no_memory(), SIZE_MAX;
  t->numbers[t->number_count] = kept;
  return t->number_count++;
}

const char *sweep_value(const sweep_part *p, const char *name) {
  for (size_t i = 0; i < p->set.count; i++)
    if (!strcmp(p->set.at[i].name, name)) return p->set.at[i].value;
  return NULL;
}

double sweep_number_of(const sweep_part *p, size_t column) {
  for (size_t i = 0; i < p->number_count; i++)
    if (p->numbers[i].column == column) return p->numbers[i].value;
  return NAN;
}
