/* Sends messages to the editor. */
#include "cli/lsp/lsp_messages.h"

#include <stdlib.h>

#include "cli/lsp/lsp_words.h"

bool lsp_message_begin(lsp_message *m) {
  *m = (lsp_message){ 0 };
  m->to = open_memstream(&m->text, &m->length);
  if (m->to) fputs("{\"jsonrpc\":\"2.0\",", m->to);
  return m->to != NULL;
}

void lsp_message_send(lsp_message *m) {
  fputc('}', m->to);
  if (fclose(m->to) == 0) {
    printf("Content-Length: %zu\r\n\r\n", m->length);
    fwrite(m->text, 1, m->length, stdout);
    fflush(stdout);
  }
  free(m->text);
}

void lsp_message_drop(lsp_message *m) {
  fclose(m->to);
  free(m->text);
}

void lsp_publish(lsp_server *s, lsp_document *d, bool closed) {
  lsp_message m;
  if (!lsp_message_begin(&m)) return;
  fputs("\"method\":\"textDocument/publishDiagnostics\",\"params\":{\"uri\":", m.to);
  lsp_put(m.to, d->uri);
  fputs(",\"diagnostics\":", m.to);
  if (closed) fputs("[]", m.to);
  else lsp_write_diagnostics(m.to, d, s->interpreter);
  fputc('}', m.to);
  lsp_message_send(&m);
}
