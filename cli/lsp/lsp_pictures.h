/* Declares the value and the picture of a definition, which a confined run of the saved text makes. */
#ifndef VS_CLI_LSP_LSP_PICTURES_H
#define VS_CLI_LSP_LSP_PICTURES_H

#include "cli/lsp/lsp_answers.h"

/* Returns true if a run that computes the name's value has started; it answers the request that s->id names. text: the
 * answer without the value, of which the function keeps a copy; node: the name, whose range the answer has. */
bool lsp_picture_start(lsp_server *s, lsp_document *d, know_index node, const char *text);

#endif
