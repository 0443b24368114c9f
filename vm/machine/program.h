/* Declares the running of programs: their environments, files and texts.
 *
 * The natives %run, eval, load and similar have activations of the run loop, so that call/cc, errors and limits work in
 * them. C code outside the run loop uses the functions below. */
#ifndef VS_VM_MACHINE_PROGRAM_H
#define VS_VM_MACHINE_PROGRAM_H

#include "vm/front/environment.h"
#include "vm/front/reader.h"
#include "vm/values/text.h"

/* Creates the environment of the library with all natives and the syntax in C (vm->at.core), unless a heap image
 * contains it. */
bool vs_front_open(vs_scheme *vm);
/* Runs a Scheme file of the library, after vs_front_open. */
bool vs_library_load(vs_scheme *vm, const char *name, const char *text, size_t size);
/* Makes the definitions of the library constant, after its last file was loaded. */
void vs_library_done(vs_scheme *vm);

/* Creates the environment of a program, which imports the complete library. vm->at.program is the environment of the
 * program that the host runs. */
bool vs_program_new(vs_scheme *vm, vs_value *env);

/* Runs a text in vm->at.program. prompt: the text was typed at a prompt, so that its imports are added to earlier
 * imports (environment.h). Sets *last to the value of the last form. Passes values of top-level expressions to
 * vm->config.value. Returns false with vm->condition set. */
bool vs_program_text(vs_scheme *vm, const char *name, const vs_passage *text, bool prompt, vs_value *last);
/* Runs a text as vs_program_text does, while a program is stopped. Expressions in the text see `bindings`, a list of
 * (symbol . value), as local variables; definitions in the text do not. */
bool vs_program_within(vs_scheme *vm, const char *name, const vs_passage *text, vs_value bindings, vs_value *last);

#endif
