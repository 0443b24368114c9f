/* Declares X3D's two notations. */
#ifndef VS_BACKENDS_X3D_X3D_NOTATION_H
#define VS_BACKENDS_X3D_X3D_NOTATION_H

#include "backends/backend.h"

/* vs_x3d_node begins a node, and vs_x3d_use writes the use of a named node. field: the parent's field that contains the
 * node; NULL: the parent's list of children. If def is NULL, the node has no name. */
void vs_x3d_node(vs_emitter *e, const char *field, const char *type, const char *def);
void vs_x3d_use(vs_emitter *e, const char *field, const char *type, const char *name);
void vs_x3d_children(vs_emitter *e); /* begins a list of children; the node's fields come before it */
void vs_x3d_end(vs_emitter *e, const char *type, bool had_children);
void vs_x3d_field(vs_emitter *e, const char *name, bool many); /* begins a field; its value follows, and then
                                                                * vs_x3d_field_end */
void vs_x3d_field_end(vs_emitter *e, bool many);
/* Writes a field whose value is the same text in both notations: numbers, true, false. */
void vs_x3d_words(vs_emitter *e, const char *name, const char *value);
void vs_x3d_text(vs_emitter *e, const char *name, const char *value, bool many);   /* writes a field with a string */
void vs_x3d_number(vs_emitter *e, const char *name, double value);
void vs_x3d_vector(vs_emitter *e, const char *name, vs_vec3 value);
void vs_x3d_turn(vs_emitter *e, const char *name, vs_vec3 axis, double angle);

#endif
