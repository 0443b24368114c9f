/* Declares the scanner of OpenSCAD, which converts a file and the files that it includes to one row of tokens. */
#ifndef VS_VM_OPENSCAD_OPENSCAD_SCANNER_H
#define VS_VM_OPENSCAD_OPENSCAD_SCANNER_H

#include "vm/front/text_cursor.h"
#include "vm/values/text.h"
#include "vm/values/value.h"

typedef enum {
  VS_SCAD_END,
  VS_SCAD_NAME,
  VS_SCAD_NUMBER,
  VS_SCAD_STRING, /* text: the characters between the quotation marks, with their escapes */
  VS_SCAD_USE,    /* text: the name of the file between < and > */
  VS_SCAD_MARK    /* an operator or a bracket of one or two characters */
} vs_scad_kind;

/* A token. text, size: its bytes in the source text, which the scanner owns. */
typedef struct {
  vs_scad_kind kind;
  vs_pos pos;
  const char *text, *start, *end; /* start, end: those of the file's text */
  size_t size;
} vs_scad_token;

/* A file that is being read. text: a copy that the scanner owns, or the text of the main file. */
typedef struct vs_scad_file {
  struct vs_scad_file *around; /* the file that includes this one, or NULL */
  vs_text_cursor from;
} vs_scad_file;

/* The texts of files that have been read: tokens refer to them until the scanner is closed. */
typedef struct vs_scad_text { struct vs_scad_text *next; size_t size; char at[]; } vs_scad_text;

/* The name of a group of the customizer: `size` bytes of a source text; at: NULL before the first group. */
typedef struct { const char *at; size_t size; } vs_scad_group;

typedef struct {
  vs_scheme *vm;
  vs_scad_file *file;
  vs_scad_text *texts;
  uint32_t main_file;           /* number of the file whose parameters a user can set */
  vs_scad_group group;          /* the customizer's group, as in the last comment [name] */
  vs_value *missing;            /* a root of the garbage collector: a list of the names of files that are missing */
} vs_scad_scanner;

/* Begins to read a text, which must stay until vs_scad_close. Fails when memory is out. */
bool vs_scad_open_text(vs_scad_scanner *s, const char *text, size_t size, uint32_t file, uint32_t line);
/* Begins to read a file. Fails if it cannot be read. */
bool vs_scad_open_file(vs_scad_scanner *s, const char *path, uint32_t file);
/* Looks for the file of an include or a use: beside file number `from`, in the folders of OPENSCADPATH, and in the
 * user's folder of OpenSCAD's libraries. Sets *path and *found as vs_source_find does. */
bool vs_scad_find(vs_scheme *vm, vs_value name, uint32_t from, vs_text *path, bool *found);
/* Sets *token to the next token. Fails at a text that contains none. */
bool vs_scad_next(vs_scad_scanner *s, vs_scad_token *token);
/* Frees the texts of files. */
void vs_scad_close(vs_scad_scanner *s);
/* Sets *out to the string that the characters of a string token mean. */
bool vs_scad_string(vs_scheme *vm, const vs_scad_token *token, vs_value *out);
/* Returns true if the token is this operator or bracket. */
bool vs_scad_is(const vs_scad_token *token, const char *mark);
/* Returns true if the token is this name. */
bool vs_scad_is_name(const vs_scad_token *token, const char *name);

#endif
