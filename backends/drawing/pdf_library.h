/* The functions of libharu that the writer of .pdf calls. vs loads them when it writes the first PDF. */
#ifndef VS_BACKENDS_DRAWING_PDF_LIBRARY_H
#define VS_BACKENDS_DRAWING_PDF_LIBRARY_H

#include <hpdf.h>

#define VS_PDF_FUNCTIONS(X) \
  X(HPDF_NewEx) X(HPDF_Free) X(HPDF_SetCompressionMode) X(HPDF_AddPage) X(HPDF_Page_SetWidth) \
  X(HPDF_Page_SetHeight) X(HPDF_Page_SetLineWidth) X(HPDF_Page_SetLineCap) X(HPDF_Page_SetLineJoin) \
  X(HPDF_Page_SetGrayStroke) X(HPDF_Page_SetRGBStroke) X(HPDF_Page_SetGrayFill) X(HPDF_Page_SetRGBFill) \
  X(HPDF_Page_MoveTo) X(HPDF_Page_LineTo) \
  X(HPDF_Page_ClosePath) X(HPDF_Page_Stroke) X(HPDF_Page_Eofill) X(HPDF_Page_BeginText) X(HPDF_Page_EndText) \
  X(HPDF_Page_SetFontAndSize) X(HPDF_Page_SetTextMatrix) X(HPDF_Page_ShowText) X(HPDF_Page_TextWidth) \
  X(HPDF_LoadTTFontFromFile) X(HPDF_GetFont) X(HPDF_UseUTFEncodings) X(HPDF_SetInfoAttr) X(HPDF_SaveToStream) \
  X(HPDF_GetStreamSize) X(HPDF_ReadFromStream) X(HPDF_ResetStream) X(HPDF_GetError) \
  X(HPDF_Dict_New) X(HPDF_Dict_Add) X(HPDF_Dict_AddName) X(HPDF_Dict_GetItem) X(HPDF_Array_New) X(HPDF_Array_Add) \
  X(HPDF_Binary_New) X(HPDF_Xref_Add) X(HPDF_Stream_WriteStr)

typedef struct {
#define VS_PDF_MEMBER(name) __typeof__(&name) name;
  VS_PDF_FUNCTIONS(VS_PDF_MEMBER)
#undef VS_PDF_MEMBER
} vs_pdf_library;

#endif
