/* Owns the running of programs: environments for them, files, texts, top-level forms one after the other.

   The natives %run, eval, load and the like are frames of the run loop, so that call/cc, errors and limits work through them; C
   code outside the run loop uses the functions here. */
#ifndef VS_UNIT_H
#define VS_UNIT_H

#include "vm/front/environment.h"
#include "vm/values/text.h"

/* The library environment with all natives and the syntax that is C (vm->at.core), unless a heap image brought it. The
   library's Scheme files are then loaded with vs_library_load, and at the end vs_library_done makes what they defined constant. */
bool vs_front_open(vs_scheme *vm);
bool vs_library_load(vs_scheme *vm, const char *name, const char *text, size_t size);
void vs_library_done(vs_scheme *vm);

/* A program: an environment that imports the whole library. vm->at.program is that of the host. */
bool vs_program_new(vs_scheme *vm, vs_value *env);

/* Runs a text or a file in vm->at.program; `line` is the number of its first line; prompt: it was typed at one, so its imports add (environment.h).
   *last: the value of the last form. Values of top-level expressions go to vm->config.value. False: vm->condition. */
bool vs_program_text(vs_scheme *vm, const char *name, uint32_t line, const char *text, size_t size, bool prompt, vs_value *last);
/* The same with names for values: each expression of the text, though no definition, sees the bindings, a list of
   (symbol . value), as local
   variables. That is how the prompt looks at a frame of a program that is stopped. */
bool vs_program_within(vs_scheme *vm, const char *name, uint32_t line, const char *text, size_t size,
    vs_value bindings, vs_value *last);
bool vs_program_file(vs_scheme *vm, const char *path, vs_value *last);

/* A source file that is part of the program: read when something imports it, never run before. The last has no name. */
typedef struct vs_shipped { const char *name /* "srfi/13.sld" */, *text, *end; } vs_shipped;
/* Does a path name such a file? They are looked for last, and called library:srfi/13.sld. */
bool vs_unit_is_shipped(const char *path);
/* name in vm->config.shipped, or NULL */
const vs_shipped *vs_unit_shipped(const vs_scheme *vm, const char *name);

/* The path of a file that the text `from` (a file number, 0: none) names. The places are the folder of `from`, the folder `up` levels above it, the
   folder of the file that the host runs, and the folders of vm->config.library_path; *found: it exists in one of them. Else *path is the first. */
bool vs_unit_find(vs_scheme *vm, vs_value name, uint32_t from, size_t up, vs_text *path, bool *found);
/* The same without a second folder, for those whose reading reports what is not found. */
bool vs_unit_path(vs_scheme *vm, vs_value name, uint32_t from, vs_text *path);
/* The name of file number `file` in *t; empty when there is none. */
bool vs_unit_file_name(vs_scheme *vm, uint32_t file, vs_text *t);
/* The forms of a file; fold: its letters are read as small ones (include-ci). */
bool vs_unit_read(vs_scheme *vm, const char *path, bool fold, vs_value *forms);

/* The other language that a file of this name is in (front_ends.def), in words; NULL: it is in this one. */
const char *vs_unit_language(const char *name);
/* What a procedure of that name is called in messages, at a place in its text: of a script's functions, without the colon. */
const char *vs_unit_said(vs_scheme *vm, const char *name, vs_pos place);

/* What to say of a name that is not defined, appended to t: " (did you mean make-box?)", "; unite is the name here: (unite a b ...)". Nothing if
   nothing comes to mind. */
bool vs_suggest(vs_scheme *vm, vs_value env, vs_value symbol, vs_text *t);
/* Remembers, for vs_suggest, the name among the local variables of env that looks most like the symbol, which is not defined there. */
bool vs_suggest_local(vs_scheme *vm, vs_value env, vs_value symbol);
/* ... the symbol itself: a let binds it, and nothing does where the let's values stand. */
bool vs_suggest_let_star(vs_scheme *vm, vs_value symbol);
/* "; (import (scheme write)) brings it" appended to t, where a built-in library has the name */
bool vs_library_advice(vs_scheme *vm, vs_value symbol, vs_text *t);
bool vs_is_foreign_word(vs_value symbol); /* of foreign.def */
/* "; make-box is the name here: (make-box ...)" appended to t, where the word is one of another program's. */
bool vs_foreign_advice(const char *word, vs_text *t);
/* the same for a keyword that the called procedure does not have */
bool vs_keyword_advice(const char *word, vs_text *t);

#endif
