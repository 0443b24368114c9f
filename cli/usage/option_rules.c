/* Checks that the options, the files and the command of a command line go together, and prints one message if they do
 * not. The order of the checks decides which message it is. */
#include "cli/usage/option_rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/batch/ranges.h"
#include "cli/nearby.h"
#include "cli/sweep/set_files.h"
#include "cli/usage/command_files.h"
#include "cli/usage/command_table.h"
#include "cli/usage/library_folders.h"
#include "cli/usage/output_files.h"

static bool refuse(const char *message) { return fputs(message, stderr), false; }

/* Returns true if the options that are given with --tiles go together. Otherwise prints a message. */
static bool tiles_fit(cli_options *o) {
  const char *ending = o->target_count ? cli_ending_of(o->targets[0].path) : NULL, *wrong = NULL;
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

/* Returns true if the command line names all models and outputs by relative paths, as --pack requires. */
static bool packs(const cli_options *o) {
  bool ok = o->target_count > 0;
  for (size_t i = 0; i < o->source_count; i++) ok = ok && o->sources[i].text[0] != '/';
  for (size_t i = 0; i < o->target_count; i++) ok = ok && o->targets[i].path[0] != '/';
  return ok;
}

/* Returns true if the options about clusters, such as --bundle and --join, are given to a command that accepts them.
 * Otherwise prints a message. */
static bool cluster_fits(const cli_options *o) {
  const cli_cluster *c = &o->cluster;
  bool batch = o->command == CLI_COMMAND_render || o->command == CLI_COMMAND_sweep;
  const char *path = o->target_count ? o->targets[0].path : "";
  const char *wrong = NULL;
  if (!batch && (c->on || o->join || o->keep_going || o->keep_failed || o->retries != 2))
    wrong = "--on, --join, --retries, --keep-going and --keep-failed are for vs render and vs sweep";
  else if (!c->on && (c->time || c->memory || c->cpus || c->bundle))
    wrong = "--time, --memory, --cpus and --bundle need --on slurm";
  else if (c->pack && (!c->on || !strcmp(c->on, "local"))) wrong = "--pack is for --on parallel and --on slurm";
  else if (c->pack && !packs(o)) wrong = "with --pack, name the model and the folder of -o by paths from here";
  else if (c->on && (o->only || o->join || o->manifest)) wrong = "give --on without --only, --join and --manifest";
  else if (c->on && o->command == CLI_COMMAND_render && (!*path || path[strlen(path) - 1] != '/'))
    wrong = "--on needs a folder for the pictures that ends in a slash, as in -o film/";
  if (!wrong) return true;
  fprintf(stderr, "vs%s%s: %s\n", batch ? " " : "", batch ? cli_command_rows[o->command - 1].name : "", wrong);
  return false;
}

/* Returns true if --watch can run the command again without input from a person. Otherwise prints a message. */
static bool watch_fits(const cli_options *o) {
  bool stdin_read = false;
  for (size_t i = 0; i < o->source_count; i++) stdin_read = stdin_read || !strcmp(o->sources[i].text, "-");
  bool again = o->command == CLI_COMMAND_render || o->command == CLI_COMMAND_sweep || o->command == CLI_COMMAND_test ||
               (o->command == CLI_COMMAND_NONE && o->target_count > 0 && !o->interactive);
  if (again && !stdin_read && !o->cluster.on) return true;
  fputs("vs: --watch is for vs FILE -o OUT, vs render, vs sweep and vs test, with files and without --on\n", stderr);
  return false;
}

/* Checks --json and --xml. */
static bool reports_fit(const cli_options *o, unsigned takes) {
  if ((o->json && !(takes & CLI_TAKES_JSON)) || (o->xml && !(takes & CLI_TAKES_XML))) {
    unsigned want = o->json && !(takes & CLI_TAKES_JSON) ? CLI_TAKES_JSON : CLI_TAKES_XML;
    fprintf(stderr, "vs: --%s is for", want == CLI_TAKES_JSON ? "json" : "xml");
    for (size_t i = 0, n = 0; i < CLI_COMMANDS; i++)
      if (cli_command_rows[i].takes & want) fprintf(stderr, "%s vs %s", n++ ? "," : "", cli_command_rows[i].name);
    fputs(want == CLI_TAKES_JSON ? "; statistics as JSON are --stats=json\n" : "\n", stderr);
    return false;
  }
  if (o->json && o->xml)
    return refuse("vs: give --json or --xml, not both\n");
  return true;
}

/* Checks the options of vs sunstudy, vs translate, vs search and vs fit. */
static bool own_options_fit(const cli_options *o, unsigned takes) {
  if ((o->place || o->date || o->from || o->step) && !(takes & CLI_TAKES_SUN))
    return refuse("vs: --place, --date, --from and --step are for vs sunstudy\n");
  if (o->language && !(takes & (CLI_TAKES_LANGUAGE | CLI_TAKES_SUN)))
    return refuse("vs: --to is for vs translate\n");
  if (o->index && o->command != CLI_COMMAND_search && o->command != CLI_COMMAND_add)
    return refuse("vs: --index is for vs search and vs add\n");
  const char *of_fit = o->placed       ? "placed"
                       : o->near       ? "near"
                       : o->any_pose   ? "any-pose"
                       : o->held_count ? "hold"
                       : o->points     ? "points"
                                       : NULL;
  if (o->command != CLI_COMMAND_fit && of_fit) {
    fprintf(stderr, "vs: --%s is for vs fit\n", of_fit);
    return false;
  }
  if (o->placed + o->near + o->any_pose > 1)
    return refuse("vs fit: give only one of --placed, --near and --any-pose\n");
  return true;
}

/* Reads the files of --set of vs render. Also reads --only if --frames and --tiles are not given. Returns false after a
 * message. */
static bool pairs_fit(cli_options *o) {
  const char **given = o->sets;
  size_t count = o->set_count;
  o->set_files = sweep_keep(&o->set_memory, count + 1, sizeof *o->set_files);
  if (!o->set_files) return false;
  o->sets = NULL, o->set_count = 0;
  for (size_t i = 0; i < count; i++) {
    const char **all = sweep_is_set_file(given[i]) ? NULL : sweep_keep(&o->set_memory, o->set_count + 1, sizeof *all);
    if (sweep_is_set_file(given[i])) {
      o->set_files[o->set_file_count++] = given[i];
      if (!sweep_set_file_texts(&o->set_memory, given[i], &o->sets, &o->set_count)) return false;
    } else {
      if (!all) return false;
      for (size_t k = 0; k < o->set_count; k++) all[k] = o->sets[k];
      all[o->set_count++] = given[i], o->sets = all;
    }
  }
  o->pairs.from = 1, o->pairs.to = cli_options_parts(o);
  if (!o->only || o->frames.count || o->tiles.columns ||
      cli_range_read(o->only, o->pairs.to, &o->pairs.from, &o->pairs.to)) return true;
  fprintf(stderr, "vs: --only %s: expected numbers of models with their sets, at most 1..%ld\n", o->only, o->pairs.to);
  return false;
}

/* Checks the options of vs render and vs sweep. */
static bool batch_fits(cli_options *o) {
  bool sweeps = o->command == CLI_COMMAND_sweep;
  if (o->command != CLI_COMMAND_render &&
      (((o->set_count || o->jobs || o->sheet) && !sweeps) || o->manifest || o->film)) {
    fputs(sweeps ? "vs sweep: --manifest and --film are for vs render; the manifest is in the folder of -o\n"
                 : "vs: --set, --jobs, --manifest, --sheet and --film are for vs render, and --set, --jobs and --sheet "
                   "for vs sweep\n", stderr);
    return false;
  }
  bool ranged = sweeps || o->frames.count || o->command == CLI_COMMAND_render;
  if (!sweeps && (o->sample || o->seed || o->where || o->sort || (o->only && !ranged))) {
    fputs("vs: --sample, --seed, --where and --sort are for vs sweep, and --only for vs sweep, vs render and "
          "--frames\n", stderr);
    return false;
  }
  if (o->command == CLI_COMMAND_render && !pairs_fit(o)) return false;
  if (o->frames.count && o->only && !cli_range_read(o->only, o->frames.count, &o->frames.from, &o->frames.to)) {
    fprintf(stderr, "vs: --only %s: expected numbers of frames, at most 1..%ld\n", o->only, o->frames.count);
    return false;
  }
  if (!cluster_fits(o) || (o->watch && !watch_fits(o))) return false;
  if (o->tiles.columns && !tiles_fit(o)) return false;
  if (o->film && o->only)
    return refuse("vs render: --film needs all frames: give it without --only, when all parts are done\n");
  return true;
}

/* Finds words that are probably mistyped files or commands, and outputs without -o, as in: vs model.vs a.stl. */
static bool words_fit(const cli_options *o, unsigned takes, const char *first) {
  for (size_t i = 0; !(takes & (CLI_TAKES_PICTURE | CLI_TAKES_WORDS)) && i < o->source_count; i++) {
    const char *path = o->sources[i].text;
    char near[4096];
    if (o->sources[i].kind != CLI_SOURCE_FILE || access(path, F_OK) == 0 ||
        !cli_nearby_program(path, near, sizeof near)) continue;
    fprintf(stderr, "vs: %s: no such file; perhaps %s\n", path, near);
    return false;
  }
  bool file_first = !o->command && o->source_count && o->sources[0].text == first;
  if (file_first && access(first, F_OK) != 0 && !strpbrk(first, "./") && strcmp(first, "-")) {
    if (!cli_command_suggest(first, stderr))
      fprintf(stderr, "vs: %s is neither a command nor a file; vs --help lists the commands\n", first);
    return false;
  }
  for (size_t i = 0; !(takes & (CLI_TAKES_PICTURE | CLI_TAKES_SCAN | CLI_TAKES_WORDS)) && i < o->source_count; i++) {
    const char *path = o->sources[i].text;
    const vs_format_info *f = o->sources[i].kind == CLI_SOURCE_FILE && strchr(path, '.') ? vs_format_find(path) : NULL;
    if (!f || cli_nearby_is_program(path)) continue;
    fprintf(stderr, "vs: %s is a name for an output, not a program; write -o before it: vs", path);
    size_t programs = 0;
    for (size_t k = 0; k < o->source_count; k++)
      if (k != i && o->sources[k].kind == CLI_SOURCE_FILE) programs++, fprintf(stderr, " %s", o->sources[k].text);
    fprintf(stderr, "%s -o %s\n", programs ? "" : " model.vs", path);
    return false;
  }
  return true;
}

/* Sets the folders of libraries, and the value of (command-line). */
static bool set_interpreter(cli_options *o, unsigned takes) {
  const char *folders = getenv("VS_LIBRARY_PATH");
  if (folders && *folders && !cli_add_folders(o, folders)) return false;
  if (!(takes & (CLI_TAKES_WORDS | CLI_TAKES_PICTURE)) && !o->untrusted && !cli_add_packages(o)) return false;
  o->interpreter.library_path = o->library_path;
  for (size_t i = takes & CLI_TAKES_SCAN ? 1 : o->source_count; i-- > 0;)
    if (o->sources[i].kind == CLI_SOURCE_FILE && strcmp(o->sources[i].text, "-") != 0) o->words[0] = o->sources[i].text;
  o->interpreter.command_line = o->words;
  o->interpreter.command_line_count = o->word_count;
  return true;
}

/* Checks the outputs, and finds their formats. */
static bool outputs_fit(cli_options *o, unsigned takes) {
  bool formats = !(takes & (CLI_TAKES_FOLDER | CLI_TAKES_LANGUAGE | CLI_TAKES_MANY | CLI_TAKES_SWEEP));
  for (size_t i = 0; formats && i < o->target_count; i++)
    if (strncmp(cli_file_name(o->targets[i].path), "%.", 2) == 0) {
      fprintf(stderr, "vs: -o %s: the name of a model takes the place of %% in outputs of vs render: vs render",
              o->targets[i].path);
      for (size_t k = 0; k < o->source_count; k++)
        if (o->sources[k].kind == CLI_SOURCE_FILE) fprintf(stderr, " %s", o->sources[k].text);
      fprintf(stderr, " -o %s\n", o->targets[i].path);
      return false;
    }
  for (size_t i = 0; formats && i < o->target_count; i++)
    if (!cli_find_format(o, &o->targets[i]) || !cli_output_reachable(&o->targets[i])) return false;
  for (size_t i = 0; takes & CLI_TAKES_SCAN && i < o->target_count; i++) {
    const vs_format_info *f = vs_format_find(o->targets[i].path);
    if (f && (!strcmp(f->suffix, "ply") || !strcmp(f->suffix, "x3d"))) continue;
    fprintf(stderr,
            "vs fit: %s: the file of -o must end in .ply or .x3d: vs fit writes the map of distances there; to write "
            "the fitted model, run vs FILE with the fitted values by -D\n",
            o->targets[i].path);
    return false;
  }
  if (o->coverage && o->command != CLI_COMMAND_profile) return refuse("vs: --coverage is for vs profile FILE\n");
  bool flames = o->target_count == 1 && o->targets[0].format && !strcmp(o->targets[0].format, "svg");
  if (o->command == CLI_COMMAND_profile && o->target_count && !flames)
    return refuse("vs profile: -o writes the tree of calls: one file, which ends in .svg\n");
  return true;
}

/* Checks --frames, --resume and --film. */
static bool frames_fit(const cli_options *o) {
  if (o->frames.resume && !o->frames.count)
    return refuse("vs: --resume is for --frames\n");
  if (o->frames.count && o->command != CLI_COMMAND_NONE && o->command != CLI_COMMAND_render) {
    fprintf(stderr, "vs %s: --frames is for vs FILE and vs render FILE\n", cli_command_rows[o->command - 1].name);
    return false;
  }
  if (o->film && (!o->frames.count || (o->target_count && !cli_is_png_or_folder(o->targets[0].path))))
    return refuse("vs render: --film is for --frames that are .png pictures\n");
  if (o->frames.resume && o->command == CLI_COMMAND_render)
    return refuse("vs render: --resume works only with vs FILE; vs render finds the frames that are up to date by its "
                  "manifest\n");
  if (o->frames.count && o->command == CLI_COMMAND_NONE && (o->interactive || o->to_stdout || o->target_count == 0)) {
    fputs(o->interactive ? "vs: give --frames or -i, not both\n"
          : "vs: --frames writes files: name them by -o, as in -o tower.png for tower-001.png and so on\n", stderr);
    return false;
  }
  return true;
}

/* Checks the option -d. */
static bool dependencies_fit(const cli_options *o) {
  if (o->dependencies && (o->command != CLI_COMMAND_NONE || o->target_count <= (o->to_stdout ? 1 : 0)))
    return refuse("vs: -d is for vs FILE with -o, as in vs house.vs -o house.stl -d house.d\n");
  for (size_t i = 0; o->dependencies && i < o->target_count; i++)
    if (!strcmp(o->dependencies, o->targets[i].path)) {
      fprintf(stderr, "vs: -d %s: it is an output, too\n", o->dependencies);
      return false;
    }
  if (o->dependencies && !cli_output_reachable(&(cli_target){o->dependencies, NULL})) return false;
  return true;
}

bool cli_options_fit(cli_options *o, char **argv) {
  unsigned takes = o->command ? cli_command_rows[o->command - 1].takes : 0;
  if (!reports_fit(o, takes) || !own_options_fit(o, takes) || !batch_fits(o) || !words_fit(o, takes, argv[1]))
    return false;
  if (o->command != CLI_COMMAND_NONE && !cli_command_files(o, takes)) return false;
  if (o->command == CLI_COMMAND_doc && o->untrusted)
    return refuse("vs doc: --untrusted works only with vs FILE: for its pictures vs doc calls each procedure of the "
                  "program\n");
  if (o->command == CLI_COMMAND_params) o->parameters = o->quiet = true;
  if (!set_interpreter(o, takes) || !outputs_fit(o, takes)) return false;
  if (o->all_views && o->output.view) return refuse("vs: give --all-views or --view, not both\n");
  if (!frames_fit(o) || !dependencies_fit(o)) return false;
  if (o->target_count && o->check) return refuse("vs: --check writes no output: give --check or -o, not both\n");
  if (o->target_count && !o->source_count)
    return refuse("vs: -o needs a model: name its file, or - for standard input\n");
  return true;
}
