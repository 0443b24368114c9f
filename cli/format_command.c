/* Implements `vs format FILE...`: changes blanks and line breaks of each file to one style, and keeps its tokens. A
 * file is replaced only by a complete text, and only if the text changes. */
#define _GNU_SOURCE
#include "cli/format_command.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/messages.h"
#include "languages/analysis/source_tree.h"
#include "languages/format/format_program.h"

typedef struct { knowledge k; cli_reporter reporter; } formatting;

/* Receives messages of the reader. A message with line 0 has no place in the file (know_readable). */
static void diagnose(void *context, const vs_diagnostic *d) {
  formatting *f = context;
  if (f->k.reading && !d->at.line) return;
  if (d->severity == VS_SEVERITY_ERROR) f->k.unreadable = true;
  cli_report_diagnostic(&f->reporter, d);
}

/* Replaces the file's text: writes a new file beside it, which then gets the old file's name and permissions. A
 * symbolic link stays, and the file to which it leads is replaced. Returns false with errno on failure; the file is
 * then unchanged. */
static bool replace(const char *path, const char *text, size_t length) {
  struct stat status;
  char *file = realpath(path, NULL), *part = NULL;
  int to = -1;
  if (file && asprintf(&part, "%s.XXXXXX", file) < 0) part = NULL;
  bool ok = part && stat(file, &status) == 0 && access(file, W_OK) == 0 && (to = mkstemp(part)) >= 0;
  FILE *stream = ok ? fdopen(to, "wb") : NULL;
  if (stream) {
    ok = fwrite(text, 1, length, stream) == length && fflush(stream) == 0;
    ok = ok && fchmod(to, status.st_mode & 07777) == 0 && fsync(to) == 0;
    ok = fclose(stream) == 0 && ok && rename(part, file) == 0;
  } else {
    if (to >= 0) close(to);
    ok = false;
  }
  int why = errno;
  if (!ok && to >= 0) unlink(part);
  free(part);
  free(file);
  errno = why;
  return ok;
}

/* Formats the text of a file that the reader has accepted, and writes the result if it differs. */
static vs_outcome write_formatted(const cli_options *o, const char *path, const char *text, size_t length) {
  size_t formatted;
  char *anew = format_program(text, length, &formatted);
  bool standard = strcmp(path, "-") == 0, ok = true;
  if (!anew) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  bool equal = formatted == length && memcmp(anew, text, length) == 0;
  if (o->check && !equal) printf("%s\n", standard ? "standard-input" : path);
  if (!o->check && standard) fwrite(anew, 1, formatted, stdout);
  if (!o->check && !standard && !equal) ok = replace(path, anew, formatted);
  if (!ok) fprintf(stderr, "vs format: %s: %s\n", path, strerror(errno));
  free(anew);
  return !ok ? VS_OUTCOME_USAGE : o->check && !equal ? VS_OUTCOME_MODEL : VS_OUTCOME_DONE;
}

static vs_outcome format_file(const cli_options *o, const char *path) {
  formatting f = { 0 };
  const char *language = vs_language_of(path);
  bool standard = strcmp(path, "-") == 0;
  if (language && !standard) {
    fprintf(stderr, "vs format: %s is in %s: only programs in Scheme are formatted\n", path, language);
    return VS_OUTCOME_USAGE;
  }
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){ .context = &f, .diagnose = diagnose };
  vs_scheme *scheme = vs_new(&interpreter);
  if (!scheme) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  size_t length = 0;
  char *text = NULL;
  vs_outcome outcome = VS_OUTCOME_DONE;
  if (know_open(&f.k)) {
    f.k.scheme = scheme;
    text = know_file_text(&f.k, path, &length);
  }
  if (text && know_readable(&f.k, standard ? "standard-input" : path, text, length))
    outcome = write_formatted(o, path, text, length);
  else {
    outcome = f.k.outcome;
    if (!f.reporter.errors) fprintf(stderr, "vs format: %s\n", f.k.trouble);
  }
  free(text);
  know_free(&f.k);
  vs_free(scheme);
  return outcome;
}

vs_outcome cli_format_command(const cli_options *o) {
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t i = 0; i < o->source_count; i++) {
    vs_outcome one = format_file(o, o->sources[i].text);
    if (outcome == VS_OUTCOME_DONE) outcome = one;
  }
  return outcome;
}
