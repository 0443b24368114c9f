/* Owns the layout of activations on the stack, which the run loop and control share, and the chain of the running
 * calls.
 *
 * In an activation, slot base[-2] is the procedure, base[-1] the return information, base[0...] arguments and
 * registers. The caller prepares a call in a window of its registers: procedure, a free slot, arguments. Therefore
 * window = callee's base - 2, and the result replaces the procedure. The return information is a fixnum: bits 0..26 are
 * the caller's pc, then flags, from bit 32 the window's distance from the caller's base.
 *
 * The working stretch begins with an activation. If it has the flag UNDER, its caller is the last activation in the
 * STACK object vm->under below slot vm->under_depth. Segments never change: a return copies one activation up. */
#ifndef VS_VM_MACHINE_ACTIVATION_H
#define VS_VM_MACHINE_ACTIVATION_H

#include "vm/machine/vs.h"

#define VS_RET_EACH    UINT64_C(0x08000000)   /* pc is that of a MORE, with its row below the window: the loop may take
                                               * the result there at once and enter the procedure again */
#define VS_RET_STOP    UINT64_C(0x10000000)   /* returns to vs_run's caller */
#define VS_RET_NATIVE  UINT64_C(0x20000000)   /* the caller is a native that is entered again */
#define VS_RET_GENERIC UINT64_C(0x40000000)   /* pc is that of an inlined instruction, which names the result's place */
#define VS_RET_UNDER   UINT64_C(0x80000000)
#define VS_RET_FLAGS   UINT64_C(0xF8000000)
enum { VS_ACTIVATION_SLACK = 300 };                /* slots above an activation's registers that may be written without
                                                    * a check */

/* Makes the return information. The distance has 16 bits and the pc 27. */
static inline vs_value vs_ret_make(size_t distance, size_t pc) {
  VS_ASSERT(distance <= 0xFFFF && pc <= 0x07FFFFFF);
  return VS_TAG_FIXNUM << 48 | (uint64_t)distance << 32 | (uint64_t)pc;
}
static inline size_t vs_ret_distance(vs_value ret) { return (size_t)(ret >> 32 & 0xFFFF); }
static inline size_t vs_ret_pc(vs_value ret) { return (size_t)(ret & 0x07FFFFFF); }

/* Moves all activations below the window w, which has n arguments, into the heap, and the window to the bottom of the
 * stretch, which then has room for `need` slots from w on. The window and its arguments are in the stretch. Returns the
 * window's new place; NULL when memory is out. */
vs_value *vs_activation_flush(vs_scheme *vm, vs_value *w, size_t n, size_t need);

/* Sets *out to the continuation of the window w, which has n arguments and its return information in slot 1. Moves the
 * window to the bottom of the stretch, and vm->base with it. Returns false when memory is out; the activations may then
 * be in the heap. */
bool vs_activation_capture(vs_scheme *vm, vs_value *w, size_t n, vs_value *out);

/* Returns the number of slots below the working stretch. */
static inline uint64_t vs_slots_below(const vs_scheme *vm) {
  const vs_stack *s = vs_is(vm->under, VS_T_STACK) ? vs_as_stack(vm->under) : NULL;
  return s ? s->total - s->count + vm->under_depth : 0;
}

/* Returns the level of the activation at base, which is in the working stretch: the number of all slots below it. */
static inline uint64_t vs_activation_level(const vs_scheme *vm, const vs_value *base) {
  VS_ASSERT(base >= vm->stack && base <= vm->stack_end);
  return vs_slots_below(vm) + (uint64_t)(base - vm->stack);
}

/* Sets *out to the chain of the running calls, innermost first, at most `max`: a list of (name . place) pairs. The name
 * is a symbol or #f, the place a fixnum vs_pos. (#t . 0) before a pair means calls between that ended with tail calls
 * and left no activations. For natives such as `error`; conditions of vs_fail have the chain already. */
bool vs_call_chain(vs_scheme *vm, size_t max, vs_value *out);
/* Sets *out to the innermost calls with their variables, for vs_condition.calls (activation.c describes the layout).
 * Returns false when memory is out. */
enum { VS_CALL_PROCEDURE, VS_CALL_PLACE, VS_CALL_VARIABLES, VS_CALL_WORDS = VS_CALL_VARIABLES + 2 * 64 };
bool vs_call_variables(vs_scheme *vm, vs_value *out);
/* Writes the chain without allocation, names and places apart; returns the number of its entries. */
size_t vs_call_links(vs_scheme *vm, vs_value *name, vs_pos *place, size_t max);
/* Writes only the places, without allocation; returns their number. */
size_t vs_call_places(vs_scheme *vm, vs_pos *place, size_t max);
/* Returns a hash of the places of those calls, faster than the places themselves. The same chain has the same hash
 * until vm->collections changes. */
uint64_t vs_call_key(vs_scheme *vm, size_t max);
/* Passes the activations, innermost first, to `see` until it returns false: the procedure, its slots, and the current
 * place of a closure, 0 for others. `see` must not allocate. */
typedef bool vs_see_activation_fn(void *to, vs_value procedure, const vs_value *base, vs_pos place);
void vs_see_activations(vs_scheme *vm, vs_see_activation_fn *see, void *to);
/* Returns the place of the call of the running native. */
vs_pos vs_call_place(vs_scheme *vm);

/* these functions, for errors (fail.h) */
extern const struct vs_traceback vs_call_traceback;

#endif
