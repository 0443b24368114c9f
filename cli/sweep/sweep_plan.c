/* Makes the plan of a sweep from the command line. */
#define _GNU_SOURCE
#include "cli/sweep/sweep_plan.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/batch/part_files.h"
#include "cli/batch/ranges.h"
#include "cli/sweep/samples.h"
#include "model/store/array.h"

enum { PATH_ROOM = 4096, NAME_ROOM = 400 };

/* ---- outputs ---- */

static bool is_folder(const char *path) {
  struct stat is;
  return path[strlen(path) - 1] == '/' || (stat(path, &is) == 0 && S_ISDIR(is.st_mode));
}

static bool is_table(const char *path) {
  const char *dot = strrchr(path, '.');
  return dot && !strcmp(dot, ".csv") && !strchr(path, '%');
}

static bool no_format(const char *path) {
  fprintf(stderr, "vs sweep: %s: no format has this ending; there are %s\n", path, vs_format_endings());
  return false;
}

/* Sets the folder of the sweep. Fails if outputs are in different folders. */
static bool set_folder(sweep_plan *p, const char *path, size_t length) {
  while (length > 1 && path[length - 1] == '/') length--;
  char *folder = sweep_keep_text(&p->memory, path, length);
  if (!folder) return false;
  if (p->folder && strcmp(p->folder, folder) != 0)
    return fprintf(stderr, "vs sweep: give one folder for all outputs, not %s and %s\n", p->folder, folder), false;
  p->folder = folder;
  return true;
}

static sweep_output *new_output(sweep_plan *p) { return &p->outputs[p->output_count++]; }

/* Adds the output of a folder: pictures, or files of --format. */
static bool add_folder(sweep_plan *p, const char *path) {
  const char *name = p->options->format ? p->options->format : "png";
  const vs_format_info *f = vs_format_find(name);
  if (!set_folder(p, path, strlen(path))) return false;
  if (p->options->format && !strcmp(name, "csv")) return true;
  if (!f) return fprintf(stderr, "vs sweep: --format %s: there is no such format; there are %s, and csv for the table "
                                 "alone\n", name, vs_format_endings()), false;
  sweep_output *o = new_output(p);
  char *before = sweep_keep(&p->memory, strlen(p->folder) + 2, 1),
       *after = sweep_keep(&p->memory, strlen(f->suffix) + 2, 1);
  if (!before || !after) return false;
  sprintf(before, "%s/", p->folder);
  sprintf(after, ".%s", f->suffix);
  *o = (sweep_output){before, after, f->name};
  return true;
}

/* Adds the output of a pattern such as out/%.stl. */
static bool add_pattern(sweep_plan *p, const char *path) {
  const char *percent = strchr(path, '%'), *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
  if (!slash || slash > percent || slash == path) {
    fprintf(stderr, "vs sweep: %s: give a folder for the outputs, as in -o out/ or -o 'out/%%.stl'\n", path);
    return false;
  }
  const vs_format_info *said = p->options->format ? vs_format_find(p->options->format) : NULL,
                       *own = dot && dot > slash ? vs_format_find(dot) : NULL;
  if (own && said && !strcmp(said->suffix, own->suffix)) own = said;
  if (!own) own = said;
  if (!own) return no_format(path);
  sweep_output *o = new_output(p);
  o->before = sweep_keep_text(&p->memory, path, (size_t)(percent - path));
  o->after = sweep_keep_text(&p->memory, percent + 1, strlen(percent + 1));
  o->format = own->name;
  return o->before && o->after && set_folder(p, path, (size_t)(slash - path));
}

static bool add_outputs(sweep_plan *p) {
  const cli_options *o = p->options;
  p->outputs = sweep_keep(&p->memory, o->target_count + 1, sizeof *p->outputs);
  if (!p->outputs) return false;
  for (size_t i = 0; i < o->target_count; i++) {
    const char *path = o->targets[i].path;
    if (is_table(path)) p->table_path = path;
    else if (strchr(path, '%')) {
      if (!add_pattern(p, path)) return false;
    } else if (is_folder(path) || !strchr(path, '.')) {
      if (!add_folder(p, path)) return false;
    } else
      return fprintf(stderr, "vs sweep: %s: a sweep has many outputs: write -o out/ for a folder, or -o 'out/%%%s'\n",
                     path, strrchr(path, '.')), false;
  }
  for (size_t i = 0; i < p->output_count; i++)
    for (size_t k = 0; k < i; k++)
      if (!strcmp(p->outputs[i].before, p->outputs[k].before) && !strcmp(p->outputs[i].after, p->outputs[k].after))
        return fprintf(stderr, "vs sweep: two outputs have the name %s%%%s\n", p->outputs[i].before,
                       p->outputs[i].after),
               false;
  return true;
}

static const char *in_folder(sweep_plan *p, const char *name) {
  char *path = sweep_keep(&p->memory, strlen(p->folder) + strlen(name) + 2, 1);
  if (path) sprintf(path, "%s/%s", p->folder, name);
  return path;
}

/* Makes the folder if it is missing, and names the files of the sweep in it. */
static bool name_files(sweep_plan *p) {
  struct stat is;
  p->sheet_path = p->options->sheet;
  if (!p->folder) return true;
  if (!(stat(p->folder, &is) == 0 && S_ISDIR(is.st_mode)) && mkdir(p->folder, 0777) != 0)
    return fprintf(stderr, "vs sweep: the folder %s cannot be made: %s\n", p->folder, strerror(errno)), false;
  if (!p->table_path && !(p->table_path = in_folder(p, "results.csv"))) return false;
  if (!p->sheet_path && p->output_count && !(p->sheet_path = in_folder(p, "index.html"))) return false;
  return true;
}

/* ---- parts ---- */

static int by_name(const void *a, const void *b) {
  const sweep_part *x = *(sweep_part *const *)a, *y = *(sweep_part *const *)b;
  int order = strcmp(x->name, y->name);
  return order ? order : x < y ? -1 : x > y;
}

/* Returns the hash of the options that determine a part's results, without its set and the contents of files. */
static uint64_t hash_options(const sweep_plan *p) {
  const cli_options *o = p->options;
  const char *version = vs_version(), *folders = o->library_path ? o->library_path : "";
  uint64_t h = cli_part_hash(CLI_HASH_BEGIN, version, strlen(version) + 1);
  h = cli_part_hash(h, o->sources[0].text, strlen(o->sources[0].text) + 1);
  h = cli_part_hash(h, folders, strlen(folders) + 1);
  if (o->output.view) h = cli_part_hash(h, o->output.view, strlen(o->output.view) + 1);
  for (size_t i = 0; i < o->passed_count; i++) h = cli_part_hash(h, o->passed[i], strlen(o->passed[i]) + 1);
  for (size_t i = 0; i < o->word_count; i++) h = cli_part_hash(h, o->words[i], strlen(o->words[i]) + 1);
  for (size_t i = 0; i < p->output_count; i++) {
    const sweep_output *out = &p->outputs[i];
    h = cli_part_hash(h, out->before, strlen(out->before) + 1);
    h = cli_part_hash(h, out->after, strlen(out->after) + 1);
    h = cli_part_hash(h, out->format, strlen(out->format) + 1);
  }
  return h;
}

/* Names the part and its outputs by its set. */
static bool name_part(sweep_plan *p, sweep_part *part, uint64_t options) {
  char name[NAME_ROOM] = "", *set = NULL;
  size_t size;
  FILE *to = open_memstream(&set, &size);
  if (!to) return sweep_no_memory();
  part->key = options;
  for (size_t i = 0; i < part->set.count; i++) {
    const sweep_setting *s = &part->set.at[i];
    fprintf(to, "%s%s=%s", i ? "," : "", s->name, s->value);
    part->key = cli_part_hash(part->key, s->name, strlen(s->name) + 1);
    part->key = cli_part_hash(part->key, s->value, strlen(s->value) + 1);
  }
  if (fclose(to) != 0) return sweep_no_memory();
  cli_part_put_word(name, NAME_ROOM - 150, p->options->sources[0].text, true);
  if (*set) strcat(name, "-"), cli_part_put_set(name, NAME_ROOM, set);
  free(set);
  part->name = sweep_keep_text(&p->memory, name, strlen(name));
  part->files = sweep_keep(&p->memory, p->output_count + 1, sizeof *part->files);
  if (!part->name || !part->files) return false;
  part->file_count = p->output_count;
  for (size_t i = 0; i < p->output_count; i++) {
    const sweep_output *out = &p->outputs[i];
    char *path = sweep_keep(&p->memory, strlen(out->before) + strlen(name) + strlen(out->after) + 1, 1);
    if (!path) return false;
    sprintf(path, "%s%s%s", out->before, name, out->after);
    part->files[i] = (sweep_file){path, 0};
  }
  return true;
}

/* Finds parts with equal sets, which run once. Refuses different sets with one name. */
static bool find_same(sweep_table *t) {
  sweep_part **order;
  bool ok = true;
  if (!VS_FRESH(order, t->count)) return sweep_no_memory();
  for (size_t i = 0; i < t->count; i++) order[i] = &t->parts[i], t->parts[i].same = i;
  qsort(order, t->count, sizeof *order, by_name);
  for (size_t i = 1; ok && i < t->count; i++) {
    if (strcmp(order[i]->name, order[i - 1]->name) != 0) continue;
    ok = order[i]->key == order[i - 1]->key;
    if (ok) order[i]->same = order[i - 1]->same;
    else fprintf(stderr, "vs sweep: %s would be the name of two sets of parameters\n", order[i]->name);
  }
  free(order);
  return ok;
}

static bool add_column(sweep_table *t, const char *name) {
  for (size_t i = 0; i < t->column_count; i++)
    if (!strcmp(t->columns[i], name)) return true;
  if (!VS_GROW(t->columns, t->column_room, t->column_count + 1)) return sweep_no_memory();
  t->columns[t->column_count++] = name;
  return true;
}

static bool add_parts(sweep_plan *p, const sweep_sample *s) {
  sweep_table *t = &p->table;
  sweep_set *sets;
  uint64_t options = hash_options(p);
  if (!sweep_choose(&p->axes, s, &sets, &t->count)) return false;
  t->parts = sweep_keep(&p->memory, t->count, sizeof *t->parts);
  for (size_t i = 0; t->parts && i < t->count; i++) {
    t->parts[i] = (sweep_part){.set = sets[i]};
    if (!name_part(p, &t->parts[i], options)) return false;
    for (size_t k = 0; k < sets[i].count; k++)
      if (!add_column(t, sets[i].at[k].name)) return false;
  }
  return t->parts && find_same(t);
}

/* ---- the range of --only ---- */

static bool read_only(sweep_plan *p) {
  const char *text = p->options->only;
  char name[64];
  long from, to;
  p->from = 0, p->to = p->table.count;
  if (!text) return true;
  if (!cli_range_read(text, (long)p->table.count, &from, &to)) {
    fprintf(stderr, "vs sweep: --only %s: expected numbers of sets, at most 1..%zu\n", text, p->table.count);
    return false;
  }
  p->from = (size_t)from - 1;
  p->to = (size_t)to;
  snprintf(name, sizeof name, "%ld..%ld", from, to);
  return (p->only = sweep_keep_text(&p->memory, name, strlen(name))) != NULL;
}

static bool read_sample(const cli_options *o, sweep_sample *s) {
  *s = (sweep_sample){.seed = o->seed};
  if (!o->sample || sweep_sample_read(o->sample, s)) return true;
  return fprintf(stderr, "vs sweep: --sample %s: expected lhs:COUNT or sobol:COUNT, COUNT from 1 to %d\n", o->sample,
                 SWEEP_MOST), false;
}

bool sweep_plan_make(sweep_plan *p, const cli_options *o) {
  sweep_sample sample;
  *p = (sweep_plan){.options = o};
  p->axes.memory = p->table.memory = &p->memory;
  if (!o->set_count) {
    fputs("vs sweep: give the values of parameters by --set, as in --set n=1..10:2 or --set x=0..1/8\n", stderr);
    return false;
  }
  if (!read_sample(o, &sample)) return false;
  for (size_t i = 0; i < o->set_count; i++)
    if (!sweep_axes_add(&p->axes, o->sets[i], sample.how != SWEEP_ALL)) return false;
  return add_outputs(p) && add_parts(p, &sample) && read_only(p) && name_files(p);
}

void sweep_plan_free(sweep_plan *p) {
  sweep_axes_free(&p->axes);
  free(p->table.columns), free(p->table.numbers);
  sweep_memory_free(&p->memory);
}
