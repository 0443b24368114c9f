/* Owns the running of programs: their environments, files, texts, top-level forms in order.
 *
 * The natives %run, eval, load and the like are activations of the run loop, so call/cc, errors and limits work through
 * them. C code outside the run loop uses the functions here. */
#ifndef VS_VM_MACHINE_PROGRAM_H
#define VS_VM_MACHINE_PROGRAM_H

#include "vm/front/environment.h"
#include "vm/front/reader.h"
#include "vm/values/text.h"

/* Makes the library environment with all natives and the syntax in C (vm->at.core), unless a heap image contains it.
 * vs_library_load then loads the library's Scheme files, and at the end vs_library_done makes their definitions
 * constant. */
bool vs_front_open(vs_scheme *vm);
bool vs_library_load(vs_scheme *vm, const char *name, const char *text, size_t size);
void vs_library_done(vs_scheme *vm);

/* Makes a program's environment, which imports the whole library. vm->at.program is the host's. */
bool vs_program_new(vs_scheme *vm, vs_value *env);

/* Runs a text in vm->at.program. prompt: it was typed at a prompt, so its imports add (environment.h). last: the
 * value of the last form. Passes values of top-level expressions to vm->config.value. Returns false with
 * vm->condition set. */
bool vs_program_text(vs_scheme *vm, const char *name, const vs_passage *text, bool prompt, vs_value *last);
/* Does the same with names for values: each expression of the text, but no definition, sees the bindings, a list of
 * (symbol . value), as local variables. The prompt examines an activation of a stopped program in this way. */
bool vs_program_within(vs_scheme *vm, const char *name, const vs_passage *text, vs_value bindings, vs_value *last);

#endif
