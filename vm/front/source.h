/* Owns source files: the path of a name, the language of a file, and the reading of its forms. */
#ifndef VS_VM_FRONT_SOURCE_H
#define VS_VM_FRONT_SOURCE_H

#include "vm/values/text.h"

typedef struct vs_passage vs_passage;

/* A source file inside the program: read only when it is imported. The last one has no name. */
typedef struct vs_shipped { const char *name /* "srfi/13.sld" */, *text, *end; } vs_shipped;
/* Returns true if a path means such a file. They are searched last, and have names like library:srfi/13.sld. */
bool vs_source_is_shipped(const char *path);
/* Returns the file of this name in vm->config.shipped, or NULL. */
const vs_shipped *vs_source_shipped(const vs_scheme *vm, const char *name);

/* Finds the path of a file that the text `from` (a file number, 0: none) names. Searches the folder of `from`, the
 * folder `up` levels above it, the folder of the file that the host runs, and the folders of vm->config.library_path;
 * found: one has it. Else *path is in the first. */
bool vs_source_find(vs_scheme *vm, vs_value name, uint32_t from, size_t up, vs_text *path, bool *found);
/* Does the same without the second folder, for callers whose reading reports a missing file. */
bool vs_source_path(vs_scheme *vm, vs_value name, uint32_t from, vs_text *path);
/* Writes the name of file number `file` into *t; leaves it empty if there is none. */
bool vs_source_name(vs_scheme *vm, uint32_t file, vs_text *t);
/* Reads the forms of a file; fold: letters as lower case (include-ci). */
bool vs_source_read(vs_scheme *vm, const char *path, bool fold, vs_value *forms);

/* Reads the forms of a file that text in the file `from` includes. *circle: the file includes itself, directly or
 * through others; then nothing is read, and the function returns false without an error. */
bool vs_source_include(vs_scheme *vm, vs_value name, uint32_t from, bool fold, vs_value *forms, bool *circle);

/* Returns the other language of a file of this name (front_ends.def), in words; NULL: this one. */
const char *vs_source_language(const char *name);
/* Returns the name of a procedure for messages, at a place in its text: that of a script's function has no colon. */
const char *vs_source_said(vs_scheme *vm, const char *name, vs_pos place);

/* Reads the forms of a text (reader.h) in the language of a file of this name. */
bool vs_source_text(vs_scheme *vm, const char *name, const vs_passage *text, bool fold, vs_value *forms);

#endif
