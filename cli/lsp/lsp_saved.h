/* Declares the run of a text that was saved: its messages, the forms that did not run, the time of its lines. */
#ifndef VS_CLI_LSP_LSP_SAVED_H
#define VS_CLI_LSP_LSP_SAVED_H

#include "cli/lsp/lsp_answers.h"

void lsp_did_save(lsp_server *s, cli_data parameters); /* starts the run; a newer one ends it */
void lsp_hints(lsp_server *s, cli_data parameters); /* answers with the share of the time behind lines that took much */

#endif
