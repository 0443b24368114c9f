/* Declares the answer with the edits that an analysis advises. */
#ifndef VS_CLI_LSP_LSP_ACTIONS_H
#define VS_CLI_LSP_LSP_ACTIONS_H

#include "cli/lsp/lsp_answers.h"

void lsp_actions(lsp_server *s, cli_data parameters); /* answers a request for edits; its type is lsp_answer */

#endif
