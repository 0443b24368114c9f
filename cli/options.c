/* Reads the command line and prints the help, both from the table options.def. */
#include "cli/options.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/batch/ranges.h"
#include "cli/nearby.h"
#include "cli/sweep/set_files.h"
#include "cli/packages/package_lock.h"

typedef enum { VALUE_NONE, VALUE_REQUIRED, VALUE_OPTIONAL } value_rule;
typedef struct option_row option_row;
/* A function that reads the value v of an option into o. Returns false after printing a message. */
typedef bool take_fn(cli_options *o, const option_row *row, const char *v);
struct option_row {
  char letter;
  const char *name;
  value_rule rule;
  const char *value, *help;
  take_fn *take;
  size_t member, size;    /* member: offset of the member of cli_options to set; size: its size; both in bytes */
  long least, most;       /* least and greatest permitted value of an option whose value is an integer */
  const char *expected;   /* description of a valid value, for messages */
  void (*print)(void);    /* function that prints a text, for options such as --help; `take` is then not used */
};
/* Returns row i of the table of options, or NULL. The table is defined below, since it contains functions that call
 * this one. */
static const option_row *option_at(size_t i);

static const struct { const char *name, *arguments; unsigned takes; const char *help; } commands[] = {
#define COMMAND(name, arguments, takes, help) {#name, arguments, takes, help},
#include "cli/commands.def"
};
enum { COMMANDS = sizeof commands / sizeof *commands };

bool cli_command_help(const char *name, FILE *to) {
  for (size_t i = 0; i < COMMANDS; i++)
    if (!strcmp(commands[i].name, name))
      return fprintf(to, "vs %s%s%s: %s\n", name, *commands[i].arguments ? " " : "", commands[i].arguments,
                     commands[i].help) > 0;
  return false;
}

bool cli_command_suggest(const char *word, FILE *to) {
  if (strpbrk(word, "./")) return false;
  cli_nearby near = cli_nearby_start(word);
  for (size_t i = 0; i < COMMANDS; i++) cli_nearby_offer(&near, commands[i].name);
  if (near.best)
    fprintf(to, "vs: %s is neither a command nor a file; perhaps vs %s %s\n", word, near.best,
            strcmp(near.best, "help") ? "FILE" : "WORD");
  return near.best != NULL;
}

/* ---- help ---- */

extern const char vs_licenses_text[], vs_licenses_text_end[]; /* the texts of LICENSE and NOTICE, embedded by the
                                                               * Makefile */

static void print_version(void) {
  printf("vs %s\n\nThe licence is MIT; vs --licenses prints it, and those of included software.\n", vs_version());
  puts("\nLibraries of others, with their licences:");
#define LINKED(name, licence) puts("  " name ": " licence);
#define LOADED(id, name, licence, package, uses, ...) puts("  " name ", for " uses ": " licence);
#include "geometry/used_libraries.def"
}

static void print_licenses(void) {
  fwrite(vs_licenses_text, 1, (size_t)(vs_licenses_text_end - vs_licenses_text), stdout);
}

static void print_help(void) {
  puts("vs: solid models from Scheme programs\n");
  puts("  vs                  a prompt");
  puts("  vs FILE             run FILE: Scheme, JavaScript (.js), GML (.gml), AutoLISP (.lsp); - is standard input");
  puts("  vs FILE -o OUT ...  run FILE and write its model");
  puts("  vs FILE -- ARG ...  run FILE, whose (command-line) ends in these arguments");
  for (size_t i = 0; i < COMMANDS; i++)
    printf("  vs %s %-*s %s\n", commands[i].name, (int)(15 - strlen(commands[i].name)), commands[i].arguments,
           commands[i].help);
  putchar('\n');
  const option_row *r;
  for (size_t i = 0; (r = option_at(i)); i++) {
    char usage[80] = "";
    const char *gap = r->rule == VALUE_NONE       ? ""
                      : r->rule == VALUE_OPTIONAL ? "[="
                                                  : " ",
               *end = r->rule == VALUE_OPTIONAL ? "]" : "";
    if (r->letter && *r->name) snprintf(usage, sizeof usage, "-%c%s%s, --%s", r->letter, gap, r->value, r->name);
    else if (r->letter) snprintf(usage, sizeof usage, "-%c[%s]", r->letter, r->value);
    else snprintf(usage, sizeof usage, "--%s%s%s%s", r->name, gap, r->value, end);
    printf("  %-26s%s%s\n", usage, strlen(usage) > 25 ? "\n                            " : "", r->help);
  }
  puts("\nOUT may end in:");
  size_t count;
  const vs_format_info *formats = vs_format_list(&count);
  for (size_t i = 0; i < count; i++)
    printf("  .%-6s %s%s%s%s\n", formats[i].suffix, formats[i].doc, formats[i].worker ? " (needs " : "",
           formats[i].worker ? formats[i].worker : "", formats[i].worker ? ")" : "");
  puts("\nExit code: 0 done, 1 an error in the model, 2 an error in the command, or a file that cannot be read or "
       "written,");
  puts("3 a worker program is missing or failed, 4 out of memory or past a limit, 130 interrupted.");
}

/* ---- reading values ---- */

static bool expected(const option_row *row, const char *value, const char *what) {
  if (row->letter) fprintf(stderr, "vs: -%c %s: expected %s\n", row->letter, value, what);
  else fprintf(stderr, "vs: --%s %s: expected %s\n", row->name, value, what);
  return false;
}

static bool bad(const option_row *row, const char *value) { return expected(row, value, row->expected); }

static bool parse_real(const char *text, double least, double *out) {
  char *end;
  double v = strtod(text, &end);
  if (end == text || *end || !isfinite(v) || v < least) return false;
  *out = v;
  return true;
}

static bool parse_whole(const char *text, long least, long most, long *out) {
  char *end;
  errno = 0;
  long v = strtol(text, &end, 10);
  if (end == text || *end || errno || v < least || v > most) return false;
  *out = v;
  return true;
}

static bool take_size(cli_options *o, const option_row *row, const char *text) {
  vs_output_options *out = &o->output;
  char *end;
  long w = strtol(text, &end, 10), h = 0;
  bool ok = end != text && (*end == 'x' || *end == 'X') && parse_whole(end + 1, 1, 32768, &h) && w >= 1 && w <= 32768;
  if (!ok) return bad(row, text);
  out->width = (int)w;
  out->height = (int)h;
  return true;
}

static bool take_tiles(cli_options *o, const option_row *row, const char *text) {
  cli_tiles *t = &o->tiles;
  char *end;
  t->columns = strtol(text, &end, 10);
  bool ok = end != text && (*end == 'x' || *end == 'X') && parse_whole(end + 1, 1, 256, &t->rows);
  t->from = 1, t->to = t->columns * t->rows;
  return (ok && t->columns >= 1 && t->columns <= 256) || bad(row, text);
}

/* Reads the four numbers of --crop. The size of the picture is known only later; crop_is_within compares them with
 * it. */
static bool take_crop(cli_options *o, const option_row *row, const char *text) {
  const char *at = text;
  for (int i = 0; i < 4; i++) {
    char *end;
    errno = 0;
    long v = strtol(at, &end, 10);
    if (end == at || errno || v < 0 || v > 32768 || *end != (i < 3 ? ',' : 0) || (i >= 2 && v == 0))
      return bad(row, text);
    o->output.crop[i] = (int)v;
    at = end + 1;
  }
  return true;
}

static bool take_camera(cli_options *o, const option_row *row, const char *text) {
  vs_output_options *out = &o->output;
  const char *at = text;
  int n = 0;
  out->camera[6] = 35;
  for (; n < 7; n++) {
    char *end;
    out->camera[n] = strtod(at, &end);
    if (end == at || !isfinite(out->camera[n])) break;
    at = end;
    if (*at != ',') { n++; break; }
    at++;
  }
  if (n < 6 || *at || out->camera[6] <= 0)
    return bad(row, text);
  if (memcmp(out->camera, out->camera + 3, 3 * sizeof(double)) == 0)
    return expected(row, text, "an eye that is not at the target");
  out->has_camera = true;
  return true;
}

/* Reads "24", "1..24" or "24,twist=0..90". Searches for the two dots first, since strtod would read one of them as a
 * decimal point. */
static bool take_frames(cli_options *o, const option_row *row, const char *word) {
  cli_frames *out = &o->frames;
  const char *text = word;
  char *end, from[40] = "";
  *out = (cli_frames){.count = strtol(text, &end, 10), .parameter = "t", .to_value = 1, .resume = out->resume};
  bool ok = end != text;
  if (ok && out->count == 1 && !strncmp(end, "..", 2)) { /* 1..2000 means 2000 */
    text = end + 2;
    out->count = strtol(text, &end, 10);
    ok = end != text;
  }
  ok = ok && out->count >= 1 && out->count <= 100000;
  out->from = 1, out->to = out->count;
  if (ok && *end) {
    const char *equals = strchr(end, '='), *dots = equals ? strstr(equals, "..") : NULL;
    ptrdiff_t name = equals ? equals - end - 1 : 0;
    ok = *end == ',' && dots && name > 0 && (size_t)name < sizeof out->parameter &&
         (size_t)(dots - equals) < sizeof from;
    if (ok) {
      snprintf(out->parameter, sizeof out->parameter, "%.*s", (int)name, end + 1);
      snprintf(from, sizeof from, "%.*s", (int)(dots - equals - 1), equals + 1);
    }
    ok = ok && parse_real(from, -HUGE_VAL, &out->from_value) && parse_real(dots + 2, -HUGE_VAL, &out->to_value);
  }
  return ok || bad(row, word);
}

static bool take_quality(cli_options *o, const option_row *row, const char *text) {
  static const struct {
    const char *name;
    vs_quality quality;
  } names[] = { { "draft", VS_QUALITY_DRAFT }, { "good", VS_QUALITY_GOOD }, { "final", VS_QUALITY_FINAL } };
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(text, names[i].name) == 0) {
      o->output.quality = names[i].quality;
      return true;
    }
  return bad(row, text);
}

static bool take_up(cli_options *o, const option_row *row, const char *text) {
  o->output.up_y = strcmp(text, "y") == 0;
  return o->output.up_y || strcmp(text, "z") == 0 || bad(row, text);
}

static bool take_look(cli_options *o, const option_row *row, const char *text) {
  size_t count;
  const char *const *names = vs_look_list(&count);
  for (size_t i = 0; i < count; i++)
    if (strcmp(text, names[i]) == 0) {
      o->output.look = names[i];
      return true;
    }
  return bad(row, text);
}

static bool take_curve(cli_options *o, const option_row *row, const char *text) {
  static const char *const names[] = {[VS_CURVE_NEUTRAL] = "neutral", [VS_CURVE_AGX] = "agx",
                                      [VS_CURVE_FILMIC] = "filmic", [VS_CURVE_LINEAR] = "linear"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (strcmp(text, names[i]) == 0) {
      o->output.development.curve = (vs_curve)i;
      return true;
    }
  return bad(row, text);
}

/* Reads the value of --exposure: "1.5", "auto" or "auto-0.5". */
static bool take_exposure(cli_options *o, const option_row *row, const char *text) {
  vs_development *out = &o->output.development;
  const char *stops = strncmp(text, "auto", 4) == 0 ? text + 4 : text;
  out->fixed = stops == text, out->exposure = 0;
  if (!out->fixed && !*stops) return true;
  bool ok = (out->fixed || *stops == '+' || *stops == '-') && parse_real(stops, -100, &out->exposure);
  return (ok && out->exposure <= 100) || bad(row, text);
}

/* Reads the rest of a word that begins with -O; v is NULL if the word ends there. */
static bool take_passes(cli_options *o, const option_row *row, const char *v) {
  const char *text = v ? v : "";
  vs_output_options *out = &o->output;
  size_t count;
  (void)row;
  const char *const *names = vs_pass_list(&count);
  if (!*text) { out->passes = VS_PASSES_ALL; return true; }
  out->passes = 0;
  if (strcmp(text, "0") == 0) return true;
  while (*text) {
    size_t length = strcspn(text, ","), i = 0;
    while (i < count && !(strlen(names[i]) == length && strncmp(names[i], text, length) == 0)) i++;
    if (i == count) {
      char word[40];
      snprintf(word, sizeof word, "%.*s", (int)length, text);
      cli_nearby near = cli_nearby_start(word);
      fprintf(stderr, "vs: -O%s: there is no pass %s", text, word);
      for (size_t k = 0; k < count; k++) cli_nearby_offer(&near, names[k]);
      if (near.best) fprintf(stderr, "; perhaps %s", near.best);
      fputs("; the passes are", stderr);
      for (size_t k = 0; k < count; k++) fprintf(stderr, "%s %s", k ? "," : "", names[k]);
      fputc('\n', stderr);
      return false;
    }
    out->passes |= 1u << i;
    text += length;
    if (*text == ',') text++;
  }
  return true;
}

/* Appends folders, separated by ':', to o->library_path. Returns false after a message when memory is out. */
static bool add_folders(cli_options *o, const char *folders) {
  size_t have = o->library_path ? strlen(o->library_path) : 0, more = strlen(folders);
  char *path = realloc(o->library_path, have + more + 2);
  if (!path) return fputs("vs: out of memory\n", stderr), false;
  o->library_path = path;
  if (have) path[have++] = ':';
  memcpy(path + have, folders, more + 1);
  return true;
}

/* Appends the folder of packages that belongs to the first program. Returns false after a message if a package is not
 * as its lock says. */
static bool add_packages(cli_options *o) {
  char path[4200], why[PACKAGE_WHY];
  const char *model = NULL;
  for (size_t i = 0; i < o->source_count && !model; i++)
    if (o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-")) model = o->sources[i].text;
  if (package_path(model, path, sizeof path, why)) return !*path || add_folders(o, path);
  fprintf(stderr, "vs: %s\n", why);
  return false;
}

/* Returns true if all folders exist; otherwise prints a message. Only -L is checked: a folder of VS_LIBRARY_PATH need
 * not exist, as in similar environment variables. */
static bool are_folders(const char *option, const char *folders) {
  for (const char *at = folders; *at;) {
    size_t n = strcspn(at, ":");
    char *name = strndup(at, n);
    struct stat is;
    if (!name) return fputs("vs: out of memory\n", stderr), false;
    bool good = !n || (stat(name, &is) == 0 && S_ISDIR(is.st_mode));
    if (!good) fprintf(stderr, "vs: %s %s: there is no such folder\n", option, name);
    free(name);
    if (!good) return false;
    at += n + (at[n] == ':');
  }
  return true;
}

/* ---- functions for values of one type, which set the member of the option's row ---- */

static void *member_of(cli_options *o, const option_row *row) { return (char *)o + row->member; }

static bool take_flag(cli_options *o, const option_row *row, const char *v) {
  (void)v;
  return *(bool *)member_of(o, row) = true;
}

static bool take_text(cli_options *o, const option_row *row, const char *v) {
  *(const char **)member_of(o, row) = v;
  return *v || !row->expected || bad(row, "''");
}

/* Reads an integer into the member of the option's row, which may have any integer type. */
static bool take_whole(cli_options *o, const option_row *row, const char *v) {
  long whole = 0;
  if (!parse_whole(v, row->least, row->most, &whole)) return bad(row, v);
  if (row->size == sizeof(int)) *(int *)member_of(o, row) = (int)whole;
  else if (row->size == sizeof(uint64_t)) *(uint64_t *)member_of(o, row) = (uint64_t)whole;
  return true;
}

static bool take_positive(cli_options *o, const option_row *row, const char *v) {
  double *real = member_of(o, row);
  return (parse_real(v, 0, real) && *real > 0) || bad(row, v);
}

static bool take_megabytes(cli_options *o, const option_row *row, const char *v) {
  double real = 0;
  if (!parse_real(v, 1e-6, &real) || real > 1e9) return bad(row, v);
  *(size_t *)member_of(o, row) = (size_t)(real * 1048576);
  return true;
}

/* ---- functions for one option ---- */

static bool take_output(cli_options *o, const option_row *row, const char *v) {
  o->targets[o->target_count++].path = v;
  return *v || bad(row, "''");
}

static bool is_setting(const char *v) { return strchr(v, '=') && *v != '='; }

static bool take_define(cli_options *o, const option_row *row, const char *v) {
  o->defines[o->define_count++] = (char *)v;
  return is_setting(v) || bad(row, v);
}

static bool take_set(cli_options *o, const option_row *row, const char *v) {
  o->sets[o->set_count++] = v;
  if (o->command != CLI_COMMAND_sweep) return is_setting(v) || bad(row, v);
  return is_setting(v) || sweep_is_set_file(v) ||
         expected(row, v, "NAME=VALUES, as in n=1..10:2 or x=0..1/8, or the name of a .csv or .json file");
}

static bool take_expression(cli_options *o, const option_row *row, const char *v) {
  (void)row;
  o->sources[o->source_count++] = (cli_source){CLI_SOURCE_EXPRESSION, v};
  return true;
}

static bool take_library(cli_options *o, const option_row *row, const char *v) {
  return *v ? are_folders("-L", v) && add_folders(o, v) : bad(row, "''");
}

static bool take_held(cli_options *o, const option_row *row, const char *v) {
  o->held[o->held_count++] = v;
  return *v || bad(row, "''");
}

static bool take_on(cli_options *o, const option_row *row, const char *v) {
  o->cluster.on = v;
  return !strcmp(v, "local") || !strcmp(v, "parallel") || !strcmp(v, "slurm") || (!strncmp(v, "slurm:", 6) && v[6]) ||
         bad(row, v);
}

static bool take_memory(cli_options *o, const option_row *row, const char *v) {
  size_t digits = strspn(v, "0123456789");
  o->cluster.memory = v;
  return (digits > 0 && (!v[digits] || (strchr("KMGT", v[digits]) && !v[digits + 1]))) || bad(row, v);
}

static bool only_json(const option_row *row, const char *v) {
  return !v || strcmp(v, "json") == 0 || bad(row, v);
}

static bool take_stats(cli_options *o, const option_row *row, const char *v) {
  o->stats = o->output.count = true, o->stats_json = v != NULL;
  return only_json(row, v);
}

static bool take_parameters(cli_options *o, const option_row *row, const char *v) {
  o->parameters = true;
  return only_json(row, v);
}

/* ---- the table of options ---- */

#define AT(member) offsetof(cli_options, member), sizeof(((cli_options *)NULL)->member)
#define FLAG(member) take_flag, AT(member), 0, 0, NULL, NULL
#define TEXT(member, expected) take_text, AT(member), 0, 0, expected, NULL
#define WHOLE(member, least, most, expected) take_whole, AT(member), least, most, expected, NULL
#define POSITIVE(member, expected) take_positive, AT(member), 0, 0, expected, NULL
#define MEGABYTES(member, expected) take_megabytes, AT(member), 0, 0, expected, NULL
#define TAKE(function, expected) function, 0, 0, 0, 0, expected, NULL
#define PRINT(function) NULL, 0, 0, 0, 0, NULL, function
#define OPTION(letter, name, rule, value, help, ...) { letter, name, rule, value, help, __VA_ARGS__ },
static const option_row rows[] = {
#include "cli/options.def"
};

static const option_row *option_at(size_t i) { return i < sizeof rows / sizeof *rows ? &rows[i] : NULL; }

/* ---- the words of the command line ---- */

static bool unknown(const char *word) {
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
  cli_nearby near = cli_nearby_start(name[0] == '-' && name[1] == '-' ? name + 2 : name + 1);
  const option_row *row;
  for (size_t i = 0; (row = option_at(i)); i++)
    if (*row->name) cli_nearby_offer(&near, row->name);
  fprintf(stderr, "vs: there is no option %s", name);
  if (near.best) fprintf(stderr, "; perhaps --%s", near.best);
  fputs("; vs --help lists them\n", stderr);
  return false;
}

/* Returns the row of the option that a word names, or NULL. Sets *value to the value in the same word, as in
 * --name=value, or to NULL. */
static const option_row *named_row(const char *word, const char **value) {
  bool long_name = word[1] == '-';
  size_t length = long_name ? strcspn(word + 2, "=") : 0;
  *value = NULL;
  if (long_name && word[2 + length] == '=') *value = word + 3 + length;
  if (!long_name && word[2]) *value = word + 2;
  const option_row *row;
  for (size_t i = 0; (row = option_at(i)); i++)
    if (long_name ? *row->name && strlen(row->name) == length && !strncmp(row->name, word + 2, length)
                  : row->letter == word[1])
      return row;
  return NULL;
}

/* Reads the option argv[*at] and its value, and moves *at to its last word. */
static bool read_option(cli_options *o, int argc, char **argv, int *at, cli_verdict *verdict) {
  const char *word = argv[*at], *value;
  const option_row *row = named_row(word, &value);
  if (!row) return unknown(word);
  if (row->rule == VALUE_NONE && value) {
    if (word[1] != '-') return unknown(word);
    fprintf(stderr, "vs: --%s takes no value\n", row->name);
    return false;
  }
  if (row->rule == VALUE_REQUIRED && !value) {
    if (*at + 1 >= argc) {
      fprintf(stderr, "vs: %s needs a value: %s\n", word, row->value);
      return false;
    }
    value = argv[++*at];
  }
  if (row->print) return row->print(), *verdict = CLI_STOP, true;
  return row->take(o, row, value);
}

/* ---- output files ---- */

static const char *ending_of(const char *path) {
  const char *base = strrchr(path, '/');
  return strcmp(path, "-") == 0 ? NULL : strrchr(base ? base + 1 : path, '.');
}

/* Writes the file name with the ending that other programs read. Returns false if the table of endings lacks this
 * ending. */
static bool advise_ending(const char *path, const char *ending) {
  static const struct { const char *endings, *here, *who; } endings_here[] = {
#define ENDING(endings, here, who) { endings, here, who },
#include "cli/endings.def"
  };
  size_t n = strlen(ending + 1);
  for (size_t i = 0; n && i < sizeof endings_here / sizeof *endings_here; i++)
    for (const char *w = endings_here[i].endings; *w; w += *w == ' ') {
      size_t length = strcspn(w, " ");
      if (length == n && !strncasecmp(w, ending + 1, n)) {
        fprintf(stderr, " write -o %.*s.%s, %s;", (int)(ending - path), path, endings_here[i].here,
                endings_here[i].who);
        return true;
      }
      w += length;
    }
  return false;
}

/* Finds the format of a target among those that the program defines. scheme may be NULL. Returns false after a message
 * on standard error. */
static bool late_format(const cli_options *o, cli_target *t, const vs_scheme *scheme) {
  const char *ending = ending_of(t->path);
  vs_format_info brought;
  if (t->format) return true;
  if (scheme && ending && vs_format_of(scheme, ending, &brought)) return t->format = ending, true;
  if (scheme && o->format && vs_format_of(scheme, o->format, &brought)) return t->format = o->format, true;
  if (o->format) {
    fprintf(stderr, "vs: --format %s: there is no such format;", o->format);
  } else if (strcmp(t->path, "-") == 0) {
    fputs("vs: -o - needs --format;", stderr);
  } else {
    fprintf(stderr, "vs: %s: ", t->path);
    if (ending) fprintf(stderr, "no format has the ending %s;", ending);
    else fputs("the name has no ending that names a format;", stderr);
  }
  size_t count;
  const vs_format_info *formats = vs_format_list(&count);
  cli_nearby near = cli_nearby_start(o->format ? o->format : ending ? ending + 1 : "");
  for (size_t i = 0; i < count; i++) cli_nearby_offer(&near, formats[i].suffix);
  if (!o->format && ending && advise_ending(t->path, ending)) near.best = NULL;
  if (near.best && *near.wanted && (o->format || near.distance < 2)) fprintf(stderr, " perhaps .%s;", near.best);
  fprintf(stderr, " there are %s\n", vs_format_endings());
  return false;
}

/* Finds the format of a target among the built-in formats. Another name or suffix may belong to a format that the
 * program defines (cli_options_late). */
static bool find_format(cli_options *o, cli_target *t) {
  const char *ending = ending_of(t->path);
  if (strcmp(t->path, "-") == 0) o->to_stdout = true;
  const vs_format_info *said = o->format ? vs_format_find(o->format) : NULL,
                       *own = ending ? vs_format_find(ending) : NULL;
  if (own && said && strcmp(said->suffix, own->suffix) == 0) own = said; /* if --format names another format with the
                                                                          * file's suffix, that format is used */
  if (!own) own = said;
  if (own) t->format = own->name;
  return own || o->format || (ending && ending[1]) || late_format(o, t, NULL);
}

bool cli_options_late(cli_options *o, const vs_scheme *scheme) {
  for (size_t i = 0; i < o->target_count; i++)
    if (!late_format(o, &o->targets[i], scheme)) return false;
  return true;
}

/* Returns the path without its folders. */
static const char *file_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

bool cli_options_is_pattern(const char *path) {
  return *file_name(path) == '%';
}

/* Returns true if the output file can probably be written. Otherwise reports it now, before long work begins. */
static bool reachable(const cli_target *t) {
  if (strcmp(t->path, "-") == 0) return true;
  struct stat status;
  if (stat(t->path, &status) == 0 && S_ISDIR(status.st_mode)) {
    fprintf(stderr, "vs: %s: is a folder, not a file\n", t->path);
    return false;
  }
  const char *slash = strrchr(t->path, '/');
  size_t length = slash ? (size_t)(slash - t->path) : 0;
  char *folder = malloc(length + 2);
  if (!folder) return true; /* if memory is out here, writing the output will report it */
  memcpy(folder, t->path, length);
  strcpy(folder + length, slash ? (length ? "" : "/") : ".");
  bool found = stat(folder, &status) == 0, ok = found && S_ISDIR(status.st_mode) && access(folder, W_OK | X_OK) == 0;
  if (found && !S_ISDIR(status.st_mode)) errno = ENOTDIR;
  if (!ok && errno == ENOENT) fprintf(stderr, "vs: %s: there is no folder %s\n", t->path, folder);
  else if (!ok && errno == ENOTDIR) fprintf(stderr, "vs: %s: %s is no folder\n", t->path, folder);
  else if (!ok) fprintf(stderr, "vs: %s: cannot write into %s: %s\n", t->path, folder, strerror(errno));
  free(folder);
  return ok;
}

/* Returns true if a command on EXR pictures has the files that it requires. Otherwise prints a message. */
static bool picture_files(const cli_options *o, unsigned takes) {
  size_t want = takes & CLI_TAKES_POINT ? 3 : takes & CLI_TAKES_TWO ? 2 : 1;
  bool files = o->source_count == want && !o->define_count && !o->untrusted && !o->frames.count;
  for (size_t i = 0; i < o->source_count; i++)
    files = files && o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0;
  size_t least = takes & CLI_TAKES_TARGET ? 1 : 0, most = takes & (CLI_TAKES_TARGET | CLI_TAKES_OUTPUT) ? 1 : 0;
  bool output = o->target_count >= least && o->target_count <= most;
  if (output && most && o->target_count) output = strcmp(o->targets[0].path, "-") != 0;
  if (files && output) return true;
  const char *name = commands[o->command - 1].name;
  fprintf(stderr, "vs %s: as in vs %s %s%s\n", name, name, commands[o->command - 1].arguments,
          !least ? "" : o->command == CLI_COMMAND_denoise ? " -o B.exr" : " -o B.png");
  return false;
}

static bool batch_files(const cli_options *o) {
  bool files = o->source_count > 0 && o->target_count <= 1;
  for (size_t i = 0; i < o->source_count; i++)
    files = files && o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0;
  if (!files || (o->target_count && (!*o->targets[0].path || !strcmp(o->targets[0].path, "-")))) {
    fputs("vs render: give the files of models, and a file or a folder for the pictures, as in vs render a.vs b.vs -o "
          "pictures\n", stderr);
    return false;
  }
  if (o->interactive || o->check || (o->untrusted && o->all_views)) {
    fprintf(stderr, "vs render: %s works only with vs FILE\n", o->interactive ? "-i" : o->check ? "--check"
            : "--all-views of an untrusted model");
    return false;
  }
  return true;
}

static bool sweep_files(const cli_options *o) {
  bool file = o->source_count == 1 && o->sources[0].kind == CLI_SOURCE_FILE && strcmp(o->sources[0].text, "-") != 0;
  for (size_t i = 0; i < o->target_count; i++) file = file && strcmp(o->targets[i].path, "-") != 0;
  if (!file)
    fputs(
        "vs sweep: give the file of one model, values of its parameters, and a folder for the results, as in vs sweep "
        "house.vs --set n=1..10:2 -o out/; without -o the table goes to standard output\n",
        stderr);
  else if (o->interactive || o->check || o->all_views || o->stats || o->parameters)
    fprintf(stderr, "vs sweep: %s works only with vs FILE\n", o->interactive ? "-i" : o->check ? "--check"
            : o->all_views ? "--all-views" : o->stats ? "--stats" : "--parameters");
  else return true;
  return false;
}

static bool test_files(const cli_options *o) {
  bool files = o->source_count > 0 && !o->target_count && !o->interactive && !o->check;
  for (size_t i = 0; i < o->source_count; i++)
    files = files && o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0;
  if (!files)
    fputs("vs test: give the files of programs alone, as in vs test house.vs stairs.vs; -o, -e, -i and --check are for "
          "vs FILE\n", stderr);
  return files;
}

static bool no_files(const cli_options *o) {
  bool none = !o->source_count && !o->target_count && !o->interactive && !o->untrusted && !o->check;
  if (!none) fprintf(stderr, "vs %s: give no files; it reads standard input\n", commands[o->command - 1].name);
  return none;
}

static bool plain_words(const cli_options *o) {
  const char *name = commands[o->command - 1].name;
  bool words = !o->target_count && !o->interactive && !o->untrusted && !o->check && !o->define_count;
  for (size_t i = 0; i < o->source_count; i++)
    words = words && o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0;
  bool one = o->command != CLI_COMMAND_new || o->source_count == 1;
  if (words && one && (o->command != CLI_COMMAND_jupyter || o->source_count < 2)) return true;
  fprintf(stderr, "vs %s: as in vs %s %s\n", name, name, commands[o->command - 1].arguments);
  return false;
}

static bool text_files(const cli_options *o) {
  bool files = o->source_count > 0 && !o->target_count && !o->interactive && !o->untrusted && !o->define_count;
  for (size_t i = 0; i < o->source_count; i++) files = files && o->sources[i].kind == CLI_SOURCE_FILE;
  if (!files)
    fprintf(stderr, "vs %s: give the files of programs alone, as in vs %s house.vs, or - for standard input\n",
            commands[o->command - 1].name, commands[o->command - 1].name);
  return files;
}

/* Returns true if the command has the files that it requires, and no -o unless it writes a file. Otherwise prints a
 * message on standard error. */
static bool command_files(const cli_options *o, unsigned takes) {
  if (takes & CLI_TAKES_PICTURE) return picture_files(o, takes);
  if (takes & CLI_TAKES_MANY) return batch_files(o);
  if (takes & CLI_TAKES_SWEEP) return sweep_files(o);
  if (takes & CLI_TAKES_PROGRAMS) return test_files(o);
  if (takes & CLI_TAKES_TEXTS) return text_files(o);
  if (takes & CLI_TAKES_NOTHING) return no_files(o);
  if (takes & CLI_TAKES_WORDS) return plain_words(o);
  const char *name = commands[o->command - 1].name;
  size_t want = takes & (CLI_TAKES_TWO | CLI_TAKES_SCAN) ? 2 : 1;
  bool files = o->source_count == want, output = takes & CLI_TAKES_OUTPUT || o->target_count == 0;
  if (takes & CLI_TAKES_LANGUAGE) output = o->target_count <= 1;
  if (takes & CLI_TAKES_FOLDER) output = o->target_count == 1 && strcmp(o->targets[0].path, "-") != 0;
  for (size_t i = 0; i < o->source_count; i++)
    files = files && o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0;
  if (files && output) return true;
  if (takes & CLI_TAKES_FOLDER) fprintf(stderr, "vs %s: give the file of one model and a folder, as in vs %s house.vs "
                                        "-o site\n", name, name);
  else if (takes & CLI_TAKES_SCAN)
    fprintf(stderr, "vs %s: give the files of a model and of a scan, as in vs %s column.vs scan.ply\n", name, name);
  else if (want == 2) fprintf(stderr, "vs %s: give the files of two models, as in vs %s old.vs new.vs\n", name, name);
  else fprintf(stderr, "vs %s: give the file of one model, as in vs %s house.vs%s\n", name, name,
               output ? "" : "; -o works only with vs FILE");
  return false;
}

/* Returns true if the word equals the name of a command, apart from hyphens (sun-study). */
static bool is_command(const char *word, const char *name) {
  if (*word == '-') return false;
  for (; *word; word++)
    if (*word != '-' && *word != *name++) return false;
  return !*name;
}

/* Returns true if the word is one of these options, with or without a value. */
static bool is_one_of(const char *word, const char *const *options, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (strlen(options[i]) == strcspn(word + 2, "=") && !strncmp(word + 2, options[i], strlen(options[i]))) return true;
  return false;
}

/* Returns true for options that say where parts run. */
static bool is_of_cluster(const char *word) {
  static const char *const own[] = {"on", "time", "memory", "cpus", "bundle"};
  return word[1] == '-' && is_one_of(word, own, sizeof own / sizeof *own);
}

/* Returns true for options that `vs render` and `vs sweep` process themselves. All other options apply to the run of
 * each picture or set. */
static bool is_of_batch(const char *word) {
  static const char *const own[] = {"output", "view", "all-views", "set", "jobs", "manifest", "sheet", "frames",
                                    "resume", "film", "quiet", "threads", "sample", "seed", "where", "sort", "only",
                                    "tiles", "retries", "join", "keep-going", "keep-failed", "watch"};
  if (word[1] != '-') return strchr("oqj", word[1]) != NULL;
  return is_one_of(word, own, sizeof own / sizeof *own) || is_of_cluster(word);
}

/* Keeps the words from `from` to `to` for runs elsewhere: an option that concerns processes for none, one that needs
 * all parts for the run of all, and others for both. */
static void keep_words(cli_options *o, char **argv, int from, int to) {
  static const char *const here[] = { "jobs", "threads", "quiet", "watch" }, *const all[] = { "film", "sheet", "where",
                                                                                              "sort" };
  const char *word = argv[from];
  bool option = word[0] == '-' && word[1] && strcmp(word, "--") != 0, named = option && word[1] == '-';
  if (option && !named && strchr("qj", word[1])) return;
  if (named && (is_of_cluster(word) || is_one_of(word, here, sizeof here / sizeof *here))) return;
  bool whole_only = named && is_one_of(word, all, sizeof all / sizeof *all);
  for (; from <= to; from++) {
    o->whole[o->whole_count++] = argv[from];
    if (!whole_only) o->part[o->part_count++] = argv[from];
  }
}

/* Returns true if the path ends in .png or has no suffix. A path without suffix is a folder for .png pictures. */
static bool is_png_or_folder(const char *path) {
  const char *ending = ending_of(path);
  return !ending || strcmp(ending, ".png") == 0 || path[strlen(path) - 1] == '/';
}

/* Returns true if the options with --tiles go together. Otherwise prints a message. */
static bool tiles_fit(cli_options *o) {
  const char *ending = o->target_count ? ending_of(o->targets[0].path) : NULL, *wrong = NULL;
  if (o->command != CLI_COMMAND_render) wrong = "it is for vs render";
  else if (o->frames.count) wrong = "give it without --frames: each frame is a part of its own (--only)";
  else if (o->output.crop[2]) wrong = "give it without --crop";
  else if (!o->output.width || !o->output.height) wrong = "give the size of the whole picture by --size";
  else if (o->output.height < o->tiles.columns * o->tiles.rows) wrong = "a tile would be empty";
  else if (ending && strcmp(ending, ".png") != 0 && strcmp(ending, ".exr") != 0 && !strchr(ending, '/'))
    wrong = "tiles are .png or .exr pictures";
  if (wrong) return fprintf(stderr, "vs: --tiles %ldx%ld: %s\n", o->tiles.columns, o->tiles.rows, wrong), false;
  long all = o->tiles.columns * o->tiles.rows;
  if (!o->only || cli_range_read(o->only, all, &o->tiles.from, &o->tiles.to)) return true;
  return fprintf(stderr, "vs: --only %s: expected numbers of tiles, at most 1..%ld\n", o->only, all), false;
}

/* Returns true if the options about bundles and joining are given to a command that has them. Otherwise prints a
 * message. */
static bool cluster_fits(const cli_options *o) {
  const cli_cluster *c = &o->cluster;
  bool batch = o->command == CLI_COMMAND_render || o->command == CLI_COMMAND_sweep;
  const char *path = o->target_count ? o->targets[0].path : "";
  const char *wrong = NULL;
  if (!batch && (c->on || o->join || o->keep_going || o->keep_failed || o->retries != 2))
    wrong = "--on, --join, --retries, --keep-going and --keep-failed are for vs render and vs sweep";
  else if (!c->on && (c->time || c->memory || c->cpus || c->bundle))
    wrong = "--time, --memory, --cpus and --bundle need --on slurm";
  else if (c->on && (o->only || o->join || o->manifest)) wrong = "give --on without --only, --join and --manifest";
  else if (c->on && o->command == CLI_COMMAND_render && (!*path || path[strlen(path) - 1] != '/'))
    wrong = "--on needs a folder for the pictures that ends in a slash, as in -o film/";
  else if (c->on && o->command == CLI_COMMAND_render && !o->frames.count && !o->tiles.columns)
    wrong = "--on needs parts: --frames of a film, or --tiles of a picture";
  if (!wrong) return true;
  fprintf(stderr, "vs%s%s: %s\n", batch ? " " : "", batch ? commands[o->command - 1].name : "", wrong);
  return false;
}

/* Returns true if the command can run again without a person. Otherwise prints a message. */
static bool watch_fits(const cli_options *o) {
  bool stdin_read = false;
  for (size_t i = 0; i < o->source_count; i++) stdin_read = stdin_read || !strcmp(o->sources[i].text, "-");
  bool again = o->command == CLI_COMMAND_render || o->command == CLI_COMMAND_sweep || o->command == CLI_COMMAND_test ||
               (o->command == CLI_COMMAND_NONE && o->target_count > 0 && !o->interactive);
  if (again && !stdin_read && !o->cluster.on) return true;
  fputs("vs: --watch is for vs FILE -o OUT, vs render, vs sweep and vs test, with files and without --on\n", stderr);
  return false;
}

cli_verdict cli_options_parse(cli_options *o, int argc, char **argv) {
  size_t room = (size_t)argc + 1;
  cli_verdict verdict = CLI_GO;
  *o = (cli_options){.interpreter = vs_options_default(), .output = vs_output_options_default(), .retries = 2};
  o->sources = calloc(room, sizeof *o->sources);
  o->targets = calloc(room, sizeof *o->targets);
  o->defines = calloc(room, sizeof *o->defines);
  o->words = calloc(6 * room, sizeof *o->words);
  if (!o->sources || !o->targets || !o->defines || !o->words) {
    fputs("vs: out of memory\n", stderr);
    return CLI_BAD_USAGE;
  }
  o->held = o->words + room, o->sets = o->held + room, o->passed = o->sets + room;
  o->whole = o->passed + room, o->part = o->whole + room;
  bool names_only = false; /* whether the word -- has occurred before any model, so that all later words are files */
  o->words[o->word_count++] = "vs";
  int first = 1;
  for (size_t i = 0; argc > 1 && i < COMMANDS; i++)
    if (is_command(argv[1], commands[i].name)) o->command = (cli_command)(i + 1), first = 2;
  if (o->command == CLI_COMMAND_help) {
    print_help();
    return CLI_STOP;
  }
  for (int i = first; i < argc; i++) {
    const char *word = argv[i];
    if (strcmp(word, "--") == 0 && o->source_count) { /* all words after the model and -- are arguments of the
                                                       * program */
      keep_words(o, argv, i, argc - 1);
      while (++i < argc) o->words[o->word_count++] = argv[i];
    } else if (names_only || word[0] != '-' || !word[1]) {
      o->sources[o->source_count++] = (cli_source){ CLI_SOURCE_FILE, word };
      keep_words(o, argv, i, i);
    } else if (strcmp(word, "--") == 0) {
      names_only = true;
      keep_words(o, argv, i, i);
    } else {
      int from = i;
      if (!read_option(o, argc, argv, &i, &verdict)) return CLI_BAD_USAGE;
      if (verdict != CLI_GO) return verdict;
      keep_words(o, argv, from, i);
      for (; !is_of_batch(word) && from <= i; from++) o->passed[o->passed_count++] = argv[from];
    }
  }
  unsigned takes = o->command ? commands[o->command - 1].takes : 0;
  if ((o->json && !(takes & CLI_TAKES_JSON)) || (o->xml && !(takes & CLI_TAKES_XML))) {
    unsigned want = o->json && !(takes & CLI_TAKES_JSON) ? CLI_TAKES_JSON : CLI_TAKES_XML;
    fprintf(stderr, "vs: --%s is for", want == CLI_TAKES_JSON ? "json" : "xml");
    for (size_t i = 0, n = 0; i < COMMANDS; i++)
      if (commands[i].takes & want) fprintf(stderr, "%s vs %s", n++ ? "," : "", commands[i].name);
    fputs(want == CLI_TAKES_JSON ? "; statistics as JSON are --stats=json\n" : "\n", stderr);
    return CLI_BAD_USAGE;
  }
  if ((o->place || o->date || o->from || o->step) && !(takes & CLI_TAKES_SUN)) {
    fputs("vs: --place, --date, --from and --step are for vs sunstudy\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->language && !(takes & (CLI_TAKES_LANGUAGE | CLI_TAKES_SUN))) {
    fputs("vs: --to is for vs translate\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->json && o->xml) {
    fputs("vs: give --json or --xml, not both\n", stderr);
    return CLI_BAD_USAGE;
  }
  const char *of_fit = o->placed       ? "placed"
                       : o->near       ? "near"
                       : o->any_pose   ? "any-pose"
                       : o->held_count ? "hold"
                       : o->points     ? "points"
                                       : NULL;
  if (o->command != CLI_COMMAND_fit && of_fit) {
    fprintf(stderr, "vs: --%s is for vs fit\n", of_fit);
    return CLI_BAD_USAGE;
  }
  if (o->placed + o->near + o->any_pose > 1) {
    fputs("vs fit: give only one of --placed, --near and --any-pose\n", stderr);
    return CLI_BAD_USAGE;
  }
  bool sweeps = o->command == CLI_COMMAND_sweep;
  if (o->command != CLI_COMMAND_render &&
      (((o->set_count || o->jobs || o->sheet) && !sweeps) || o->manifest || o->film)) {
    fputs(sweeps ? "vs sweep: --manifest and --film are for vs render; the manifest is in the folder of -o\n"
                 : "vs: --set, --jobs, --manifest, --sheet and --film are for vs render, and --set, --jobs and --sheet "
                   "for vs sweep\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (!sweeps && (o->sample || o->seed || o->where || o->sort || (o->only && !o->frames.count && !o->tiles.columns))) {
    fputs("vs: --sample, --seed, --where and --sort are for vs sweep, and --only for vs sweep, --frames and --tiles\n",
          stderr);
    return CLI_BAD_USAGE;
  }
  if (o->frames.count && o->only && !cli_range_read(o->only, o->frames.count, &o->frames.from, &o->frames.to)) {
    fprintf(stderr, "vs: --only %s: expected numbers of frames, at most 1..%ld\n", o->only, o->frames.count);
    return CLI_BAD_USAGE;
  }
  if (!cluster_fits(o) || (o->watch && !watch_fits(o))) return CLI_BAD_USAGE;
  if (o->tiles.columns && !tiles_fit(o)) return CLI_BAD_USAGE;
  if (o->film && o->only) {
    fputs("vs render: --film needs all frames: give it without --only, when all parts are done\n", stderr);
    return CLI_BAD_USAGE;
  }
  for (size_t i = 0; !(takes & (CLI_TAKES_PICTURE | CLI_TAKES_WORDS)) && i < o->source_count; i++) {
    const char *path = o->sources[i].text;
    char near[4096];
    if (o->sources[i].kind != CLI_SOURCE_FILE || access(path, F_OK) == 0 ||
        !cli_nearby_program(path, near, sizeof near)) continue;
    fprintf(stderr, "vs: %s: no such file; perhaps %s\n", path, near);
    return CLI_BAD_USAGE;
  }
  bool file_first = !o->command && o->source_count && argc > 1 && o->sources[0].text == argv[1];
  if (file_first && access(argv[1], F_OK) != 0 && !strpbrk(argv[1], "./") && strcmp(argv[1], "-")) {
    if (!cli_command_suggest(argv[1], stderr))
      fprintf(stderr, "vs: %s is neither a command nor a file; vs --help lists the commands\n", argv[1]);
    return CLI_BAD_USAGE;
  }
  /* Finds files that are probably outputs without -o, as in: vs model.vs a.stl. */
  for (size_t i = 0; !(takes & (CLI_TAKES_PICTURE | CLI_TAKES_SCAN | CLI_TAKES_WORDS)) && i < o->source_count; i++) {
    const char *path = o->sources[i].text;
    const vs_format_info *f = o->sources[i].kind == CLI_SOURCE_FILE && strchr(path, '.') ? vs_format_find(path) : NULL;
    if (!f) continue;
    fprintf(stderr, "vs: %s is a name for an output, not a program; write -o before it: vs", path);
    size_t programs = 0;
    for (size_t k = 0; k < o->source_count; k++)
      if (k != i && o->sources[k].kind == CLI_SOURCE_FILE) programs++, fprintf(stderr, " %s", o->sources[k].text);
    fprintf(stderr, "%s -o %s\n", programs ? "" : " model.vs", path);
    return CLI_BAD_USAGE;
  }
  if (o->command != CLI_COMMAND_NONE && !command_files(o, takes)) return CLI_BAD_USAGE;
  if (o->command == CLI_COMMAND_doc && o->untrusted) {
    fputs("vs doc: --untrusted works only with vs FILE: for its pictures vs doc calls each procedure of the program\n",
          stderr);
    return CLI_BAD_USAGE;
  }
  if (o->command == CLI_COMMAND_params) o->parameters = o->quiet = true;
  const char *folders = getenv("VS_LIBRARY_PATH");
  if (folders && *folders && !add_folders(o, folders)) return CLI_BAD_USAGE;
  if (!(takes & (CLI_TAKES_WORDS | CLI_TAKES_PICTURE)) && !o->untrusted && !add_packages(o)) return CLI_BAD_USAGE;
  o->interpreter.library_path = o->library_path;
  for (size_t i = takes & CLI_TAKES_SCAN ? 1 : o->source_count; i-- > 0;)
    if (o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0) o->words[0] = o->sources[i].text;
  o->interpreter.command_line = o->words;
  o->interpreter.command_line_count = o->word_count;
  bool formats = !(takes & (CLI_TAKES_FOLDER | CLI_TAKES_LANGUAGE | CLI_TAKES_MANY | CLI_TAKES_SWEEP));
  for (size_t i = 0; formats && i < o->target_count; i++)
    if (strncmp(file_name(o->targets[i].path), "%.", 2) == 0) {
      fprintf(stderr, "vs: -o %s: the name of a model takes the place of %% in outputs of vs render: vs render",
              o->targets[i].path);
      for (size_t k = 0; k < o->source_count; k++)
        if (o->sources[k].kind == CLI_SOURCE_FILE) fprintf(stderr, " %s", o->sources[k].text);
      fprintf(stderr, " -o %s\n", o->targets[i].path);
      return CLI_BAD_USAGE;
    }
  for (size_t i = 0; formats && i < o->target_count; i++)
    if (!find_format(o, &o->targets[i]) || !reachable(&o->targets[i])) return CLI_BAD_USAGE;
  for (size_t i = 0; takes & CLI_TAKES_SCAN && i < o->target_count; i++) {
    const vs_format_info *f = vs_format_find(o->targets[i].path);
    if (f && (!strcmp(f->suffix, "ply") || !strcmp(f->suffix, "x3d"))) continue;
    fprintf(stderr,
            "vs fit: %s: the file of -o must end in .ply or .x3d: vs fit writes the map of distances there; to write "
            "the fitted model, run vs FILE with the fitted values by -D\n",
            o->targets[i].path);
    return CLI_BAD_USAGE;
  }
  bool flames = o->target_count == 1 && o->targets[0].format && !strcmp(o->targets[0].format, "svg");
  if (o->command == CLI_COMMAND_profile && o->target_count && !flames) {
    fputs("vs profile: -o writes the tree of calls: one file, which ends in .svg\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->all_views && o->output.view) {
    fputs("vs: give --all-views or --view, not both\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->frames.resume && !o->frames.count) {
    fputs("vs: --resume is for --frames\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->frames.count && o->command != CLI_COMMAND_NONE && o->command != CLI_COMMAND_render) {
    fprintf(stderr, "vs %s: --frames is for vs FILE and vs render FILE\n", argv[1]);
    return CLI_BAD_USAGE;
  }
  if (o->film && (!o->frames.count || (o->target_count && !is_png_or_folder(o->targets[0].path)))) {
    fputs("vs render: --film is for --frames that are .png pictures\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->frames.resume && o->command == CLI_COMMAND_render) {
    fputs(
        "vs render: --resume works only with vs FILE; vs render finds the frames that are up to date by its manifest\n",
        stderr);
    return CLI_BAD_USAGE;
  }
  if (o->frames.count && o->command == CLI_COMMAND_NONE && (o->interactive || o->to_stdout || o->target_count == 0)) {
    fputs(o->interactive ? "vs: give --frames or -i, not both\n"
          : "vs: --frames writes files: name them by -o, as in -o tower.png for tower-001.png and so on\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->dependencies && (o->command != CLI_COMMAND_NONE || o->target_count <= (o->to_stdout ? 1 : 0))) {
    fputs("vs: -d is for vs FILE with -o, as in vs house.vs -o house.stl -d house.d\n", stderr);
    return CLI_BAD_USAGE;
  }
  for (size_t i = 0; o->dependencies && i < o->target_count; i++)
    if (!strcmp(o->dependencies, o->targets[i].path)) {
      fprintf(stderr, "vs: -d %s: it is an output, too\n", o->dependencies);
      return CLI_BAD_USAGE;
    }
  if (o->dependencies && !reachable(&(cli_target){o->dependencies, NULL})) return CLI_BAD_USAGE;
  if (o->target_count && o->check) {
    fputs("vs: --check writes no output: give --check or -o, not both\n", stderr);
    return CLI_BAD_USAGE;
  }
  if (o->target_count && !o->source_count) {
    fputs("vs: -o needs a model: name its file, or - for standard input\n", stderr);
    return CLI_BAD_USAGE;
  }
  return CLI_GO;
}

void cli_options_free(cli_options *o) {
  free(o->sources);
  free(o->targets);
  free(o->defines);
  free(o->words);
  free(o->library_path);
}
