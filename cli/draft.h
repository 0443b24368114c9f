/* Declares the analysis of a text while the user changes it in an editor: its names and its findings, or its first
 * error. */
#ifndef VS_CLI_DRAFT_H
#define VS_CLI_DRAFT_H

#include "languages/checks/checks.h"

typedef struct {
  knowledge k;
  know_findings found;
  vs_scheme *scheme;
  bool known;         /* whether the text was read and analysed; if not, the members message and at describe the first
                       * error */
  const char *path;   /* path of the file that the text replaces */
  know_place at;
  char message[400];
} cli_draft;

/* Analyses the text, which replaces that of the file at `path`. The text remains the caller's. Returns false when
 * memory is out. The caller calls cli_draft_free in any case, and does not move *d before. */
bool cli_draft_read(cli_draft *d, const vs_options *interpreter, const char *path, const char *text, size_t length);
void cli_draft_free(cli_draft *d);

#endif
