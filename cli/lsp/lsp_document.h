/* Declares the texts that an editor has open. */
#ifndef VS_CLI_LSP_LSP_DOCUMENT_H
#define VS_CLI_LSP_LSP_DOCUMENT_H

#include "cli/draft.h"

typedef struct { uint32_t line, character; } lsp_position; /* a position as the protocol counts it: line from 0, and
                                                            * character from 0 in units of UTF-16 */
typedef struct { uint32_t from, to; } lsp_span; /* the bytes from `from` to `to` - 1 of a text */

/* A message of the run after the last save. The column counts characters, and both count from 1. severity: 1 error, 2
 * warning, 3 note, or LSP_UNREACHED. */
typedef struct { uint32_t line, column; int severity; char text[400]; } lsp_run_message;
enum { LSP_UNREACHED = 4 /* the run did not reach the form at the place */ };

typedef struct { uint32_t line; double seconds; } lsp_line_time; /* seconds: in the line itself */

typedef struct {
  char *uri, *path, *text;
  size_t length, room;
  cli_draft drafts[2], *draft; /* two analyses, of which `draft` is the present one; empty if the text was not analysed
                                * yet */
  bool fresh;          /* whether `draft` is the analysis of the present text, and not of an earlier text */
  bool saved, slow;    /* saved: whether the text is that of the file; slow: whether a run of this text took too long */
  lsp_run_message *messages; size_t message_count, message_room;
  lsp_line_time *times; size_t time_count, time_room; /* lines that took much of the run's time */
  double seconds;      /* seconds of the run after the last save */
  char *libraries;     /* folders of libraries: those of the text's packages and of the server, or NULL */
} lsp_document;

/* Returns the offset in bytes of a position, at most `length`. */
size_t lsp_offset(const char *text, size_t length, lsp_position at);
/* Returns the position of an offset in bytes. */
lsp_position lsp_position_of(const char *text, size_t length, size_t offset);
/* Moves *at on to the byte `to`, and updates *place, the position of *at. */
void lsp_advance(const char *text, size_t length, size_t *at, size_t to, lsp_position *place);
/* Returns the bytes of a place that is given by lines and columns. An empty place is extended to one character. */
lsp_span lsp_place(const char *text, size_t length, const know_place *at);

/* Returns a new document, which lsp_document_free frees, or NULL when memory is out. */
lsp_document *lsp_document_open(const char *uri, const char *text, size_t length);
void lsp_document_free(lsp_document *d);
/* Frees the analyses, not the text. */
void lsp_document_rest(lsp_document *d);
/* Replaces the bytes from `from` to `to` - 1 of the document. Returns false when memory is out; the document is then
 * unchanged. */
bool lsp_document_edit(lsp_document *d, size_t from, size_t to, const char *text, size_t length);
/* Forgets the messages and the times of the last run. */
void lsp_document_forget(lsp_document *d);
/* Returns the interpreter's options, with the packages of the text's folder. */
vs_options lsp_document_options(lsp_document *d, const vs_options *interpreter);
/* Analyses the present text, if this was not done yet. Returns true if the text could be analysed. */
bool lsp_document_study(lsp_document *d, const vs_options *interpreter);
/* Returns the newest successful analysis, or NULL. While the text cannot be read, this is the analysis of an earlier
 * text. */
knowledge *lsp_document_knowledge(lsp_document *d, const vs_options *interpreter);
/* Returns the symbol (a name with its definition) whose name is at the byte `offset`, or 0. Sets *node to the name's
 * node. */
know_index lsp_symbol_at(const knowledge *k, size_t offset, know_index *node);
/* Returns true if the node is a name in the text, and refers to this symbol. */
bool lsp_is_name_of(const knowledge *k, know_index node, know_index symbol);
/* Returns the path for an address such as file:///home/a%20b.vs, or the address itself if it does not begin with file:.
 * The caller frees it. */
char *lsp_path_of(const char *uri);
/* Returns whether the text is that of its file. */
bool lsp_document_is_file(const lsp_document *d);
/* Writes the file's address as a JSON text. */
void lsp_write_uri(FILE *to, const char *path);

#endif
