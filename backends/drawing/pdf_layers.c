/* Creates the layers of a .pdf from libharu's objects: libharu itself has no function for layers. */
#include <stdio.h>
#include <string.h>
#include <utf8proc.h>

#include "backends/drawing/pdf_layers.h"

enum { LONGEST = 120 }; /* greatest number of letters of a layer's name */

/* Adds an empty dictionary to the dictionary `owner`, under `key`, and returns it. Returns NULL if libharu fails. */
static HPDF_Dict add_dictionary(const vs_pdf_layers *l, HPDF_Dict owner, const char *key) {
  HPDF_Dict d = l->lib->HPDF_Dict_New(l->doc->mmgr);
  return d && l->lib->HPDF_Dict_Add(owner, key, d) == HPDF_OK ? d : NULL;
}

static HPDF_Array add_array(const vs_pdf_layers *l, HPDF_Dict owner, const char *key) {
  HPDF_Array a = l->lib->HPDF_Array_New(l->doc->mmgr);
  return a && l->lib->HPDF_Dict_Add(owner, key, a) == HPDF_OK ? a : NULL;
}

bool vs_pdf_layers_begin(vs_pdf_layers *l, const vs_pdf_library *lib, HPDF_Doc doc, HPDF_Page page) {
  *l = (vs_pdf_layers){ .lib = lib, .doc = doc };
  HPDF_Dict contents = lib->HPDF_Dict_GetItem(page, "Contents", HPDF_OCLASS_DICT);
  HPDF_Dict resources = lib->HPDF_Dict_GetItem(page, "Resources", HPDF_OCLASS_DICT);
  if (!contents || !resources) return false;
  l->stream = contents->stream;
  l->names = add_dictionary(l, resources, "Properties");
  HPDF_Dict properties = l->names ? add_dictionary(l, doc->catalog, "OCProperties") : NULL;
  l->layers = properties ? add_array(l, properties, "OCGs") : NULL;
  HPDF_Dict view = l->layers ? add_dictionary(l, properties, "D") : NULL;
  l->order = view ? add_array(l, view, "Order") : NULL;
  if (doc->pdf_version < HPDF_VER_15) doc->pdf_version = HPDF_VER_15; /* PDF 1.5 is the first version with layers */
  return l->order != NULL;
}

/* Writes a name in UTF-16, with a byte order mark. Returns the number of bytes. A name longer than LONGEST letters is
 * shortened. */
static unsigned to_utf16(const char *name, HPDF_BYTE out[4 * LONGEST + 2]) {
  unsigned n = 0;
  out[n++] = 0xfe;
  out[n++] = 0xff;
  const utf8proc_uint8_t *at = (const utf8proc_uint8_t *)name;
  for (int letters = 0; *at && letters < LONGEST; letters++) {
    utf8proc_int32_t c;
    const utf8proc_ssize_t bytes = utf8proc_iterate(at, -1, &c);
    if (bytes < 1) c = 0xfffd;
    at += bytes < 1 ? 1 : bytes;
    const uint32_t units[2] = { c < 0x10000 ? (uint32_t)c : 0xd800u + (((uint32_t)c - 0x10000) >> 10),
                                0xdc00u + (((uint32_t)c - 0x10000) & 0x3ff) };
    for (int i = 0; i < (c < 0x10000 ? 1 : 2); i++) {
      out[n++] = (HPDF_BYTE)(units[i] >> 8);
      out[n++] = (HPDF_BYTE)(units[i] & 0xff);
    }
  }
  return n;
}

bool vs_pdf_layer_begin(vs_pdf_layers *l, const char *name) {
  const vs_pdf_library *lib = l->lib;
  HPDF_BYTE bytes[4 * LONGEST + 2];
  char key[16], operators[32];
  HPDF_Dict layer = lib->HPDF_Dict_New(l->doc->mmgr);
  if (!layer || lib->HPDF_Xref_Add(l->doc->xref, layer) != HPDF_OK) return false;
  HPDF_Binary text = lib->HPDF_Binary_New(l->doc->mmgr, bytes, to_utf16(name, bytes));
  snprintf(key, sizeof key, "L%u", ++l->count);
  snprintf(operators, sizeof operators, "/OC /%s BDC\n", key);
  return text && lib->HPDF_Dict_AddName(layer, "Type", "OCG") == HPDF_OK &&
      lib->HPDF_Dict_Add(layer, "Name", text) == HPDF_OK && lib->HPDF_Dict_Add(l->names, key, layer) == HPDF_OK &&
      lib->HPDF_Array_Add(l->layers, layer) == HPDF_OK && lib->HPDF_Array_Add(l->order, layer) == HPDF_OK &&
      lib->HPDF_Stream_WriteStr(l->stream, operators) == HPDF_OK;
}

bool vs_pdf_layer_end(vs_pdf_layers *l) { return l->lib->HPDF_Stream_WriteStr(l->stream, "EMC\n") == HPDF_OK; }
