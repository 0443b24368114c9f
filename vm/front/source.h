/* Owns source files: the path that a name stands for, the language a file is in, and the reading of its forms. */
#ifndef VS_VM_FRONT_SOURCE_H
#define VS_VM_FRONT_SOURCE_H

#include "vm/values/text.h"

typedef struct vs_passage vs_passage;

/* A source file that is part of the program: read when something imports it, never run before. The last has no name. */
typedef struct vs_shipped { const char *name /* "srfi/13.sld" */, *text, *end; } vs_shipped;
/* Does a path name such a file? They are looked for last, and called library:srfi/13.sld. */
bool vs_source_is_shipped(const char *path);
/* name in vm->config.shipped, or NULL */
const vs_shipped *vs_source_shipped(const vs_scheme *vm, const char *name);

/* The path of a file that the text `from` (a file number, 0: none) names. The places are the folder of `from`, the
   folder `up` levels above it, the folder of the file that the host runs, and the folders of vm->config.library_path;
   *found: it exists in one of them. Else *path is the first. */
bool vs_source_find(vs_scheme *vm, vs_value name, uint32_t from, size_t up, vs_text *path, bool *found);
/* The same without a second folder, for those whose reading reports what is not found. */
bool vs_source_path(vs_scheme *vm, vs_value name, uint32_t from, vs_text *path);
/* The name of file number `file` in *t; empty when there is none. */
bool vs_source_name(vs_scheme *vm, uint32_t file, vs_text *t);
/* The forms of a file; fold: its letters are read as small ones (include-ci). */
bool vs_source_read(vs_scheme *vm, const char *path, bool fold, vs_value *forms);

/* The forms of a file that text in the file `from` includes. *circle: it is included by itself, maybe by way of others;
   nothing was read then, false is returned and no failure is set. */
bool vs_source_include(vs_scheme *vm, vs_value name, uint32_t from, bool fold, vs_value *forms, bool *circle);

/* The other language that a file of this name is in (front_ends.def), in words; NULL: it is in this one. */
const char *vs_source_language(const char *name);
/* Returns the name that messages call a procedure by, at a place in its text: that of a script's function is without
   its colon. */
const char *vs_source_said(vs_scheme *vm, const char *name, vs_pos place);

/* The forms of a text (reader.h) that a file of this name holds. */
bool vs_source_text(vs_scheme *vm, const char *name, const vs_passage *text, bool fold, vs_value *forms);

#endif
