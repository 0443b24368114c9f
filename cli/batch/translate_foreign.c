/* Implements the translation of programs in OpenSCAD to Scheme. */
#include "cli/batch/translate_foreign.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/batch/whole_file.h"
#include "cli/messages.h"
#include "languages/format/format_program.h"
#include "model/store/array.h"

typedef struct { cli_reporter reporter; char *text; size_t length, room; } translation;

static bool ends(const char *name, const char *ending) {
  size_t n = strlen(name), m = strlen(ending);
  return n > m && !strcmp(name + n - m, ending);
}

bool cli_translates_foreign(const cli_options *o) {
  const char *path = o->target_count ? o->targets[0].path : NULL;
  bool scheme = o->language ? !strcmp(o->language, "scheme") : path && (ends(path, ".vs") || ends(path, ".scm"));
  return o->command == CLI_COMMAND_translate && o->source_count == 1 && ends(o->sources[0].text, ".scad") && scheme;
}

static void diagnose(void *context, const vs_diagnostic *d) {
  translation *t = context;
  cli_report_diagnostic(&t->reporter, d);
}

static bool append(void *context, const char *text, size_t length) {
  translation *t = context;
  if (!VS_GROW(t->text, t->room, t->length + length)) return false;
  memcpy(t->text + t->length, text, length);
  t->length += length;
  return true;
}

static vs_outcome write_program(const cli_options *o, const translation *t) {
  const char *path = o->target_count ? o->targets[0].path : NULL;
  size_t length = 0;
  char *text = format_program(t->text ? t->text : "", t->length, &length);
  if (!text) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  bool done;
  if (!path || !strcmp(path, "-")) {
    done = fwrite(text, 1, length, stdout) == length;
  } else {
    cli_whole_file file;
    FILE *to = cli_whole_begin(&file, path);
    done = cli_whole_end(&file, to && fwrite(text, 1, length, to) == length);
  }
  if (!done) fprintf(stderr, "vs translate: %s: %s\n", path ? path : "standard output", strerror(errno));
  free(text);
  return done ? VS_OUTCOME_DONE : VS_OUTCOME_USAGE;
}

vs_outcome cli_translate_foreign(const cli_options *o) {
  static const char asked[] = "(import (openscad compiler)) (scad-translate!)";
  translation t = { 0 };
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){ .context = &t, .diagnose = diagnose, .output = append };
  vs_scheme *scheme = vs_new(&interpreter);
  if (!scheme) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  vs_outcome outcome = vs_eval_text(scheme, "translate", 1, asked, sizeof asked - 1, 0);
  if (outcome == VS_OUTCOME_DONE) outcome = vs_eval_file(scheme, o->sources[0].text, 0);
  if (outcome == VS_OUTCOME_DONE) outcome = write_program(o, &t);
  free(t.text);
  vs_free(scheme);
  return outcome;
}
