/* Owns the commands that read a program without running it: what they share is one analysis of one file. */
#include "cli/study.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "cli/messages.h"
#include "knowledge/checks.h"
#include "knowledge/tree_report.h"

typedef struct { knowledge k; cli_reporter reporter; } study;

/* While the analysis asks the interpreter something, what the answer says is its own business. */
static void diagnose(void *context, const vs_diagnostic *d) {
  study *s = context;
  if (s->k.reading && !d->at.line) return;
  if (s->k.reading && d->severity == VS_SEVERITY_ERROR) s->k.unreadable = true;
  if (!s->k.muted) cli_report_diagnostic(&s->reporter, d);
  else if (!*s->k.heard && d->severity == VS_SEVERITY_ERROR) snprintf(s->k.heard, sizeof s->k.heard, "%s", d->message);
}

static vs_outcome tell(study *s, const cli_options *o) {
  bool ok = true;
  if (o->json || o->xml) ok = know_report_tree(&s->k, stdout, o->json ? KNOW_JSON : KNOW_XML);
  else know_report_outline(&s->k, stdout);
  if (!ok) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  return VS_OUTCOME_DONE;
}

/* Findings are the model's: exit code 1. */
static vs_outcome check(study *s, const cli_options *o) {
  know_findings found;
  vs_outcome outcome = VS_OUTCOME_DONE;
  if (know_check_program(&s->k, &found)) {
    if (o->json) know_report_findings_json(&found, stdout);
    else know_report_findings(&found, stdout);
    if (found.count) outcome = VS_OUTCOME_MODEL;
  } else fprintf(stderr, "vs: %s\n", s->k.trouble), outcome = s->k.outcome;
  know_findings_free(&found);
  return outcome;
}

vs_outcome cli_study(const cli_options *o) {
  study s = {0};
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){.context = &s, .diagnose = diagnose};
  vs_scheme *scheme = vs_new(&interpreter);
  if (!scheme) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  vs_outcome outcome = VS_OUTCOME_DONE;
  if (know_read(&s.k, scheme, o->sources[0].text, o->library_path)) outcome = o->command == CLI_COMMAND_check ? check(&s, o) :
      tell(&s, o);
  else {
    outcome = s.k.outcome;
    if (!s.reporter.errors) fprintf(stderr, "%s%s\n", strchr(s.k.trouble, ':') ? "" : "vs: ", s.k.trouble);
  }
  know_free(&s.k);
  vs_free(scheme);
  if (fflush(stdout) != 0) {
    fprintf(stderr, "vs: standard output: %s\n", strerror(errno));
    if (outcome == VS_OUTCOME_DONE) outcome = VS_OUTCOME_USAGE;
  }
  return outcome;
}
