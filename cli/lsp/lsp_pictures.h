/* Declares the value and the picture of a definition, which a confined run of the saved text makes. */
#ifndef VS_CLI_LSP_LSP_PICTURES_H
#define VS_CLI_LSP_LSP_PICTURES_H

#include "cli/lsp/lsp_answers.h"

/* Starts a run that computes the value of the name `node`, and then answers the request with the id s->id. Returns
 * false if no run starts. text: the answer without the value; the function copies it. */
bool lsp_picture_start(lsp_server *s, lsp_document *d, know_index node, const char *text);

#endif
