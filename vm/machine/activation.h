/* Owns the layout of activations on the stack, shared by the run loop and control, and the chain of the calls now
   active.

   An activation: slot base[-2] is the procedure, base[-1] how to return, base[0...] arguments and registers. A call is
   prepared in a window of the caller's registers: procedure, a free slot, arguments; so window = callee's base - 2 and
   the result replaces the procedure. How to return is a fixnum: bits 0..26 the caller's pc, flags, from bit 32 the
   window's distance from the caller's base.

   The working stretch begins with an activation whose caller, if it has the flag UNDER, is the last activation in the
   STACK object vm->under below slot vm->under_depth. Segments are never changed: returning copies one activation up. */
#ifndef VS_VM_MACHINE_ACTIVATION_H
#define VS_VM_MACHINE_ACTIVATION_H

#include "vm/machine/vs.h"

#define VS_RET_EACH    UINT64_C(0x08000000)   /* pc is that of a MORE, whose row lies below the window: the result may
                                                 be taken there at once, and the procedure entered again */
#define VS_RET_STOP    UINT64_C(0x10000000)   /* returns to vs_run's caller */
#define VS_RET_NATIVE  UINT64_C(0x20000000)   /* the caller is a native that is entered again */
#define VS_RET_GENERIC UINT64_C(0x40000000)   /* pc is that of an inlined instruction: the result goes where its
                                                 operands say */
#define VS_RET_UNDER   UINT64_C(0x80000000)
#define VS_RET_FLAGS   UINT64_C(0xF8000000)
enum { VS_ACTIVATION_SLACK = 300 };                /* slots above an activation's registers that may be written without
                                                      asking */

/* The distance has 16 bits and the pc 27. */
static inline vs_value vs_ret_make(size_t distance, size_t pc) {
  VS_ASSERT(distance <= 0xFFFF && pc <= 0x07FFFFFF);
  return VS_TAG_FIXNUM << 48 | (uint64_t)distance << 32 | (uint64_t)pc;
}
static inline size_t vs_ret_distance(vs_value ret) { return (size_t)(ret >> 32 & 0xFFFF); }
static inline size_t vs_ret_pc(vs_value ret) { return (size_t)(ret & 0x07FFFFFF); }

/* Moves everything below the window w, which has n arguments, into the heap, and the window to the bottom of the
   stretch, which then has room for `need` slots from w on. The window's new place, NULL when memory is out. The window
   and its arguments lie in the stretch. */
vs_value *vs_activation_flush(vs_scheme *vm, vs_value *w, size_t n, size_t need);

/* Makes *out the continuation of the window w, which has n arguments and whose slot 1 says how to return. The window
 * moves to the bottom of the stretch, and vm->base with it. False when memory is out; the activations may lie in the
 * heap then. */
bool vs_activation_capture(vs_scheme *vm, vs_value *w, size_t n, vs_value *out);

/* How many slots lie below the working stretch. */
static inline uint64_t vs_slots_below(const vs_scheme *vm) {
  const vs_stack *s = vs_is(vm->under, VS_T_STACK) ? vs_as_stack(vm->under) : NULL;
  return s ? s->total - s->count + vm->under_depth : 0;
}

/* The level of the activation at base, an activation of the working stretch: how many slots lie below it in all. */
static inline uint64_t vs_activation_level(const vs_scheme *vm, const vs_value *base) {
  VS_ASSERT(base >= vm->stack && base <= vm->stack_end);
  return vs_slots_below(vm) + (uint64_t)(base - vm->stack);
}

/* The chain of calls now active, innermost first, at most `max`: list of (name . place) pairs; name symbol or #f, place
   a fixnum vs_pos; (#t . 0) before one stands for calls in between that ended with tail calls and left no activations.
   For natives such as `error`; conditions made by vs_fail have it already. */
bool vs_call_chain(vs_scheme *vm, size_t max, vs_value *out);
/* The innermost calls with their variables, for vs_condition.calls (activation.c says how they lie). False: out of
 * memory. */
enum { VS_CALL_PROCEDURE, VS_CALL_PLACE, VS_CALL_VARIABLES, VS_CALL_WORDS = VS_CALL_VARIABLES + 2 * 64 };
bool vs_call_variables(vs_scheme *vm, vs_value *out);
/* The chain without allocating, names and places apart: how many were written. */
size_t vs_call_links(vs_scheme *vm, vs_value *name, vs_pos *place, size_t max);
/* The places alone, without allocating: how many were written. */
size_t vs_call_places(vs_scheme *vm, vs_pos *place, size_t max);
/* A hash of where those calls are, for less than the places cost; the same chain has the same until vm->collections
   changes. */
uint64_t vs_call_key(vs_scheme *vm, size_t max);
/* Shows the activations, innermost first, to `see` until it returns false: the procedure, its slots, and the place that
   a closure is at, 0 for others. `see` allocates nothing. */
typedef bool vs_see_activation_fn(void *to, vs_value procedure, const vs_value *base, vs_pos place);
void vs_see_activations(vs_scheme *vm, vs_see_activation_fn *see, void *to);
/* Place of the call that the running native was made from. */
vs_pos vs_call_place(vs_scheme *vm);

/* These functions, for errors (fail.h). */
extern const struct vs_traceback vs_call_traceback;

#endif
