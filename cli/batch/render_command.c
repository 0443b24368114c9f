/* Implements `vs render`: makes one picture for each model, set of parameters, view and frame, and films of the frames.
 *
 * The manifest is a file that lists the pictures of the last run. A picture is up to date if the manifest has the
 * present hashes of its scene, options and file. The scene is the text of the .pov file. `vs render` therefore notices
 * every change of a file that changes the picture, and ignores all others. Each picture is made by a separate process
 * of this program, so that a model that fails affects no other. `--jobs` processes run at a time. */
#define _GNU_SOURCE
#include "cli/batch/render_command.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cli/batch/film.h"
#include "cli/batch/inputs_told.h"
#include "cli/batch/part_files.h"
#include "cli/batch/part_states.h"
#include "cli/batch/ranges.h"
#include "cli/batch/whole_file.h"
#include "cli/json.h"
#include "cli/usage/output_files.h"

enum { PATH_ROOM = 4096, MOST = 100000, EXPOSURE_ROOM = 24 };

typedef enum { MADE, STANDS, FAILED, NOT_TRIED } fate;
typedef struct {
  uint64_t model;          /* hash of the options and of the model's scene, before the exposure is set */
  uint64_t scene;          /* hash of options, scene and exposure */
  uint64_t bytes;
  double seconds;
  int code;
  fate fate;
} result;
typedef struct {
  const char *model;
  char *set, *view, *file; /* set: parameters as "a=1,b=2", or NULL; view: name, or NULL for the model's default view */
  const char *given;       /* the part of `set` that comes from --set (NULL: none); the rest is the parameter of
                            * --frames */
  char exposure[EXPOSURE_ROOM]; /* exposure in stops for all frames of a film; empty: the exposure in the options */
  uint64_t metered;        /* hash of the scene of the film's first frame, from which the exposure was computed */
  long pair;               /* number of the model with its set, from 1 */
  long frame;              /* number of the frame from 1, or 0 without --frames; the frames of a film are consecutive in
                            * the batch */
  size_t tile;             /* number of the tile from 1, top first, or 0: the file is the whole picture */
  char *whole;             /* in the first tile of a picture: the file into which its tiles are joined; otherwise
                            * NULL */
  char crop[48];           /* the value of --crop for a tile */
  pid_t process;
  int told;                /* descriptor from which the picture's process is read: the reading end of a pipe */
  bool known, failed;      /* known: the model has run, and result.model is set; failed: its run has failed, and no
                            * message was printed yet */
  const char *kept; size_t kept_length; /* line of an earlier manifest with the result, or NULL; in batch.manifest */
  result result;
} picture;
typedef struct {
  const cli_options *options;
  const volatile sig_atomic_t *ended; /* not 0 after a signal that ends the run; child processes receive the signal,
                                       * too */
  picture *at;
  size_t count, room;
  char *manifest, program[PATH_ROOM];
  char threads[24];           /* number of processors for each picture, as text, if several are made at a time; empty:
                               * all */
  const char *manifest_path;  /* path of the manifest, or NULL */
  const char *whole_path;     /* path of the manifest of all pictures; with --only, manifest_path is another */
  int lock, shared;           /* descriptors of the locked manifests, or -1. shared: with --only, that of all
                               * pictures */
  bool manifest_made;         /* whether this run has created the manifest, empty, to lock it */
  bool unwritten;             /* whether writing the manifest failed, and this was reported */
  int told;                   /* descriptor of the file for the names of files read by the runs, or -1 */
  vs_outcome failed;          /* outcome of the first model whose views could not be listed, otherwise
                               * VS_OUTCOME_DONE */
  vs_scheme *inputs;          /* an interpreter that records the files that models have read, which no output may
                               * replace */
} batch;

static bool no_memory(void) { return fputs("vs: out of memory\n", stderr), false; }

/* ---- the list of pictures ---- */

static bool add_picture(batch *b, const char *model, const char *set, const char *view, long frame, const char *file) {
  if (b->count == b->room) {
    size_t room = 2 * b->room + 16;
    picture *more = room <= MOST ? reallocarray(b->at, room, sizeof *more) : NULL;
    if (!more) return no_memory();
    b->at = more, b->room = room;
  }
  for (size_t i = 0; i < b->count; i++)
    if (!strcmp(b->at[i].file, file)) {
      fprintf(stderr,
              "vs render: %s would be the picture of two models: rename a model, or write its pictures into another "
              "folder\n",
              file);
      return false;
    }
  picture p = {.model = model, .set = set ? strdup(set) : NULL, .told = -1, .view = view ? strdup(view) : NULL,
               .file = strdup(file), .frame = frame, .result = {.fate = NOT_TRIED}};
  if (!p.file || (view && !p.view) || (set && !p.set)) return free(p.file), free(p.view), free(p.set), no_memory();
  b->at[b->count++] = p;
  return true;
}

/* Returns true if -o names a folder: it ends in a slash, has no ending, is a folder, or there are several models. */
static bool is_folder(const cli_options *o, const char *out) {
  struct stat is;
  return o->source_count > 1 || out[strlen(out) - 1] == '/' || !cli_ending_of(out) ||
         (stat(out, &is) == 0 && S_ISDIR(is.st_mode));
}

/* Writes the name of a picture: FOLDER/model-set-view-frame.png for a folder or for FOLDER/%.png,
 * a-set-view-frame.png for a file a.png. Returns false, after a message, if it is too long. */
static bool name_picture(const batch *b, const char *model, size_t set, const char *view, long frame,
                         char name[PATH_ROOM]) {
  const cli_options *o = b->options;
  const char *out = o->target_count ? o->targets[0].path : NULL, *ending = ".png";
  size_t length = out ? strlen(out) : 0;
  bool each = out && cli_options_is_pattern(out);
  bool folder = out && !each && is_folder(o, out);
  *name = 0;
  if (folder) {
    snprintf(name, PATH_ROOM - 200, "%s%s", out, out[length - 1] == '/' ? "" : "/");
    cli_part_put_word(name, PATH_ROOM - 200, model, true);
  } else if (each) {
    const char *slash = strrchr(out, '/'), *dot = strrchr(out, '.'), *percent = slash ? slash + 1 : out;
    ending = dot > percent ? dot : "";
    snprintf(name, PATH_ROOM - 400, "%.*s", (int)(percent - out), out);
    cli_part_put_word(name, PATH_ROOM - 300, model, true);
    size_t rest = strlen(percent + 1) - strlen(ending), used = strlen(name);
    snprintf(name + used, PATH_ROOM - 200 - used, "%.*s", (int)rest, percent + 1);
  } else if (out) {
    const char *slash = strrchr(out, '/'), *dot = strrchr(out, '.');
    if (dot && (!slash || dot > slash)) ending = dot;
    snprintf(name, PATH_ROOM - 200, "%.*s", (int)(dot && (!slash || dot > slash) ? dot - out : (ptrdiff_t)length), out);
  } else { /* without the option -o, the picture is written beside the model */
    const char *slash = strrchr(model, '/'), *dot = strrchr(model, '.');
    snprintf(name, PATH_ROOM - 200, "%.*s", (int)(dot && (!slash || dot > slash) ? dot - model
                                                                                  : (ptrdiff_t)strlen(model)), model);
  }
  if (o->set_count) {
    snprintf(name + strlen(name), PATH_ROOM - strlen(name), "-");
    cli_part_put_set(name, PATH_ROOM - 100, o->sets[set]);
  }
  if (view) {
    snprintf(name + strlen(name), PATH_ROOM - strlen(name), "-");
    cli_part_put_word(name, PATH_ROOM - 60, view, false);
  }
  if (frame) {
    char number[CLI_FRAME_ROOM];
    cli_frame_number(&o->frames, frame, number);
    snprintf(name + strlen(name), PATH_ROOM - strlen(name), "-%s", number);
  }
  if (strlen(name) + strlen(ending) + 1 >= PATH_ROOM)
    return fprintf(stderr, "vs render: %s: the name is too long\n", model), false;
  strcat(name, ending);
  return true;
}

static void say(void *context, const vs_diagnostic *d) {
  if (d->severity == VS_SEVERITY_ERROR)
    fprintf(stderr, "%s:%u:%u: %s\n", d->at.file ? d->at.file : (const char *)context, d->at.line, d->at.column,
            d->message);
}

/* Adds the tiles of the picture with this file name. They are consecutive in the batch. Each has some rows in the whole
 * width, because POV-Ray gathers bounced light along rows, and draws whole rows even for a part of them. */
static bool add_tiles(batch *b, const char *model, const char *set, const char *view, const char *file) {
  const cli_options *o = b->options;
  const cli_tiles *t = &o->tiles;
  const char *ending = strrchr(file, '.');
  char name[PATH_ROOM], number[24];
  long count = t->columns * t->rows;
  int w = o->output.width, h = o->output.height;
  int digits = snprintf(number, sizeof number, "%ld", count);
  for (long i = t->from; i <= t->to; i++) {
    int top = vs_picture_tile_top(w, h, (int)count, (int)i - 1), end = vs_picture_tile_top(w, h, (int)count, (int)i);
    int n = snprintf(name, sizeof name, "%.*s-tile-%0*ld%s", (int)(ending - file), file, digits < 2 ? 2 : digits, i,
                     ending);
    if (n < 0 || n >= PATH_ROOM) return fprintf(stderr, "vs render: %s: the name is too long\n", file), false;
    if (!add_picture(b, model, set, view, 0, name)) return false;
    picture *p = &b->at[b->count - 1];
    p->tile = (size_t)i;
    snprintf(p->crop, sizeof p->crop, "0,%d,%d,%d", top, w, end - top);
    if (i == 1 && !(p->whole = strdup(file))) return no_memory();
  }
  return true;
}

/* Returns the frame's set of parameters, which the caller frees: `given`, and the parameter of the frame. NULL when
 * memory is out. */
static char *set_of_frame(const cli_frames *f, long frame, const char *given) {
  char value[CLI_FRAME_ROOM], *set = NULL;
  cli_frame_value(f, frame, value);
  return asprintf(&set, "%s%s%s=%s", given ? given : "", given ? "," : "", f->parameter, value) < 0 ? NULL : set;
}

/* Adds a picture to the batch. With --frames, adds a picture for each frame, whose parameter is appended to the set. */
static bool add_frames(batch *b, const char *model, size_t set, const char *view) {
  const cli_options *o = b->options;
  const char *given = o->set_count ? o->sets[set] : NULL;
  char name[PATH_ROOM];
  bool ok = true;
  for (long frame = o->frames.from; ok && frame <= o->frames.to; frame++) {
    char *with = frame ? set_of_frame(&o->frames, frame, given) : NULL;
    if (frame && !with) return no_memory();
    size_t from = b->count;
    ok = name_picture(b, model, set, view, frame, name) &&
         (o->tiles.columns ? add_tiles(b, model, given, view, name)
                           : add_picture(b, model, frame ? with : given, view, frame, name));
    for (; ok && from < b->count; from++) b->at[from].given = given;
    free(with);
  }
  return ok;
}

/* Adds the pictures of a model. With --all-views, first runs the model for the names of its views. If this run fails,
 * stores the first such outcome in b and continues. Returns false, after a message, if a picture cannot be named. */
static bool add_model(batch *b, const char *model, size_t set) {
  const cli_options *o = b->options;
  const char *view;
  if (!o->all_views) return add_frames(b, model, set, o->output.view);
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){.context = (void *)(uintptr_t)model, .diagnose = say};
  vs_scheme *s = vs_new(&interpreter);
  vs_outcome outcome = s ? vs_eval_file(s, model, VS_EVAL_PASS) : VS_OUTCOME_MACHINE;
  size_t i = 0;
  bool ok = true;
  for (; ok && outcome == VS_OUTCOME_DONE && (view = vs_view_name(s, i)) != NULL; i++)
    ok = add_frames(b, model, set, view);
  if (ok && outcome == VS_OUTCOME_DONE && i == 0) ok = add_frames(b, model, set, NULL);
  for (i = 0; s && (view = vs_input_name(s, i)) != NULL; i++) vs_note_input(b->inputs, view);
  vs_free(s);
  if (outcome == VS_OUTCOME_DONE) return ok;
  if (!o->quiet) printf("%s: failed\n", model), fflush(stdout);
  if (b->failed == VS_OUTCOME_DONE) b->failed = outcome;
  return true;
}

/* ---- the manifest of the last run ---- */

static char *read_text(const char *path) {
  FILE *f = fopen(path, "rb");
  char *text = NULL;
  size_t room = 0;
  if (f && getdelim(&text, &room, 0, f) < 0) free(text), text = NULL;
  if (f) fclose(f);
  return text;
}

/* Returns the next line about the picture after `after` (NULL: the first) in the manifests of the last runs, without
 * comma and line end, or NULL. write_manifest writes one line for each picture. If the manifest has another form,
 * pictures are just made again. */
static const char *next_line_of(const batch *b, const picture *p, const char *after, size_t *length) {
  char *key = NULL;
  size_t size = 0;
  FILE *to = b->manifest ? open_memstream(&key, &size) : NULL;
  if (!to) return NULL;
  fputs("{\"file\": ", to);
  cli_json_text(to, p->file);
  fputs(", ", to);
  const char *line = fclose(to) == 0 ? strstr(after ? after + 1 : b->manifest, key) : NULL;
  free(key);
  *length = line ? strcspn(line, "\n") : 0;
  if (*length > 0 && line[*length - 1] == ',') --*length;
  return line;
}

static const char *line_of(const batch *b, const picture *p, size_t *length) {
  return next_line_of(b, p, NULL, length);
}

/* Gives the picture the result of an earlier run that a manifest lists: made, if the file has not changed since, or
 * failed. Returns false if there is none. */
static bool recall_result(const batch *b, picture *p) {
  static const char failed[] = "\"outcome\": \"failed\"", code[] = "\"code\": ";
  char wanted[40];
  uint64_t bytes;
  size_t length;
  const char *of_failed = NULL;
  bool there = cli_part_hash_file(p->file, &bytes);
  snprintf(wanted, sizeof wanted, "\"hash\": \"%016" PRIx64 "\"", bytes);
  for (const char *line = line_of(b, p, &length); line; line = next_line_of(b, p, line, &length)) {
    const char *hash = there ? memmem(line, length, wanted, strlen(wanted)) : NULL;
    bool fails = memmem(line, length, failed, strlen(failed)) != NULL;
    if (hash && !fails) return p->kept = line, p->kept_length = length, p->result.fate = STANDS, true;
    if (fails) of_failed = line, p->kept_length = length;
  }
  if (!of_failed) return false;
  const char *at = memmem(of_failed, p->kept_length, code, strlen(code));
  p->kept = of_failed, p->result.fate = FAILED;
  p->result.code = at ? atoi(at + strlen(code)) : VS_OUTCOME_MODEL;
  return true;
}

/* Returns true if a manifest lists the picture with this scene, and its file still has the listed hash. */
static bool is_up_to_date(const batch *b, const picture *p, uint64_t scene) {
  char wanted[80];
  uint64_t bytes;
  size_t length;
  const char *line = line_of(b, p, &length);
  if (!line || !cli_part_hash_file(p->file, &bytes)) return false;
  snprintf(wanted, sizeof wanted, "\"scene\": \"%016" PRIx64 "\", \"hash\": \"%016" PRIx64 "\"", scene, bytes);
  for (; line; line = next_line_of(b, p, line, &length)) {
    const char *found = strstr(line, wanted);
    if (found && found < line + length) return true;
  }
  return false;
}

static void manifest_picture(FILE *to, const picture *p) {
  static const char *const fates[] = {"made", "up to date", "failed", "not tried"};
  fputs("{\"file\": ", to);
  cli_json_text(to, p->file);
  fputs(", \"model\": ", to);
  cli_json_text(to, p->model);
  fputs(", \"view\": ", to);
  if (p->view) cli_json_text(to, p->view);
  else fputs("null", to);
  fprintf(to, ", \"part\": %ld", p->frame ? p->frame : p->tile ? (long)p->tile : p->pair);
  if (p->tile) fprintf(to, ", \"crop\": \"%s\"", p->crop);
  fputs(", \"parameters\": ", to);
  if (p->set) cli_json_text(to, p->set);
  else fputs("null", to);
  if (*p->exposure)
    fprintf(to, ", \"exposure\": %s, \"metered\": \"%016" PRIx64 "\"", p->exposure, p->metered);
  fprintf(to, ", \"scene\": \"%016" PRIx64 "\", \"hash\": \"%016" PRIx64 "\", \"seconds\": ", p->result.scene,
          p->result.bytes);
  cli_json_number(to, p->result.seconds);
  if (p->result.fate == FAILED) fprintf(to, ", \"code\": %d", p->result.code);
  fprintf(to, ", \"outcome\": \"%s\"}", fates[p->result.fate]);
}

/* Returns true if no model of the batch has read the file at path. Otherwise prints a message. */
static bool may_write(const batch *b, const char *path) {
  cli_inputs_hear(b->told, b->inputs);
  if (!vs_is_input(b->inputs, path)) return true;
  fprintf(stderr, "vs render: %s: a model reads this file, and no output may replace it; name another file\n", path);
  return false;
}

/* Returns true if no model of the batch has read the file of the film that begins with this picture. Otherwise prints a
 * message. Without a film, returns true. */
static bool may_film(const batch *b, const picture *p) {
  char film[PATH_ROOM];
  return b->options->film <= 0 || p->frame != 1 || (cli_film_name(p->file, film, sizeof film), may_write(b, film));
}

/* Returns true if no model of the batch has read the picture's file, or the file of the film or of the whole that
 * begins with this picture. Otherwise prints a message. */
static bool may_write_picture(const batch *b, const picture *p) {
  return may_write(b, p->file) && may_film(b, p) && (!p->whole || may_write(b, p->whole));
}

/* Writes a file by calling `fill`. The file gets its name only when it is complete. If lock is not NULL, the file is
 * locked before it gets its name, and *lock becomes its descriptor. */
static bool write_whole(const batch *b, const char *path, void (*fill)(const batch *b, FILE *to), int *lock) {
  cli_whole_file file;
  if (!may_write(b, path)) return false;
  FILE *to = cli_whole_begin(&file, path);
  if (to && lock) *lock = fcntl(fileno(to), F_DUPFD_CLOEXEC, 0), flock(*lock, LOCK_EX | LOCK_NB);
  if (to) fill(b, to);
  if (cli_whole_end(&file, true)) return true;
  return fprintf(stderr, "vs render: cannot write %s: %s\n", path, strerror(errno)), false;
}

static void fill_manifest(const batch *b, FILE *to) {
  fprintf(to, "{\"vs\": \"%s\", \"pictures\": [\n", vs_version());
  for (size_t i = 0; i < b->count; i++) {
    /* copies the old manifest's line for a picture that this run has not tried */
    size_t length = 0;
    const picture *p = &b->at[i];
    const char *line = p->kept ? p->kept : p->result.fate == NOT_TRIED ? line_of(b, p, &length) : NULL;
    if (p->kept) length = p->kept_length;
    if (line) fwrite(line, 1, length, to);
    else manifest_picture(to, p);
    fputs(i + 1 < b->count ? ",\n" : "\n", to);
  }
  fputs("]}\n", to);
}

/* Writes the contact sheet as HTML. It refers to pictures by paths relative to its folder, or by absolute paths. */
static void fill_sheet(const batch *b, FILE *to) {
  const char *sheet = b->options->sheet;
  fputs("<!doctype html><meta charset=\"utf-8\"><title>Contact sheet</title>\n<style>body{font:13px sans-serif;"
        "margin:24px;display:grid;grid-template-columns:repeat(auto-fill,minmax(300px,1fr));gap:24px}figure{margin:0}"
        "img{width:100%;height:auto;display:block}figcaption{padding-top:6px;color:#444}</style>\n", to);
  for (size_t i = 0; i < b->count; i++) {
    const picture *p = &b->at[i];
    if ((p->result.fate != MADE && p->result.fate != STANDS) || (p->tile && !p->whole)) continue;
    fputs("<figure><img loading=\"lazy\" src=\"", to);
    cli_part_link(to, p->whole ? p->whole : p->file, sheet);
    fputs("\"><figcaption>", to);
    cli_part_html(to, p->model);
    if (p->view) fputs(", ", to), cli_part_html(to, p->view);
    if (p->set) fputs(", ", to), cli_part_html(to, p->set);
    fputs("</figcaption></figure>\n", to);
  }
}

/* ---- making one picture ---- */

/* Returns the words of the command that makes the picture: this program, the model and all options. The output is
 * `file`, or the scene on standard output if file is "-". The caller frees the array. Returns NULL when memory is
 * out. */
static const char **words_of(const batch *b, const picture *p, char **defines, const char *file) {
  const cli_options *o = b->options;
  size_t n = 0, room = o->passed_count + 2 * strlen(p->set ? p->set : "") + 20;
  const char **w = reallocarray(NULL, room, sizeof *w);
  *defines = p->set ? strdup(p->set) : NULL;
  if (!w || (p->set && !*defines)) return free(w), NULL;
  w[n++] = b->program;
  for (size_t i = 0; i < o->passed_count; i++) w[n++] = o->passed[i];
  char *rest = *defines, *one;
  while (rest && (one = strsep(&rest, ",")) != NULL) w[n++] = "-D", w[n++] = one;
  if (p->view) w[n++] = "--view", w[n++] = p->view;
  if (p->tile) w[n++] = "--crop", w[n++] = p->crop;
  if (*p->exposure) w[n++] = "--exposure", w[n++] = p->exposure;
  if (*b->threads) w[n++] = "--threads", w[n++] = b->threads;
  w[n++] = "-q";
  w[n++] = "-o";
  w[n++] = file;
  if (!strcmp(file, "-")) w[n++] = "--format", w[n++] = "pov";
  w[n++] = "--";
  w[n++] = p->model;
  w[n] = NULL;
  return w;
}

/* In a child process: asks the system to send this signal when the parent is killed. With SIGTERM, the child first ends
 * its own children and removes its temporary files. */
static void die_with_parent(int how) { prctl(PR_SET_PDEATHSIG, how); }

/* Waits for a process. If a signal ends the batch meanwhile, sends that signal to the process: a terminal sends signals
 * to both, but another program may send them only to the batch. */
static void await(const batch *b, pid_t process, int *status) {
  bool asked = false;
  for (pid_t one = 0; one == 0;) {
    one = waitpid(process, status, *b->ended && asked ? 0 : WNOHANG);
    if (one < 0 && errno == EINTR) one = 0;
    if (one == 0 && *b->ended && !asked) asked = true, kill(process, SIGTERM);
    else if (one == 0) nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
  }
}

/* Updates *hash with all that the process writes into the pipe. When the batch ends, the process is asked to end,
 * too. */
static void hash_output(const batch *b, pid_t process, int from, uint64_t *hash) {
  unsigned char part[1 << 14];
  for (bool asked = false;;) {
    struct pollfd ready = {.fd = from, .events = POLLIN};
    if (*b->ended && !asked) asked = true, kill(process, SIGTERM);
    if (poll(&ready, 1, 200) <= 0) continue; /* waits at most 200 ms, because a signal may come just before poll */
    ssize_t n = read(from, part, sizeof part);
    if (n > 0) *hash = cli_part_hash(*hash, part, (size_t)n);
    else if (n == 0 || errno != EINTR) return;
  }
}

/* Runs the command for the picture and returns its exit code. If hash is not NULL, updates *hash with the command's
 * standard output. */
static int run(const batch *b, const picture *p, const char *file, uint64_t *hash) {
  int ends[2] = {-1, -1}, status = 0;
  char *defines = NULL;
  const char **words = words_of(b, p, &defines, file);
  if (!words || (hash && pipe(ends) != 0)) return free(words), free(defines), VS_OUTCOME_MACHINE;
  pid_t child = fork();
  if (child == 0) {
    die_with_parent(SIGTERM);
    cli_inputs_say_typed(p->given, p->frame ? b->options->frames.parameter : NULL);
    if (hash) dup2(ends[1], STDOUT_FILENO), close(ends[0]), close(ends[1]);
    execv(b->program, (char **)(uintptr_t)words);
    _exit(VS_OUTCOME_MACHINE);
  }
  if (hash) close(ends[1]);
  if (hash && child > 0) hash_output(b, child, ends[0], hash);
  if (hash) close(ends[0]);
  if (child > 0) await(b, child, &status);
  free(words), free(defines);
  return child < 0 ? VS_OUTCOME_MACHINE : WIFEXITED(status) ? WEXITSTATUS(status) : VS_OUTCOME_INTERRUPTED;
}

/* Sets *out to the hash of the picture's scene and options. Returns the exit code of the model's run. */
static int hash_model(const batch *b, const picture *p, uint64_t *out) {
  const cli_options *o = b->options;
  const char *version = vs_version();
  *out = cli_part_hash(CLI_HASH_BEGIN, version, strlen(version));
  for (size_t i = 0; i < o->passed_count; i++) *out = cli_part_hash(*out, o->passed[i], strlen(o->passed[i]) + 1);
  return run(b, p, "-", out);
}

/* Runs the model without making a picture, to learn which files it reads. */
static result try_model(const batch *b, const picture *p) {
  result r = {.scene = CLI_HASH_BEGIN, .fate = NOT_TRIED};
  r.code = hash_model(b, p, &r.model);
  if (r.code != VS_OUTCOME_DONE) r.fate = FAILED;
  return r;
}

/* Makes the picture, unless it is up to date. */
static result make_once(const batch *b, const picture *p) {
  struct timespec from, to;
  result r = {.scene = CLI_HASH_BEGIN, .model = p->result.model, .fate = FAILED};
  clock_gettime(CLOCK_MONOTONIC, &from);
  r.code = p->known ? VS_OUTCOME_DONE : hash_model(b, p, &r.model);
  if (r.code == VS_OUTCOME_DONE) r.scene = cli_part_hash(r.model, p->exposure, strlen(p->exposure));
  if (r.code == VS_OUTCOME_DONE && p->tile) r.scene = cli_part_hash(r.scene, p->crop, strlen(p->crop));
  if (r.code == VS_OUTCOME_DONE && is_up_to_date(b, p, r.scene)) r.fate = STANDS;
  else if (r.code == VS_OUTCOME_DONE && (r.code = run(b, p, p->file, NULL)) == VS_OUTCOME_DONE) r.fate = MADE;
  if (r.code == VS_OUTCOME_DONE) cli_part_hash_file(p->file, &r.bytes);
  clock_gettime(CLOCK_MONOTONIC, &to);
  r.seconds = (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
  return r;
}

/* Makes the picture. With --keep-going, repeats a run that was killed, or whose worker failed. */
static result make(const batch *b, const picture *p) {
  for (size_t left = b->options->keep_going ? b->options->retries : 0;; left--) {
    result r = make_once(b, p);
    bool chance = r.fate == FAILED && (r.code == VS_OUTCOME_INTERRUPTED || r.code == VS_OUTCOME_WORKER);
    if (!chance || left == 0 || *b->ended) return r;
  }
}

/* ---- the exposure of a film ----
 *
 * An automatic exposure would differ in each frame, and the film would flicker. Therefore the batch renders the first
 * frame once more, as linear light, and uses its exposure for all frames. The manifest stores this exposure with the
 * hash of the first frame's scene, for a run that continues the film. */

/* Sets the picture's exposure to that of an earlier run, of any part of the film, if the scene of the first frame has
 * not changed. Otherwise returns false. */
static bool recall_exposure(const batch *b, picture *p) {
  static const char before[] = ", \"exposure\": ";
  char wanted[60];
  snprintf(wanted, sizeof wanted, ", \"metered\": \"%016" PRIx64 "\"", p->metered);
  const char *end = b->manifest ? strstr(b->manifest, wanted) : NULL, *from = end;
  while (from && from > b->manifest && strchr("-.0123456789", from[-1])) from--;
  size_t n = (size_t)(end - from), room = strlen(before);
  if (n == 0 || n >= EXPOSURE_ROOM || from < b->manifest + room || strncmp(from - room, before, room) != 0)
    return false;
  memcpy(p->exposure, from, n), p->exposure[n] = 0;
  return true;
}

/* Renders the picture without exposure (as linear light), and computes the exposure that this light requires. */
static int meter(const batch *b, picture *p) {
  char light[PATH_ROOM + 20], developed[PATH_ROOM + 20];
  double stops = 0;
  snprintf(light, sizeof light, "%s.light.exr", p->file);
  snprintf(developed, sizeof developed, "%s.light.png", p->file);
  int code = run(b, p, light, NULL);
  vs_options interpreter = b->options->interpreter;
  interpreter.host = (vs_host){.context = light, .diagnose = say};
  vs_scheme *s = code == VS_OUTCOME_DONE ? vs_new(&interpreter) : NULL;
  if (code == VS_OUTCOME_DONE)
    code = s ? vs_picture_tone(s, light, developed, &b->options->output.development, &stops) : VS_OUTCOME_MACHINE;
  vs_free(s);
  remove(light), remove(developed);
  if (code == VS_OUTCOME_DONE) snprintf(p->exposure, sizeof p->exposure, "%.2f", stops + 0.0);
  return code;
}

static bool is_png(const char *file) {
  const char *dot = strrchr(file, '.');
  return dot && !strcmp(dot, ".png");
}

/* Sets the exposure of the picture, a frame of a film, from the film's first frame. The first frame need not be in the
 * batch (--only). Returns the exit code. */
static int expose(const batch *b, picture *p) {
  picture first = *p;
  char *set = p->frame > 1 ? set_of_frame(&b->options->frames, 1, p->given) : NULL;
  if (p->frame > 1 && !set) return no_memory(), VS_OUTCOME_MACHINE;
  if (set) first.set = set, first.known = false;
  int code = first.known ? VS_OUTCOME_DONE : hash_model(b, &first, &first.metered);
  if (first.known) first.metered = p->result.model;
  if (code == VS_OUTCOME_DONE && !recall_exposure(b, &first)) code = meter(b, &first);
  free(set);
  p->metered = first.metered;
  strcpy(p->exposure, first.exposure);
  return code;
}

/* Sets the exposure of each film from its first frame. A film whose first frame fails is marked as failed. */
static void expose_films(batch *b, const volatile sig_atomic_t *ended) {
  for (size_t from = 0, to; from < b->count && !*ended; from = to) {
    picture *p = &b->at[from];
    for (to = from + 1; to < b->count && b->at[to].frame > b->at[to - 1].frame;) to++;
    if (!p->frame || p->failed || !is_png(p->file) || b->options->output.development.fixed) continue;
    int code = expose(b, p);
    if (code != VS_OUTCOME_DONE && !*ended) {
      p->result.fate = FAILED, p->result.code = code;
      if (!b->options->quiet) printf("%s: failed\n", p->file);
    }
    for (size_t i = from + 1; i < to; i++)
      strcpy(b->at[i].exposure, p->exposure), b->at[i].metered = p->metered;
  }
}

/* ---- running the batch ---- */

static void share_processors(batch *b) {
  long all = sysconf(_SC_NPROCESSORS_ONLN), jobs = (long)b->options->jobs, each = b->options->output.threads;
  if (!each && jobs > 1) each = all / jobs > 1 ? all / jobs : 1;
  if (each) snprintf(b->threads, sizeof b->threads, "%ld", each);
}

/* A function that a process of the batch executes for a picture. */
typedef result picture_work(const batch *b, const picture *p);

static bool start(batch *b, picture *p, picture_work *work) {
  int ends[2];
  if (pipe(ends) != 0) return false;
  p->process = fork();
  if (p->process == 0) {
    close(ends[0]);
    if (b->lock >= 0) close(b->lock); /* the lock ends with the batch, not with its last process */
    if (b->shared >= 0) close(b->shared);
    die_with_parent(SIGKILL); /* a process that waits for the model's run does not react to SIGTERM, so it asks for
                               * SIGKILL */
    result r = work(b, p);
    ssize_t sent = write(ends[1], &r, sizeof r);
    _exit(sent == sizeof r ? 0 : 1);
  }
  close(ends[1]);
  p->told = ends[0];
  return p->process > 0;
}

/* Writes the manifest again. The lock moves from the old file to the new file. Returns false after a message. */
static bool write_manifest(batch *b) {
  int was = b->lock;
  b->lock = -1;
  bool ok = !b->manifest_path || write_whole(b, b->manifest_path, fill_manifest, &b->lock);
  if (was >= 0) close(was);
  if (!ok) b->unwritten = true;
  return ok;
}

/* Locks the manifest for this run, and reads it. Returns false, after a message, if another run has locked the manifest
 * or it cannot be written. */
static bool take_manifest(batch *b) {
  const char *path = b->manifest_path;
  struct stat mine, named;
  if (!path) return true;
  if (!may_write(b, path)) return false;
  b->lock = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  b->manifest_made = b->lock >= 0;
  if (b->lock < 0) b->lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (b->lock < 0) return fprintf(stderr, "vs render: cannot write %s: %s\n", path, strerror(errno)), false;
  bool idle = true;
  if (b->whole_path != path) b->shared = open(b->whole_path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  bool taken = (b->shared < 0 || flock(b->shared, LOCK_SH | LOCK_NB) == 0) && flock(b->lock, LOCK_EX | LOCK_NB) == 0 &&
               fstat(b->lock, &mine) == 0 && stat(path, &named) == 0 && mine.st_ino == named.st_ino &&
               mine.st_dev == named.st_dev;
  b->manifest = read_text(b->whole_path);
  if (!cli_range_texts(b->whole_path, &b->manifest, b->whole_path == path ? &idle : NULL)) return no_memory();
  if (!taken || !idle)
    return fprintf(stderr,
                   "vs render: %s: another run of vs is writing this manifest; wait until that run ends, or name "
                   "another file by --manifest\n",
                   path),
           false;
  return true;
}

static void take_result(picture *p) {
  result r;
  p->result.fate = FAILED, p->result.code = VS_OUTCOME_INTERRUPTED;
  if (read(p->told, &r, sizeof r) == sizeof r) p->result = r;
  close(p->told);
  p->process = 0;
}

/* Prints the result of the picture. */
static void tell(const batch *b, const picture *p) {
  if (b->options->quiet) return;
  if (p->result.fate == STANDS) printf("%s: up to date\n", p->file);
  else if (p->result.fate == MADE) printf("%s: made in %.1f s\n", p->file, p->result.seconds);
  else printf("%s: failed\n", p->file);
  fflush(stdout);
}

/* Records the result of the picture in the manifest, and prints it. */
static void finish(batch *b, picture *p) {
  p->failed = false;
  write_manifest(b);
  tell(b, p);
}

/* Returns true if an earlier frame of the same film has failed, since later frames would fail in the same way. */
static bool is_of_failed_film(const batch *b, size_t i) {
  for (size_t k = i; b->at[i].frame && !b->options->keep_going && k-- > 0 && b->at[k].frame < b->at[k + 1].frame;)
    if (b->at[k].result.fate == FAILED) return true;
  return false;
}

/* Runs `work` for each picture that has not failed, in several processes at a time. */
static void run_all(batch *b, const volatile sig_atomic_t *ended, picture_work *work) {
  bool asked = false;
  size_t next = 0, running = 0, jobs = b->options->jobs > 0 ? b->options->jobs : 1;
  while (running > 0 || (next < b->count && !*ended)) {
    if (next < b->count && running < jobs && !*ended) {
      if (b->at[next].result.fate == FAILED || is_of_failed_film(b, next)) {
        if (work == make && b->at[next].failed) finish(b, &b->at[next]);
        next++;
        continue;
      }
      if (start(b, &b->at[next], work)) running++;
      else b->at[next].result.fate = FAILED, b->at[next].result.code = VS_OUTCOME_MACHINE;
      next++;
      continue;
    }
    pid_t one = waitpid(-1, NULL, WNOHANG);
    if (one < 0 && errno != EINTR) break;
    for (size_t i = 0; *ended && !asked && i < b->count; i++)
      if (b->at[i].process > 0) kill(b->at[i].process, SIGTERM);
    asked = *ended;
    if (one == 0) nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    for (size_t i = 0; one > 0 && i < b->count; i++)
      if (b->at[i].process == one) {
        picture *p = &b->at[i];
        running--;
        take_result(p);
        if (work == make) finish(b, p);
        else p->known = p->result.fate != FAILED, p->failed = !p->known;
      }
  }
}

/* Returns true if the picture would replace a file that no earlier run with this manifest has made. Such a file may be
 * an input. */
static bool takes_place(const batch *b, const picture *p) {
  char film[PATH_ROOM], wanted[40];
  uint64_t bytes;
  size_t length;
  struct stat is;
  const char *line = line_of(b, p, &length);
  cli_film_name(p->file, film, sizeof film);
  if (b->options->film > 0 && p->frame == 1 && stat(film, &is) == 0 && !line) return true;
  if (p->whole && access(p->whole, F_OK) == 0 && !line) return true;
  if (!cli_part_hash_file(p->file, &bytes)) return false;
  snprintf(wanted, sizeof wanted, "\"hash\": \"%016" PRIx64 "\"", bytes);
  const char *found = line ? strstr(line, wanted) : NULL;
  return !found || found >= line + length;
}

/* Called if outputs would replace existing files. First runs all models without making pictures, since a model may read
 * an output of another model. The results are used later, so that no model runs twice. Returns false, after a message,
 * if an output is an input of a model. */
static bool try_models(batch *b) {
  bool any = (b->manifest_path && !b->manifest_made) || (b->options->sheet && access(b->options->sheet, F_OK) == 0);
  bool ok = true;
  for (size_t i = 0; b->count > 1 && i < b->count; i++) any = any || takes_place(b, &b->at[i]);
  if (!any) return true;
  run_all(b, b->ended, try_model);
  for (size_t i = 0; ok && i < b->count; i++) ok = may_write_picture(b, &b->at[i]);
  ok = ok && (!b->options->sheet || may_write(b, b->options->sheet)) &&
      (!b->manifest_path || may_write(b, b->manifest_path));
  if (!ok && b->manifest_made) remove(b->manifest_path);
  return ok;
}

/* Returns true if none of these pictures is newer than the file. Another run may have made them. */
static bool is_newest(const batch *b, const char *file, size_t from, size_t to) {
  struct stat is, of;
  bool newest = stat(file, &of) == 0;
  for (size_t i = from; newest && i < to; i++)
    newest = stat(b->at[i].file, &is) == 0 && (is.st_mtim.tv_sec < of.st_mtim.tv_sec ||
             (is.st_mtim.tv_sec == of.st_mtim.tv_sec && is.st_mtim.tv_nsec <= of.st_mtim.tv_nsec));
  return newest;
}

/* ---- tiles ---- */

/* Returns the index after the last tile of the picture whose first tile in the batch is `from`. */
static size_t end_of_tiles(const batch *b, size_t from) {
  size_t to = from + 1;
  while (to < b->count && b->at[to].tile > b->at[to - 1].tile) to++;
  return to;
}

/* Runs each model that has tiles once, for the scene that all its tiles share. If the model fails, marks its tiles as
 * failed. */
static void share_scenes(batch *b) {
  for (size_t from = 0, to; from < b->count && !*b->ended; from = to) {
    picture *p = &b->at[from];
    to = end_of_tiles(b, from);
    if (!p->tile || p->failed) continue;
    int code = p->known ? VS_OUTCOME_DONE : hash_model(b, p, &p->result.model);
    for (size_t i = from; i < to && !*b->ended; i++) {
      b->at[i].known = code == VS_OUTCOME_DONE, b->at[i].result.model = p->result.model;
      if (code != VS_OUTCOME_DONE) b->at[i].result.fate = FAILED, b->at[i].result.code = code;
    }
    if (code != VS_OUTCOME_DONE && !*b->ended && !b->options->quiet) printf("%s: failed\n", p->file);
  }
}

/* Joins the tiles of each picture if a tile has changed or the picture is missing. */
static vs_outcome join_tiles(const batch *b) {
  const cli_options *o = b->options;
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t from = 0, to; outcome == VS_OUTCOME_DONE && from < b->count; from = to) {
    const char *whole = b->at[from].whole, **tiles;
    to = end_of_tiles(b, from);
    if (!whole) continue;
    bool stands = access(whole, F_OK) == 0;
    for (size_t i = from; i < to; i++) stands = stands && b->at[i].result.fate == STANDS;
    if (stands && o->join) stands = is_newest(b, whole, from, to);
    if (!may_write(b, whole)) return VS_OUTCOME_USAGE;
    if (stands && !o->quiet) printf("%s: up to date\n", whole);
    if (stands) continue;
    if (!(tiles = reallocarray(NULL, to - from, sizeof *tiles))) return no_memory(), VS_OUTCOME_MACHINE;
    for (size_t i = from; i < to; i++) tiles[i - from] = b->at[i].file;
    vs_options interpreter = o->interpreter;
    interpreter.host = (vs_host){.context = (void *)(uintptr_t)whole, .diagnose = say};
    vs_scheme *s = vs_new(&interpreter);
    outcome = s ? vs_picture_join(s, tiles, 1, to - from, whole) : VS_OUTCOME_MACHINE;
    vs_free(s);
    free(tiles);
    if (outcome == VS_OUTCOME_DONE && !o->quiet) printf("%s: joined from %zu tiles\n", whole, to - from);
  }
  return outcome;
}

/* ---- films ---- */

/* Makes a film of each sequence of frames if a frame has changed or the film is missing. */
static vs_outcome make_films(const batch *b) {
  vs_outcome outcome = VS_OUTCOME_DONE;
  for (size_t from = 0, to; outcome == VS_OUTCOME_DONE && from < b->count; from = to) {
    for (to = from + 1; to < b->count && b->at[to].frame > b->at[to - 1].frame;) to++;
    bool stands = true;
    for (size_t i = from; i < to; i++) stands = stands && b->at[i].result.fate == STANDS;
    if (stands && b->options->join) {
      char name[PATH_ROOM];
      cli_film_name(b->at[from].file, name, sizeof name);
      stands = is_newest(b, name, from, to);
    }
    if (!may_film(b, &b->at[from])) return VS_OUTCOME_USAGE;
    cli_film film = {b->at[from].file, to - from, b->options->film, stands, b->options->quiet};
    outcome = cli_film_make(&film);
  }
  return outcome;
}

/* Writes the name of the manifest for frames that have no folder of their own: f.manifest.json for f.png. The shorter
 * name f.json might be an input of the model. */
static const char *manifest_beside(const char *path, char name[PATH_ROOM]) {
  const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
  size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - path) : strlen(path);
  return snprintf(name, PATH_ROOM, "%.*s.manifest.json", (int)stem, path) < PATH_ROOM ? name : NULL;
}

/* Creates the folder of the pictures if it is missing. Returns false after a message. */
static bool make_folder(const cli_options *o) {
  struct stat is;
  const char *out = o->target_count ? o->targets[0].path : NULL, *slash = out ? strrchr(out, '/') : NULL;
  char folder[PATH_ROOM];
  bool whole = out && !cli_options_is_pattern(out) && is_folder(o, out);
  if (!out || (!whole && (!slash || slash == out))) return true;
  snprintf(folder, sizeof folder, "%.*s", (int)(whole ? strlen(out) : (size_t)(slash - out)), out);
  if (stat(folder, &is) == 0 || mkdir(folder, 0777) == 0) return true;
  return fprintf(stderr, "vs render: the folder %s cannot be made: %s\n", folder, strerror(errno)), false;
}

/* Returns the name of the manifest, or NULL if there is none. The array `room` may store the name. */
static const char *manifest_of(const cli_options *o, char room[PATH_ROOM]) {
  struct stat is;
  const char *out = o->target_count ? o->targets[0].path : NULL;
  if (o->manifest) return o->manifest;
  if (out && stat(out, &is) == 0 && S_ISDIR(is.st_mode) &&
      snprintf(room, PATH_ROOM, "%s/manifest.json", out) < PATH_ROOM) return room;
  return o->frames.count || o->tiles.columns ? manifest_beside(out ? out : o->sources[0].text, room) : NULL;
}

/* Records the models as files that are read, and lists the pictures to make. Returns false after a message. */
static bool prepare(batch *b) {
  const cli_options *o = b->options;
  bool ok = true;
  for (size_t i = 0; i < o->source_count; i++) vs_note_input(b->inputs, o->sources[i].text);
  for (size_t i = 0; i < o->set_file_count; i++) vs_note_input(b->inputs, o->set_files[i]);
  bool parts = o->frames.count || o->tiles.columns;
  long sets = (long)(o->set_count ? o->set_count : 1);
  for (long n = 1; ok && n <= sets * (long)o->source_count; n++) {
    size_t from = b->count;
    if (!parts && (n < o->pairs.from || n > o->pairs.to)) continue;
    ok = add_model(b, o->sources[(n - 1) / sets].text, (size_t)((n - 1) % sets));
    for (; from < b->count; from++) b->at[from].pair = n;
  }
  for (size_t i = 0; ok && i < b->count; i++) ok = may_write_picture(b, &b->at[i]);
  return ok && (!o->sheet || may_write(b, o->sheet)) && take_manifest(b);
}

/* Gives each picture the result of an earlier run, without running its model. */
static void recall_all(batch *b) {
  for (size_t i = 0; i < b->count && !*b->ended; i++)
    if (recall_result(b, &b->at[i])) tell(b, &b->at[i]);
}

/* Forgets failures of earlier runs that are to be repeated: --keep-failed keeps those of the model and of limits. */
static void recall_failures(batch *b) {
  for (size_t i = 0; i < b->count; i++) {
    picture *p = &b->at[i];
    if (recall_result(b, p) && p->result.fate == FAILED && cli_part_state_of(p->result.code) == PART_FAILED) continue;
    p->kept = NULL, p->result = (result){.fate = NOT_TRIED};
  }
}

/* Runs the models, and makes the pictures. Returns false after a message if an output is an input. */
static bool make_all(batch *b) {
  if (b->options->keep_failed) recall_failures(b);
  if (!try_models(b)) return false;
  expose_films(b, b->ended);
  share_scenes(b);
  run_all(b, b->ended, make);
  return true;
}

/* Runs the models without making pictures. Returns VS_OUTCOME_USAGE if a model refuses its parameters. */
static vs_outcome try_batch(batch *b) {
  run_all(b, b->ended, try_model);
  for (size_t i = 0; i < b->count; i++)
    if (b->at[i].result.code == VS_OUTCOME_USAGE) return VS_OUTCOME_USAGE;
  return VS_OUTCOME_DONE;
}

/* Returns true, after a message, if pictures are missing that a join needs. */
static bool lacks_pictures(const batch *b) {
  size_t missing = 0, first = 0;
  for (size_t i = b->count; i-- > 0;)
    if (b->at[i].result.fate == NOT_TRIED) missing++, first = i;
  if (missing)
    fprintf(stderr, "vs render: --join: %zu of %zu pictures %s missing, first %s; the same command without --join "
                    "makes them\n", missing, b->count, missing == 1 ? "is" : "are", b->at[first].file);
  return missing > 0;
}

static vs_outcome run_batch(batch *b) {
  const cli_options *o = b->options;
  vs_outcome outcome = b->failed;
  if (o->join) recall_all(b);
  else if (!make_all(b)) return VS_OUTCOME_USAGE;
  if (o->join && lacks_pictures(b)) outcome = VS_OUTCOME_WORKER;
  for (size_t i = b->count; i-- > 0;)
    if (b->at[i].result.fate == FAILED) outcome = (vs_outcome)b->at[i].result.code;
  if (*b->ended) outcome = VS_OUTCOME_INTERRUPTED;
  bool complete = outcome == VS_OUTCOME_DONE;
  if (!b->unwritten && write_manifest(b) && b->whole_path && b->whole_path == b->manifest_path && complete)
    cli_range_remove(b->whole_path);
  if (b->unwritten && outcome == VS_OUTCOME_DONE) outcome = VS_OUTCOME_USAGE;
  if (o->film > 0 && outcome == VS_OUTCOME_DONE) outcome = make_films(b);
  if (o->tiles.columns && !o->only && outcome == VS_OUTCOME_DONE) outcome = join_tiles(b);
  if (o->sheet && !write_whole(b, o->sheet, fill_sheet, NULL) && outcome == VS_OUTCOME_DONE) outcome = VS_OUTCOME_USAGE;
  return outcome;
}

vs_outcome cli_render_command(const cli_options *o, const volatile sig_atomic_t *ended) {
  char beside[PATH_ROOM], own[PATH_ROOM];
  batch b = {.options = o, .ended = ended, .lock = -1, .shared = -1, .told = -1, .inputs = vs_new(&o->interpreter)};
  ssize_t length = readlink("/proc/self/exe", b.program, sizeof b.program - 1);
  vs_outcome outcome = VS_OUTCOME_MACHINE;
  if (length <= 0) fputs("vs render: the path of the vs program cannot be found\n", stderr);
  else if (!b.inputs) no_memory();
  else {
    outcome = VS_OUTCOME_USAGE;
    int watches = cli_inputs_find();
    b.told = cli_inputs_begin();
    share_processors(&b);
    if (make_folder(o)) {
      b.whole_path = b.manifest_path = manifest_of(o, beside);
      bool ranged = o->only && b.whole_path, ok = true;
      long from, to;
      cli_options_range(o, &from, &to);
      if (ranged) ok = cli_range_manifest(b.whole_path, from, to, own, sizeof own);
      if (!ok) fprintf(stderr, "vs render: %s: the name is too long\n", b.whole_path);
      if (ranged) b.manifest_path = own;
      if (o->trying) b.whole_path = b.manifest_path = NULL;
      if (ok && prepare(&b)) outcome = o->trying ? try_batch(&b) : run_batch(&b);
    }
    cli_inputs_hear(b.told, b.inputs);
    cli_inputs_tell(watches, b.inputs);
    if (watches >= 0) close(watches);
  }
  for (size_t i = 0; i < b.count; i++) {
    picture *p = &b.at[i];
    free(p->view), free(p->file), free(p->set), free(p->whole);
  }
  if (b.lock >= 0) close(b.lock);
  if (b.shared >= 0) close(b.shared);
  if (b.told >= 0) close(b.told);
  free(b.at), free(b.manifest);
  vs_free(b.inputs);
  return outcome;
}
