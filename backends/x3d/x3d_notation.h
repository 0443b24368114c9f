/* Owns the interface of x3d_notation.c: X3D's notations. */
#ifndef VS_BACKENDS_X3D_X3D_NOTATION_H
#define VS_BACKENDS_X3D_X3D_NOTATION_H

#include "backends/backend.h"

/* field: the parent's field that holds the node; NULL: its list of children. def NULL: no name. */
void vs_x3d_node(vs_emitter *e, const char *field, const char *type, const char *def);
void vs_x3d_use(vs_emitter *e, const char *field, const char *type, const char *name);
void vs_x3d_children(vs_emitter *e); /* begins a list of children; the fields come before it */
void vs_x3d_end(vs_emitter *e, const char *type, bool had_children);
void vs_x3d_field(vs_emitter *e, const char *name, bool many); /* then the value, then: */
void vs_x3d_field_end(vs_emitter *e, bool many);
/* Writes a field with the same spelling in both notations: numbers, true, false. */
void vs_x3d_words(vs_emitter *e, const char *name, const char *value);
void vs_x3d_text(vs_emitter *e, const char *name, const char *value, bool many);   /* a string */
void vs_x3d_number(vs_emitter *e, const char *name, double value);
void vs_x3d_vector(vs_emitter *e, const char *name, vs_vec3 value);
void vs_x3d_turn(vs_emitter *e, const char *name, vs_vec3 axis, double angle);

#endif
