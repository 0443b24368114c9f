/* Declares the analysis of a text that an editor changes: its names and its findings, or its first error. */
#ifndef VS_CLI_DRAFT_H
#define VS_CLI_DRAFT_H

#include "languages/checks/checks.h"

typedef struct {
  knowledge k;
  know_findings found;
  vs_scheme *scheme;
  bool known;         /* whether the text was read and analysed; if not, message and at describe the first error */
  const char *path;   /* the text's file */
  know_place at;
  char message[400];
} cli_draft;

/* Analyses the text, which replaces that of the file. It stays the caller's. Returns false when memory is out. The
 * caller calls cli_draft_free in any case, and keeps *d at its place until then. */
bool cli_draft_read(cli_draft *d, const vs_options *interpreter, const char *path, const char *text, size_t length);
void cli_draft_free(cli_draft *d);

#endif
