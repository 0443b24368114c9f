/* Declares the answers of the language server. */
#ifndef VS_CLI_LSP_LSP_ANSWERS_H
#define VS_CLI_LSP_LSP_ANSWERS_H

#include "cli/lsp/json_input.h"
#include "cli/lsp/lsp_document.h"
#include "languages/analysis/source_tree.h"

typedef struct {
  lsp_json_reader json;
  const vs_options *interpreter;
  vs_scheme *language;       /* an interpreter that has run no program: the language's names */
  lsp_document **documents; size_t count, room; /* each in its own memory: interpreters point to them */
  const char *refused;       /* reason why the last request has no answer, or NULL */
  FILE *to;                  /* stream to which a request's result is written */
} lsp_server;

/* An answer writes its result to s->to: one JSON value. If it sets s->refused, the result does not count. The rows of
 * lsp_methods.def say which method each answers. */
typedef void lsp_answer(lsp_server *s, lsp_json parameters);
void lsp_completion(lsp_server *s, lsp_json parameters);
void lsp_hover(lsp_server *s, lsp_json parameters);
void lsp_signature(lsp_server *s, lsp_json parameters);
void lsp_definition(lsp_server *s, lsp_json parameters);
void lsp_references(lsp_server *s, lsp_json parameters);
void lsp_rename(lsp_server *s, lsp_json parameters);
void lsp_outline(lsp_server *s, lsp_json parameters);
void lsp_formatting(lsp_server *s, lsp_json parameters);

/* Returns the document with this address, or NULL. */
lsp_document *lsp_find(const lsp_server *s, lsp_json parameters);
/* Writes the findings in the document, or its first error, as a list of diagnostics. */
void lsp_write_diagnostics(lsp_server *s, lsp_document *d);

#endif
