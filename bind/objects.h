/* Owns the interface of objects.c: what Scheme sees of the model. */
#ifndef VS_BIND_OBJECTS_H
#define VS_BIND_OBJECTS_H

#include "model/node.h"
#include "vm/machine/activation.h"
#include "vm/machine/native.h"

typedef struct vs_bind vs_bind;

#define VS_BIND_NO_VALUE "one expression gave no value" /* in messages about lists of objects */

/* a shape owns a reference to a node, with its origin; a paint wraps an interned vs_material */
extern const vs_foreign_type vs_shape_type, vs_paint_type;
/* Returns the reference that a Scheme object holds, not retained; its node is NULL if v is no object. */
static inline vs_ref vs_bind_ref(vs_value v) {
  vs_node *node = (vs_node *)vs_foreign_get(v, &vs_shape_type);
  return (vs_ref){ node, node ? (const vs_origin *)vs_as_foreign(v)->with : NULL };
}

static inline bool vs_bind_is_empty(const vs_node *n) { return n->kind == VS_EMPTY; }

/* Where the running native was called from, and its callers. NULL: not known (or out of memory: then nothing worse
 * happens). */
const vs_origin *vs_bind_origin(vs_bind *b);
vs_status vs_bind_wrap_ref(vs_bind *b, vs_ref ref /* retained */, vs_value *out); /* with the place where it was made */
vs_status vs_bind_wrap(vs_bind *b, vs_node *node /* taken over; NULL: out of memory */, vs_value *out);
/* A position's file as text of the store; NULL: nowhere, or one of the language's own sources: places in those are not
 * the user's business. */
const char *vs_bind_file_name(vs_bind *b, vs_pos place);
bool vs_bind_is_library(vs_bind *b, uint32_t file); /* is the file of this number one of those sources? */
uint32_t vs_bind_file_count(vs_scheme *vm); /* files that have a number */
/* Was such a warning given for this place before? It counts as given from now on. */
bool vs_bind_warned(vs_bind *b, const vs_origin *o, const char *kind);
/* once a place and `kind` (any constant text); nothing when it could not be formatted */
void vs_bind_clear(vs_bind *b, const char *kind); /* no warning of this kind at the call's place from now on */
void vs_bind_warn(vs_bind *b, const char *kind, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* UTF-8 with NUL from vs_mem; *bytes to give back */
bool vs_bind_text(vs_scheme *vm, vs_value string_or_symbol, char **out, size_t *bytes);
int32_t vs_bind_segments(vs_bind *b);                   /* (current-segments), 0: by tolerance */
double vs_bind_tolerance(vs_bind *b);                   /* (current-tolerance), 0: by the drawing size */

#endif
