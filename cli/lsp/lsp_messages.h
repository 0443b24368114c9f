/* Declares the messages of the language server to the editor. */
#ifndef VS_CLI_LSP_LSP_MESSAGES_H
#define VS_CLI_LSP_LSP_MESSAGES_H

#include "cli/lsp/lsp_answers.h"

/* A message that is written to memory first, and then sent with its length. */
typedef struct { FILE *to; char *text; size_t length; } lsp_message;

/* Opens m->to, to which the caller writes the members of the message. Returns false when memory is out. */
bool lsp_message_begin(lsp_message *m);
void lsp_message_send(lsp_message *m);
void lsp_message_drop(lsp_message *m); /* frees the message without sending it */
/* Sends the diagnostics of the document, or none if it is closed. */
void lsp_publish(lsp_server *s, lsp_document *d, bool closed);

#endif
