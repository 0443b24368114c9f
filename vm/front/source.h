/* Declares the search for source files, their language, and the reading of their forms. */
#ifndef VS_VM_FRONT_SOURCE_H
#define VS_VM_FRONT_SOURCE_H

#include "vm/values/text.h"

typedef struct vs_passage vs_passage;

/* A source file that the program vs contains, and reads only when it is imported. The last element of an array of
 * vs_shipped has no name. */
typedef struct vs_shipped { const char *name /* file name such as "srfi/13.sld" */, *text, *end; } vs_shipped;
/* Returns true if the path is that of a file inside the program vs, such as library:srfi/13.sld. These files are
 * searched last. */
bool vs_source_is_shipped(const char *path);
/* Returns the file of this name in vm->config.shipped, or NULL. */
const vs_shipped *vs_source_shipped(const vs_scheme *vm, const char *name);

/* Finds the file to which the string `name` in file number `from` (0: none) refers, in the folder of `from` and the
 * folders of libraries. Sets *found to true if a folder has the file; otherwise *path names it in the first folder. */
bool vs_source_find(vs_scheme *vm, vs_value name, uint32_t from, size_t up, vs_text *path, bool *found);
/* Finds the file as vs_source_find does with up = 0. If the file does not exist, *path is set all the same; reading it
 * reports the missing file. */
bool vs_source_path(vs_scheme *vm, vs_value name, uint32_t from, vs_text *path);
/* Sets *t to the name of file number `file`, or to the empty text if there is no such file. */
bool vs_source_name(vs_scheme *vm, uint32_t file, vs_text *t);
/* Reads the forms of a file. fold: convert letters to lower case (include-ci). */
bool vs_source_read(vs_scheme *vm, const char *path, bool fold, vs_value *forms);

/* Reads the forms of a file that file number `from` includes. If the file includes itself, directly or through others,
 * sets *circle to true and returns false without an error. */
bool vs_source_include(vs_scheme *vm, vs_value name, uint32_t from, bool fold, vs_value *forms, bool *circle);

/* Returns the name of the language of a file with this name (front_ends.def), or NULL for Scheme. */
const char *vs_source_language(const char *name);
/* Returns the name of a procedure as messages show it. If the file of `place` is in another language than Scheme, the
 * name loses the colon at its start. */
const char *vs_source_said(vs_scheme *vm, const char *name, vs_pos place);
/* Returns the name as messages show it. If the program's main file is in another language than Scheme, the name loses
 * the colon at its start. */
const char *vs_source_word(vs_scheme *vm, const char *name);

/* Reads the forms of a text (reader.h). `name` is the name of its file, which determines the language. */
bool vs_source_text(vs_scheme *vm, const char *name, const vs_passage *text, bool fold, vs_value *forms);

#endif
