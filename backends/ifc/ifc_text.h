/* Declares functions that write the lines of IFC 4. A line has a number, by which other lines refer to it. */
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
void vs_ifc_real(vs_writer *w, double x);               /* writes a real number with a decimal point, as STEP's text
                                                         * requires */
void vs_ifc_text(vs_writer *w, const char *text);       /* writes a text of the user between apostrophes */
void vs_ifc_reference(vs_writer *w, unsigned number);   /* writes a reference to a line, such as #12 */
void vs_ifc_references(vs_writer *w, const vs_ifc_list *l); /* writes a list of references, such as (#1,#2) */
void vs_ifc_triple(vs_writer *w, vs_vec3 v);            /* writes (x,y,z) */
/* Writes the global id of object number `number` in a drawing with this title. Equal drawings have equal ids. */
void vs_ifc_id(vs_writer *w, const char *title, unsigned number);

/* name: the IFC class for a layer's objects; attributes: those that follow the attribute Tag in its lines. `layer` is
 * the layer's name, or NULL. */
typedef struct { const char *name, *attributes; } vs_ifc_class;
vs_ifc_class vs_ifc_class_of(const char *layer);
bool vs_ifc_is_opening(vs_ifc_class c); /* Returns true if elements of this class are holes of other elements. */
bool vs_ifc_fills(vs_ifc_class c);      /* Returns true if elements of this class can fill an opening. */

#endif
