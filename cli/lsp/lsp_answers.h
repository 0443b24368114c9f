/* Declares the answers of the language server. */
#ifndef VS_CLI_LSP_LSP_ANSWERS_H
#define VS_CLI_LSP_LSP_ANSWERS_H

#include "cli/lsp/json_input.h"
#include "cli/lsp/lsp_document.h"
#include "languages/analysis/source_tree.h"

typedef struct {
  lsp_json_reader json;
  const vs_options *interpreter;
  vs_scheme *language;       /* an interpreter that has run no program, which provides the names of the language */
  lsp_document **documents; size_t count, room; /* array of pointers to documents, which are separate blocks, since
                                                 * interpreters point to them */
  const char *refused;       /* reason why the last request has no result, or NULL */
  FILE *to;                  /* stream to which a request's result is written */
} lsp_server;

/* The function that answers a request. It writes its result to s->to: one JSON value. If it sets s->refused, the result
 * is not sent. The rows of lsp_methods.def give the function for each method. */
typedef void lsp_answer(lsp_server *s, lsp_json parameters);
void lsp_completion(lsp_server *s, lsp_json parameters);
void lsp_hover(lsp_server *s, lsp_json parameters);
void lsp_signature(lsp_server *s, lsp_json parameters);
void lsp_definition(lsp_server *s, lsp_json parameters);
void lsp_references(lsp_server *s, lsp_json parameters);
void lsp_rename(lsp_server *s, lsp_json parameters);
void lsp_outline(lsp_server *s, lsp_json parameters);
void lsp_formatting(lsp_server *s, lsp_json parameters);

/* Returns the open document that the request's parameters name by its address, or NULL. */
lsp_document *lsp_find(const lsp_server *s, lsp_json parameters);
/* Writes the findings of vs check in the document, or its first error, as the protocol's list of diagnostics. */
void lsp_write_diagnostics(lsp_server *s, lsp_document *d);

#endif
