/* Checks that a command has the files that it requires. */
#include "cli/usage/command_files.h"

#include <stdio.h>
#include <string.h>

#include "cli/usage/command_table.h"

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
  const char *name = cli_command_rows[o->command - 1].name;
  fprintf(stderr, "vs %s: as in vs %s %s%s\n", name, name, cli_command_rows[o->command - 1].arguments,
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
  if (!none) fprintf(stderr, "vs %s: give no files; it reads standard input\n", cli_command_rows[o->command - 1].name);
  return none;
}

static bool plain_words(const cli_options *o) {
  const char *name = cli_command_rows[o->command - 1].name;
  bool words = !o->target_count && !o->interactive && !o->untrusted && !o->check && !o->define_count;
  for (size_t i = 0; i < o->source_count; i++)
    words = words && o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0;
  bool one = o->command != CLI_COMMAND_new || o->source_count == 1;
  if (words && one && (o->command != CLI_COMMAND_jupyter || o->source_count < 2)) return true;
  fprintf(stderr, "vs %s: as in vs %s %s\n", name, name, cli_command_rows[o->command - 1].arguments);
  return false;
}

static bool text_files(const cli_options *o) {
  bool files = o->source_count > 0 && !o->target_count && !o->interactive && !o->untrusted && !o->define_count;
  for (size_t i = 0; i < o->source_count; i++) files = files && o->sources[i].kind == CLI_SOURCE_FILE;
  if (!files)
    fprintf(stderr, "vs %s: give the files of programs alone, as in vs %s house.vs, or - for standard input\n",
            cli_command_rows[o->command - 1].name, cli_command_rows[o->command - 1].name);
  return files;
}

bool cli_command_files(const cli_options *o, unsigned takes) {
  if (takes & CLI_TAKES_PICTURE) return picture_files(o, takes);
  if (takes & CLI_TAKES_MANY) return batch_files(o);
  if (takes & CLI_TAKES_SWEEP) return sweep_files(o);
  if (takes & CLI_TAKES_PROGRAMS) return test_files(o);
  if (takes & CLI_TAKES_TEXTS) return text_files(o);
  if (takes & CLI_TAKES_NOTHING) return no_files(o);
  if (takes & CLI_TAKES_WORDS) return plain_words(o);
  const char *name = cli_command_rows[o->command - 1].name;
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
