/* Counts a program's work, and compares it with the limits of steps and time.
 *
 * The run loop counts turns (calls and loop iterations) down from POLL_TURNS; at 0 it reads the clock and tests for an
 * interrupt of the host. Natives report their work in steps, of which 64 count as one turn. They move or fill large
 * memory in pieces. */
#include "vm/machine/poll.h"

#include <string.h>

#include "vm/machine/native.h"

enum { POLL_TURNS = 20000 };

static bool check_limits(vs_scheme *vm) {
  const vs_config *c = &vm->config;
  if (c->interrupted && c->interrupted(c->user)) return vs_fail(vm, vm->sym.interrupt, "interrupted");
  if (c->step_limit && vm->steps > c->step_limit)
    return vs_fail(vm, vm->sym.limit, "stopped after %llu steps, the limit", (unsigned long long)c->step_limit);
  if (c->time_limit > 0 && c->clock && c->clock(c->user) - vm->started > c->time_limit)
    return vs_fail(vm, vm->sym.limit, "stopped after %g seconds, the limit", c->time_limit);
  return true;
}

void vs_refuel(vs_scheme *vm) {
  uint64_t turns = vm->poll_turns ? vm->poll_turns : POLL_TURNS, limit = vm->config.step_limit;
  if (limit && vm->steps <= limit && limit - vm->steps < turns) turns = limit - vm->steps + 1;
  vm->fuel = (int64_t)turns;
  vm->steps += turns;
}

bool vs_poll_limits(vs_scheme *vm) {
  const vs_native *native = vm->native;
  vm->native = NULL;                          /* the error of a reached limit must not name a native */
  bool ok = check_limits(vm);
  vm->native = native;
  vs_refuel(vm);
  return ok;
}

bool vs_poll(vs_scheme *vm, uint64_t work) {
  work += vm->work;                           /* vm->work: earlier steps of natives; 64 steps count as a turn */
  vm->work = work & 63;
  vm->fuel -= (int64_t)(work >> 6);
  return vm->fuel > 0 || vs_poll_limits(vm);
}

enum { POLL_PIECE = 256 << 10 };        /* POLL_PIECE: bytes that are moved or filled between two polls. At 1 to 2 GB
                                         * per second, this takes 0.1 to 0.3 ms */

bool vs_poll_move(vs_scheme *vm, void *to, const void *from, size_t bytes) {
  char *t = to;
  const char *f = from;
  bool back = t > f && t < f + bytes;     /* back: whether the destination overlaps the end of the source, so that bytes
                                           * are moved from the end */
  for (size_t done = 0; done < bytes;) {
    size_t n = bytes - done < POLL_PIECE ? bytes - done : POLL_PIECE, at = back ? bytes - done - n : done;
    memmove(t + at, f + at, n);
    done += n;
    if (done < bytes && !vs_poll(vm, n / 8)) return false;
  }
  return true;
}

bool vs_poll_set(vs_scheme *vm, void *to, int byte, size_t bytes) {
  for (size_t done = 0; done < bytes;) {
    size_t n = bytes - done < POLL_PIECE ? bytes - done : POLL_PIECE;
    memset((char *)to + done, byte, n);
    done += n;
    if (done < bytes && !vs_poll(vm, n / 8)) return false;
  }
  return true;
}
