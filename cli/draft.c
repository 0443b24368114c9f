/* Analyses a text while the user changes it in an editor. */
#include "cli/draft.h"

#include <stdio.h>
#include <string.h>

#include "languages/analysis/resolve_names.h"

enum { SECONDS = 5, MEMORY = 512 << 20 };

/* Receives messages of the interpreter, and stores the first error whose place is in the text itself. */
static void keep_error(void *context, const vs_diagnostic *m) {
  cli_draft *d = context;
  if (d->k.muted) know_hear(&d->k, m);
  if (m->severity != VS_SEVERITY_ERROR || !m->at.line) return;
  d->k.unreadable |= d->k.reading;
  if (d->k.muted || *d->message) return;
  bool elsewhere = m->at.file && strcmp(m->at.file, d->path); /* whether the error is in another file, which the text
                                                               * loads */
  if (elsewhere)
    snprintf(d->message, sizeof d->message, "%s:%u:%u: %s", m->at.file, (unsigned)m->at.line, (unsigned)m->at.column,
             m->message);
  else snprintf(d->message, sizeof d->message, "%s", m->message);
  d->at = (know_place){ .line = 1, .column = 1 };
  if (!elsewhere) d->at = (know_place){ .line = m->at.line, .column = m->at.column, .end_line = m->at.end_line,
                        .end_column = m->at.end_column };
}

bool cli_draft_read(cli_draft *d, const vs_options *interpreter, const char *path, const char *text, size_t length) {
  *d = (cli_draft){ .path = path };
  vs_options o = *interpreter;
  o.host = (vs_host){ .context = d, .diagnose = keep_error };
  o.limit_time = SECONDS, o.limit_memory = MEMORY;
  d->scheme = vs_new(&o);
  if (!d->scheme) return false;
  d->known = know_read_given(&d->k, d->scheme, path, text, length, o.library_path) &&
             know_check_program(&d->k, &d->found);
  if (!d->known && !*d->message) snprintf(d->message, sizeof d->message, "%s", d->k.trouble);
  return true;
}

void cli_draft_free(cli_draft *d) {
  know_findings_free(&d->found);
  know_free(&d->k);
  vs_free(d->scheme);
  *d = (cli_draft){ 0 };
}
