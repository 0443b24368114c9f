/* Implements the commands that analyse a program without running it. All of them use one analysis of the file. */
#include "cli/study.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/batch/translate_foreign.h"
#include "cli/batch/whole_file.h"
#include "cli/draft.h"
#include "cli/messages.h"
#include "languages/checks/checks.h"
#include "languages/analysis/first_calls.h"
#include "languages/site/site.h"
#include "languages/analysis/source_tree.h"
#include "languages/translate/translate.h"
#include "languages/analysis/tree_report.h"
#include "languages/analysis/resolve_names.h"

enum { CHECK_SECONDS = 5 };
typedef struct { knowledge k; cli_reporter reporter; vs_scheme *scheme; } study;

/* Receives messages of the interpreter. If muted, as while the analysis queries the interpreter, stores only the first
 * error. */
static void diagnose(void *context, const vs_diagnostic *d) {
  study *s = context;
  if (s->k.reading && !d->at.line) return;
  if (s->k.reading && d->severity == VS_SEVERITY_ERROR) s->k.unreadable = true;
  if (!s->k.muted) cli_report_diagnostic(&s->reporter, d);
  else know_hear(&s->k, d);
}

static vs_outcome tell(study *s, const cli_options *o) {
  bool ok = true;
  if (o->json || o->xml) ok = know_report_tree(&s->k, stdout, o->json ? KNOW_JSON : KNOW_XML);
  else know_report_outline(&s->k, stdout);
  if (!ok) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  return VS_OUTCOME_DONE;
}

/* Prints the faults found in the program. Returns exit status 1 if there are any. */
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

/* ---- checking a text in an editor ---- */

static void report_unreadable(const cli_draft *t, FILE *to) {
  know_writer w;
  know_write_start(&w, to, KNOW_JSON, "findings");
  know_write_list(&w, "findings");
  know_write_item(&w, "finding");
  know_write_word(&w, "type", "unreadable");
  know_write_number(&w, "line", t->at.line);
  know_write_number(&w, "column", t->at.column);
  know_write_number(&w, "end_line", t->at.end_line);
  know_write_number(&w, "end_column", t->at.end_column);
  know_write_word(&w, "details", t->message);
  know_write_item_end(&w, "finding");
  know_write_list_end(&w, "findings");
  know_write_end(&w, "findings");
}

bool cli_study_check_text(const vs_options *interpreter, const char *path, const char *text, size_t length, FILE *to) {
  cli_draft t = {0};
  know_findings none = {0};
  if (!know_reads(path)) return know_report_findings_json(&none, to), true;
  bool ok = cli_draft_read(&t, interpreter, path, text, length);
  if (t.known) know_report_findings_json(&t.found, to);
  else if (ok) report_unreadable(&t, to);
  cli_draft_free(&t);
  return ok;
}

/* ---- pages of vs doc ---- */

enum { PICTURE_SECONDS = 20 /* PICTURE_SECONDS: time limit in seconds for a picture of the program or of one of its
                             * procedures */ };
typedef struct {
  const cli_options *options;
  const knowledge *k;
  vs_scheme *scheme;
  bool failed, worker_missing;
} painter;

/* Ignores messages of a procedure that is called to see whether it returns an object. */
static void ignore(void *context, const vs_diagnostic *d) { (void)context, (void)d; }

static bool begin_model(painter *p) {
  const cli_options *o = p->options;
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){.diagnose = ignore};
  if (interpreter.limit_time <= 0) interpreter.limit_time = PICTURE_SECONDS;
  vs_free(p->scheme);
  p->scheme = vs_new(&interpreter);
  bool ok = p->scheme != NULL;
  for (size_t i = 0; ok && i < o->define_count; i++) {
    char name[200];
    const char *equals = strchr(o->defines[i], '=');
    snprintf(name, sizeof name, "%.*s", (int)(equals - o->defines[i]), o->defines[i]);
    ok = vs_parameter_set(p->scheme, name, equals + 1);
  }
  return ok;
}

/* Runs the program in a form that records the first result of each procedure. If this fails, runs the unchanged
 * program. */
static bool run_model(painter *p) {
  const char *path = p->options->sources[0].text;
  size_t length = 0;
  char *text = know_remembering(p->k, &length);
  bool ok = text && begin_model(p) && vs_eval_text(p->scheme, path, 1, text, length, VS_EVAL_PASS) == VS_OUTCOME_DONE;
  free(text);
  return ok || (begin_model(p) && vs_eval_file(p->scheme, path, VS_EVAL_PASS) == VS_OUTCOME_DONE);
}

/* Makes a picture of the complete model, or of the value of an expression, in the file `path`. */
static bool paint(void *context, const char *expression, const char *path) {
  painter *p = context;
  if (p->failed || p->worker_missing) return false;
  if (!p->scheme && !run_model(p)) {
    p->failed = true;
    fprintf(stderr, "vs doc: %s does not run: the pages have no pictures\n", p->options->sources[0].text);
    return false;
  }
  vs_output_options o = p->options->output;
  o.quality = expression ? VS_QUALITY_DRAFT : o.quality;
  if (expression || !o.width) o.width = expression ? 480 : 960, o.height = expression ? 360 : 640;
  if (expression) {
    char text[2100];
    int n = snprintf(text, sizeof text, "(zoom-extents) (draw %s)", expression);
    vs_drawing_clear(p->scheme);
    if (n >= (int)sizeof text ||
        vs_eval_text(p->scheme, p->options->sources[0].text, 1, text, (size_t)n, VS_EVAL_PASS) != VS_OUTCOME_DONE)
      return false;
    o.has_camera = false, o.view = NULL;
  }
  vs_summary summary;
  if (vs_drawing_summary(p->scheme, &summary) != VS_OUTCOME_DONE || !summary.has_bounds) return false;
  vs_outcome outcome = vs_write_drawing(p->scheme, path, "png", &o);
  if (outcome == VS_OUTCOME_WORKER && !p->worker_missing) {
    p->worker_missing = true;
    fputs("vs doc: POV-Ray is missing or failed: the pages have no more pictures\n", stderr);
  }
  return outcome == VS_OUTCOME_DONE;
}

static vs_outcome no_folder(const char *path) {
  fprintf(stderr, "vs doc: %s: %s\n", path, strerror(errno));
  return VS_OUTCOME_USAGE;
}

static bool make_folder(const char *path) {
  struct stat status;
  if (mkdir(path, 0777) == 0) return true;
  if (errno != EEXIST || stat(path, &status) != 0) return false;
  errno = ENOTDIR;
  return S_ISDIR(status.st_mode);
}

static vs_outcome document(study *s, const cli_options *o) {
  const char *folder = o->targets[0].path, *file = o->sources[0].text, *slash = strrchr(file, '/');
  char pictures[4096], title[200];
  painter p = {.options = o, .k = &s->k};
  int n = snprintf(pictures, sizeof pictures, "%s/pictures", folder);
  if (n < 0 || n >= (int)sizeof pictures) return errno = ENAMETOOLONG, no_folder(folder);
  if (!make_folder(folder)) return no_folder(folder);
  if (!make_folder(pictures)) return no_folder(pictures);
  snprintf(title, sizeof title, "%s", slash ? slash + 1 : file);
  if (strlen(title) > 3 && !strcmp(title + strlen(title) - 3, ".vs")) title[strlen(title) - 3] = 0;
  bool ok = know_write_site(&s->k, folder, title, paint, &p);
  vs_free(p.scheme);
  if (ok) return VS_OUTCOME_DONE;
  fprintf(stderr, "vs doc: %s\n", s->k.trouble);
  return s->k.outcome;
}

/* ---- translating a program ---- */

static void unable(void *context, const know_place *at, const char *text) {
  study *s = context;
  const know_file *f = &s->k.files[at->file];
  size_t from = at->from;
  while (from && f->text[from - 1] != '\n') from--;
  const char *line = know_text(&s->k, f->text + from, strcspn(f->text + from, "\n"));
  vs_diagnostic d = {.severity = VS_SEVERITY_ERROR, .outcome = VS_OUTCOME_MODEL, .message = text, .source_line = line,
    .at = {.file = f->path, .line = at->line, .column = at->column, .end_line = at->end_line,
           .end_column = at->end_column}};
  cli_report_diagnostic(&s->reporter, &d);
}

/* Writes a file that appears only when it is complete. */
static bool write_whole(const char *path, const char *text, size_t length) {
  if (!path || !strcmp(path, "-")) return fwrite(text, 1, length, stdout) == length;
  cli_whole_file file;
  FILE *to = cli_whole_begin(&file, path);
  return cli_whole_end(&file, to && fwrite(text, 1, length, to) == length);
}

enum { FACETS = 64 /* number of facets in a full turn if --segments is not given */ };

static vs_outcome translate(study *s, const cli_options *o) {
  const char *path = o->target_count ? o->targets[0].path : NULL, *language = know_language(o->language, path);
  unsigned segments = o->output.segments > 0 ? (unsigned)o->output.segments : FACETS;
  size_t length = 0;
  know_setting *settings = calloc(o->define_count + 1, sizeof *settings);
  if (!settings) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  for (size_t i = 0; i < o->define_count; i++) {
    const char *equals = strchr(o->defines[i], '=');
    settings[i] = (know_setting){know_text(&s->k, o->defines[i], (size_t)(equals - o->defines[i])), equals + 1};
  }
  const know_translation wanted = {.language = language, .segments = segments, .settings = settings,
                                   .setting_count = o->define_count, .complain = unable, .context = s};
  char *text = know_translate(&s->k, &wanted, &length);
  free(settings);
  if (!text) {
    if (*s->k.trouble) fprintf(stderr, "%s%s\n", strchr(s->k.trouble, ':') ? "" : "vs translate: ", s->k.trouble);
    return s->k.outcome;
  }
  if (path && strcmp(path, "-") != 0 && vs_is_input(s->scheme, path)) {
    fprintf(stderr, "vs translate: %s: it is the program to translate; -o names another file\n", path);
    return free(text), VS_OUTCOME_USAGE;
  }
  bool ok = write_whole(path, text, length);
  if (!ok) fprintf(stderr, "vs translate: %s: %s\n", path ? path : "standard output", strerror(errno));
  free(text);
  return ok ? VS_OUTCOME_DONE : VS_OUTCOME_USAGE;
}

/* Returns true if the option --to names a known language. Otherwise prints a message on standard error. */
static bool has_language(const cli_options *o) {
  const char *path = o->target_count ? o->targets[0].path : NULL;
  if (o->command != CLI_COMMAND_translate || know_language(o->language, path)) return true;
  if (o->language) fprintf(stderr, "vs translate: --to %s: there is no such language;", o->language);
  else fputs("vs translate: name the language by --to, or by the ending of -o;", stderr);
  fprintf(stderr, " there are%s\n", know_languages());
  return false;
}

vs_outcome cli_study(const cli_options *o) {
  if (cli_translates_foreign(o)) return cli_translate_foreign(o);
  if (!has_language(o)) return VS_OUTCOME_USAGE;
  study s = {0};
  vs_options interpreter = o->interpreter;
  if (!know_reads(o->sources[0].text)) {
    fprintf(stderr, "vs: %s is in %s: it can be run, but only programs in Scheme and JavaScript are %s\n",
        o->sources[0].text, vs_language_of(o->sources[0].text),
        o->command == CLI_COMMAND_translate ? "translated" : "looked into");
    return VS_OUTCOME_USAGE;
  }
  interpreter.host = (vs_host){.context = &s, .diagnose = diagnose};
  if (o->command == CLI_COMMAND_check && interpreter.limit_time <= 0) interpreter.limit_time = CHECK_SECONDS;
  vs_scheme *scheme = vs_new(&interpreter);
  if (!scheme) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  vs_outcome outcome = VS_OUTCOME_DONE;
  s.scheme = scheme;
  bool read = know_read(&s.k, scheme, o->sources[0].text, o->library_path);
  for (size_t i = 0; i < s.k.file_count; i++) vs_note_input(scheme, s.k.files[i].path);
  if (read)
    outcome = o->command == CLI_COMMAND_check       ? check(&s, o)
              : o->command == CLI_COMMAND_doc       ? document(&s, o)
              : o->command == CLI_COMMAND_translate ? translate(&s, o)
                                                    : tell(&s, o);
  else {
    outcome = s.k.outcome;
    if (!s.reporter.errors) fprintf(stderr, "%s%s\n", strchr(s.k.trouble, ':') ? "" : "vs: ", s.k.trouble);
  }
  know_free(&s.k);
  vs_free(scheme);
  return outcome;
}
