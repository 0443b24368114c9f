/* Declares the lens of a text, which shows the model in a live view. */
#ifndef VS_CLI_LSP_LSP_LENS_H
#define VS_CLI_LSP_LSP_LENS_H

#include "cli/lsp/lsp_answers.h"

#define LSP_SHOW_COMMAND "visualscheme.show" /* the command of the lens; its argument is the text's address */

void lsp_lens(lsp_server *s, cli_data parameters);    /* answers a request for the lens of a text; its type is
                                                       * lsp_answer */
/* An lsp_answer: starts a live view of the model, unless there is one, and answers with its address. */
void lsp_command(lsp_server *s, cli_data parameters);
void lsp_views_end(lsp_server *s); /* ends the live views that the server has started */

/* Returns the node that makes the drawing: the first call of draw, otherwise the last expression; 0 if there is
 * none. */
know_index lsp_drawing_of(const knowledge *k);

#endif
