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

#include "cli/nearby.h"
#include "cli/sweep/set_files.h"
#include "cli/usage/command_table.h"
#include "cli/usage/library_folders.h"
#include "cli/usage/option_rules.h"

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
  puts("  vs FILE             run FILE: Scheme, JavaScript (.js), GML (.gml), AutoLISP (.lsp), OpenSCAD (.scad);\n"
       "                      - is standard input");
  puts("  vs FILE -o OUT ...  run FILE and write its model");
  puts("  vs FILE -- ARG ...  run FILE, whose (command-line) ends in these arguments");
  for (const cli_command_row *c = cli_command_rows; c < cli_command_rows + CLI_COMMANDS; c++)
    printf("  vs %s %-*s %s\n", c->name, (int)(15 - strlen(c->name)), c->arguments, c->help);
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
  if (ok && out->count == 1 && !strncmp(end, "..", 2)) { /* a single frame followed by "..": the text 1..2000 means 2000
                                                          * frames */
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

static bool take_units(cli_options *o, const option_row *row, const char *text) {
  for (size_t i = 0; (o->output.units = vs_unit_name(i)) != NULL; i++)
    if (strcmp(text, o->output.units) == 0) return true;
  return bad(row, text);
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
  if (o->command != CLI_COMMAND_sweep)
    return is_setting(v) || sweep_is_set_file(v) ||
           expected(row, v, "NAME=VALUE, several with commas between them, or the name of a .csv or .json file");
  return is_setting(v) || sweep_is_set_file(v) ||
         expected(row, v, "NAME=VALUES, as in n=1..10:2 or x=0..1/8, or the name of a .csv or .json file");
}

static bool take_expression(cli_options *o, const option_row *row, const char *v) {
  (void)row;
  o->sources[o->source_count++] = (cli_source){CLI_SOURCE_EXPRESSION, v};
  return true;
}

static bool take_library(cli_options *o, const option_row *row, const char *v) {
  return *v ? are_folders("-L", v) && cli_add_folders(o, v) : bad(row, "''");
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

static bool take_pack(cli_options *o, const option_row *row, const char *v) {
  o->cluster.pack = true, o->cluster.packed = v;
  return !v || *v || bad(row, "''");
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

/* Returns true if the word is one of these options, with or without a value. */
static bool is_one_of(const char *word, const char *const *options, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (strlen(options[i]) == strcspn(word + 2, "=") && !strncmp(word + 2, options[i], strlen(options[i]))) return true;
  return false;
}

/* Returns true if the word is an option of --on, which determines where the parts of a batch run. */
static bool is_of_cluster(const char *word) {
  static const char *const own[] = {"on", "time", "memory", "cpus", "bundle", "pack"};
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

/* Keeps the words from `from` to `to` for runs of parts elsewhere (--on). An option about processes is not kept. An
 * option that needs all parts is kept only for the run of all. */
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
  for (size_t i = 0; argc > 1 && i < CLI_COMMANDS; i++)
    if (cli_command_is(argv[1], cli_command_rows[i].name)) o->command = (cli_command)(i + 1), first = 2;
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
  return cli_options_fit(o, argv) ? CLI_GO : CLI_BAD_USAGE;
}

long cli_options_parts(const cli_options *o) {
  if (o->frames.count) return o->frames.count;
  if (o->tiles.columns) return o->tiles.columns * o->tiles.rows;
  return (long)(o->source_count * (o->set_count ? o->set_count : 1));
}

void cli_options_range(const cli_options *o, long *from, long *to) {
  *from = o->frames.count ? o->frames.from : o->tiles.columns ? o->tiles.from : o->pairs.from;
  *to = o->frames.count ? o->frames.to : o->tiles.columns ? o->tiles.to : o->pairs.to;
}

void cli_options_free(cli_options *o) {
  sweep_memory_free(&o->set_memory);
  free(o->sources);
  free(o->targets);
  free(o->defines);
  free(o->words);
  free(o->library_path);
}
