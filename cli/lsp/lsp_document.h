/* Declares the texts that an editor has open. */
#ifndef VS_CLI_LSP_LSP_DOCUMENT_H
#define VS_CLI_LSP_LSP_DOCUMENT_H

#include "cli/draft.h"

typedef struct { uint32_t line, character; } lsp_position; /* from 0; characters are units of UTF-16 */
typedef struct { uint32_t from, to; } lsp_span; /* bytes of a text */

typedef struct {
  char *uri, *path, *text;
  size_t length, room;
  cli_draft draft;     /* analysis of the text, or of none yet */
  bool fresh;          /* whether draft is of the present text */
} lsp_document;

/* Returns the byte of the position, at most length; and the position of a byte. */
size_t lsp_offset(const char *text, size_t length, lsp_position at);
lsp_position lsp_position_of(const char *text, size_t length, size_t offset);
/* Returns the bytes of a place that has lines and columns of characters. An empty place gets one character. */
lsp_span lsp_place(const char *text, size_t length, const know_place *at);

/* Returns a new document, which lsp_document_free frees, or NULL when memory is out. */
lsp_document *lsp_document_open(const char *uri, const char *text, size_t length);
void lsp_document_free(lsp_document *d);
/* Replaces the bytes [from, to) of the text. Returns false when memory is out; the text is then as before. */
bool lsp_document_edit(lsp_document *d, size_t from, size_t to, const char *text, size_t length);
/* Analyses the present text, if that has not been done. Returns true if it could be analysed. */
bool lsp_document_study(lsp_document *d, const vs_options *interpreter);
/* Returns the symbol of the name at the byte, or 0. Sets *node to the name's node. */
know_index lsp_symbol_at(const knowledge *k, size_t offset, know_index *node);
/* Returns true if the node is a name of a text, and its symbol is this one. */
bool lsp_is_name_of(const knowledge *k, know_index node, know_index symbol);
/* Writes the file's address as a JSON text. */
void lsp_write_uri(FILE *to, const char *path);

#endif
