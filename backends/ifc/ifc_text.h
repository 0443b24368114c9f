/* Declares the lines of IFC 4, which ifc_text.c spells and ifc.c makes of the drawing. A line has a
 * number, by which others refer to it. */
#ifndef VS_BACKENDS_IFC_IFC_TEXT_H
#define VS_BACKENDS_IFC_IFC_TEXT_H

#include "backends/backend.h"

/* A growing list of the numbers of lines. */
typedef struct { unsigned *at; size_t count, room; } vs_ifc_list;
bool vs_ifc_add(vs_emitter *e, vs_ifc_list *l, unsigned line);
void vs_ifc_list_free(vs_emitter *e, vs_ifc_list *l);

/* Begins a line: writes #number=NAME( . */
void vs_ifc_begin(vs_writer *w, unsigned number, const char *name);
void vs_ifc_end(vs_writer *w);                          /* ends a line */
void vs_ifc_real(vs_writer *w, double x);               /* writes a number, which has a point in STEP's text */
void vs_ifc_text(vs_writer *w, const char *text);       /* writes a text of the user between apostrophes */
void vs_ifc_reference(vs_writer *w, unsigned number);   /* writes #number */
void vs_ifc_references(vs_writer *w, const vs_ifc_list *l); /* writes (#1,#2) */
void vs_ifc_triple(vs_writer *w, vs_vec3 v);            /* writes (x,y,z) */
/* Writes the global id of the thing with this number in a drawing of this title. Equal drawings have equal ids. */
void vs_ifc_id(vs_writer *w, const char *title, unsigned number);

/* The class of a layer's objects and the attributes after the tag. layer: a name, or NULL. */
typedef struct { const char *name, *attributes; } vs_ifc_class;
vs_ifc_class vs_ifc_class_of(const char *layer);

#endif
