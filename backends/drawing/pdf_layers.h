/* Declares the layers of a .pdf ("optional content", ISO 32000-1, section 8.11). A reader lists the layers and hides
 * each on request. */
#ifndef VS_BACKENDS_DRAWING_PDF_LAYERS_H
#define VS_BACKENDS_DRAWING_PDF_LAYERS_H

#include "backends/drawing/pdf_library.h"

typedef struct {
  const vs_pdf_library *lib;
  HPDF_Doc doc;
  HPDF_Stream stream;  /* the page's drawing operators */
  HPDF_Dict names;     /* the page's dictionary from a layer's name in the operators to the layer */
  HPDF_Array layers;   /* all layers of the file */
  HPDF_Array order;    /* the layers in the order of the reader's list */
  unsigned count;      /* number of layers */
} vs_pdf_layers;

/* Each function returns false if libharu fails; HPDF_GetError then returns the reason. libharu frees the layers
 * together with the file. */

/* Prepares a page for layers. Nothing may have been drawn on the page. */
bool vs_pdf_layers_begin(vs_pdf_layers *l, const vs_pdf_library *lib, HPDF_Doc doc, HPDF_Page page);
/* Begins a layer, which contains all marks that are drawn before the call of vs_pdf_layer_end. */
bool vs_pdf_layer_begin(vs_pdf_layers *l, const char *name);
bool vs_pdf_layer_end(vs_pdf_layers *l);

#endif
