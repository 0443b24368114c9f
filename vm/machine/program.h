/* Owns the running of programs: environments for them, files, texts, top-level forms one after the other.

   The natives %run, eval, load and the like are activations of the run loop, so that call/cc, errors and limits work
   through them; C code outside the run loop uses the functions here. */
#ifndef VS_VM_MACHINE_PROGRAM_H
#define VS_VM_MACHINE_PROGRAM_H

#include "vm/front/environment.h"
#include "vm/front/reader.h"
#include "vm/values/text.h"

/* The library environment with all natives and the syntax that is C (vm->at.core), unless a heap image brought it. The
   library's Scheme files are then loaded with vs_library_load, and at the end vs_library_done makes what they defined
   constant. */
bool vs_front_open(vs_scheme *vm);
bool vs_library_load(vs_scheme *vm, const char *name, const char *text, size_t size);
void vs_library_done(vs_scheme *vm);

/* A program: an environment that imports the whole library. vm->at.program is that of the host. */
bool vs_program_new(vs_scheme *vm, vs_value *env);

/* Runs a text in vm->at.program; prompt: it was typed at one, so its
   imports add (environment.h).
   *last: the value of the last form. Values of top-level expressions go to vm->config.value. False: vm->condition. */
bool vs_program_text(vs_scheme *vm, const char *name, const vs_passage *text, bool prompt, vs_value *last);
/* The same with names for values: each expression of the text, though no definition, sees the bindings, a list of
   (symbol . value), as local
   variables. In this way the prompt looks at an activation of a program that is stopped. */
bool vs_program_within(vs_scheme *vm, const char *name, const vs_passage *text, vs_value bindings, vs_value *last);

#endif
