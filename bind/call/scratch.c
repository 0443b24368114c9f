/* Allocates memory for checked calls, which is freed when the call ends. */
#include "bind/call/scratch.h"

#include <string.h>

#include "bind/call/call.h"
#include "vm/machine/fail.h"
#include "vm/values/gc.h"

struct vs_scratch {
  struct vs_scratch *next;
  size_t bytes;
  vs_node *node;
  max_align_t data[];
};

static struct vs_scratch *scratch_new(vs_args *f, size_t bytes) {
  struct vs_scratch *s = vs_mem(f->vm, NULL, 0, sizeof *s + bytes);
  if (!s) return (void)vs_fail_memory(f->vm), NULL;
  *s = (struct vs_scratch){ .next = f->scratch, .bytes = sizeof *s + bytes };
  return f->scratch = s;
}

void *vs_bind_scratch(vs_args *f, size_t bytes) {
  struct vs_scratch *s = scratch_new(f, bytes);
  return s ? (void *)s->data : NULL;
}

bool vs_bind_keep(vs_args *f, vs_node *node) {
  if (!node) return vs_fail_memory(f->vm);
  struct vs_scratch *s = scratch_new(f, 0);
  if (!s) return vs_node_release(node), false;
  s->node = node;
  return true;
}

void vs_bind_scratch_free(vs_args *f) {
  while (f->scratch) {
    struct vs_scratch *s = f->scratch;
    f->scratch = s->next;
    vs_node_release(s->node);
    vs_mem(f->vm, s, s->bytes, 0);
  }
}

void *vs_bind_grow(vs_args *f, vs_growing *g) {
  if (g->count == g->room) {
    size_t room = g->room ? g->room * 2 : 8;
    struct vs_scratch *last = f->scratch;
    if (g->at && last && (void *)last->data == g->at) {
      size_t bytes = sizeof *last + room * g->size;
      last = vs_mem(f->vm, last, last->bytes, bytes);
      if (!last) return (void)vs_fail_memory(f->vm), NULL;
      last->bytes = bytes;
      f->scratch = last;
      g->at = last->data, g->room = room;
      return (char *)g->at + g->size * g->count++;
    }
    void *at = vs_bind_scratch(f, room * g->size);
    if (!at) return NULL;
    if (g->count) memcpy(at, g->at, g->count * g->size);
    g->at = at, g->room = room;
  }
  return (char *)g->at + g->size * g->count++;
}
