/* Declares the layout of activations (frames of running calls) on the stack, and the chain of running calls. The run
 * loop and the control procedures share this layout.
 *
 * In an activation, slot base[-2] is the procedure, base[-1] the return information, base[0...] arguments and
 * registers. The caller prepares a call in a window, consecutive registers of its own: procedure, a free slot,
 * arguments. The window is therefore at the callee's base - 2, and the result replaces the procedure. The return
 * information is a fixnum: bits 0..26 are the caller's pc, then flags, from bit 32 the distance of the window from the
 * caller's base.
 *
 * The working part of the stack begins with an activation. If this activation has the flag UNDER, its caller is the
 * last activation in the STACK object vm->under below slot vm->under_depth. STACK objects never change: a return copies
 * one activation to the working part. */
#ifndef VS_VM_MACHINE_ACTIVATION_H
#define VS_VM_MACHINE_ACTIVATION_H

#include "vm/machine/vs.h"

#define VS_RET_EACH    UINT64_C(0x08000000)   /* control returns to an instruction MORE, which calls a procedure with
                                               * each element of a list (compiler/each.h) */
#define VS_RET_STOP    UINT64_C(0x10000000)   /* the call returns to the caller of vs_run */
#define VS_RET_NATIVE  UINT64_C(0x20000000)   /* the caller is a native, which is entered again */
#define VS_RET_GENERIC UINT64_C(0x40000000)   /* control returns to an instruction that replaced a call of a native;
                                               * this instruction contains the number of the result's register */
#define VS_RET_UNDER   UINT64_C(0x80000000)
#define VS_RET_FLAGS   UINT64_C(0xF8000000)
enum { VS_ACTIVATION_SLACK = 300 };                /* number of slots above an activation's registers that may be
                                                    * written without a check */

/* Returns the return information of a call. distance: number of slots from the caller's base to the registers of the
 * call, 16 bits; pc: 27 bits. */
static inline vs_value vs_ret_make(size_t distance, size_t pc) {
  VS_ASSERT(distance <= 0xFFFF && pc <= 0x07FFFFFF);
  return VS_TAG_FIXNUM << 48 | (uint64_t)distance << 32 | (uint64_t)pc;
}
static inline size_t vs_ret_distance(vs_value ret) { return (size_t)(ret >> 32 & 0xFFFF); }
static inline size_t vs_ret_pc(vs_value ret) { return (size_t)(ret & 0x07FFFFFF); }

/* Moves all activations below the window w (the registers of a call with n arguments) into the heap. Moves w to the
 * start of the stack's working part, which then has room for `need` slots, beginning with w. Returns the new address of
 * w, or NULL when memory is out. */
vs_value *vs_activation_flush(vs_scheme *vm, vs_value *w, size_t n, size_t need);

/* Sets *out to the continuation of the call in the window w (the registers of a call), which has n arguments. Moves the
 * window to the start of the stack's working part, and vm->base with it. Returns false when memory is out. */
bool vs_activation_capture(vs_scheme *vm, vs_value *w, size_t n, vs_value *out);

/* Returns the number of stack slots below the working part, which are all in the heap. */
static inline uint64_t vs_slots_below(const vs_scheme *vm) {
  const vs_stack *s = vs_is(vm->under, VS_T_STACK) ? vs_as_stack(vm->under) : NULL;
  return s ? s->total - s->count + vm->under_depth : 0;
}

/* Returns the level of the activation at base in the stack's working part: the number of stack slots below it,
 * including those in the heap. */
static inline uint64_t vs_activation_level(const vs_scheme *vm, const vs_value *base) {
  VS_ASSERT(base >= vm->stack && base <= vm->stack_end);
  return vs_slots_below(vm) + (uint64_t)(base - vm->stack);
}

/* Sets *out to the chain of the running calls, innermost first, at most `max`: a list of (name . place) pairs. (#t . 0)
 * before a pair means that calls between two others ended with tail calls. */
bool vs_call_chain(vs_scheme *vm, size_t max, vs_value *out);
/* Sets *out to the innermost calls with their variables, for vs_condition.calls (layout: activation.c). Returns false
 * when memory is out. */
enum { VS_CALL_PROCEDURE, VS_CALL_PLACE, VS_CALL_VARIABLES, VS_CALL_WORDS = VS_CALL_VARIABLES + 2 * 64 };
bool vs_call_variables(vs_scheme *vm, vs_value *out);
/* Writes names and places of at most `max` running calls to the two arrays, innermost first, without allocation.
 * Returns their number. */
size_t vs_call_links(vs_scheme *vm, vs_value *name, vs_pos *place, size_t max);
/* Writes the places of at most `max` running calls to `place`, innermost first, without allocation. Returns their
 * number. */
size_t vs_call_places(vs_scheme *vm, vs_pos *place, size_t max);
/* Returns a hash of the places of at most `max` running calls; faster than vs_call_places. Equal chains of calls have
 * equal hashes until vm->collections, the number of garbage collections, changes. */
uint64_t vs_call_key(vs_scheme *vm, size_t max);
/* Function that receives one activation: the procedure, its slots, and the current place of a closure (0 for other
 * procedures). It must not allocate. Returns false to end the walk, which goes from the innermost activation
 * outwards. */
typedef bool vs_see_activation_fn(void *to, vs_value procedure, const vs_value *base, vs_pos place);
void vs_see_activations(vs_scheme *vm, vs_see_activation_fn *see, void *to);
/* Returns the place in the source at which the running native was called. */
vs_pos vs_call_place(vs_scheme *vm);

/* functions of activation.c that describe the running calls for errors (fail.h) */
extern const struct vs_traceback vs_call_traceback;

#endif
