/* Reads the arguments and prints the results of the commands on EXR pictures. */
#include "cli/light/exr_commands.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/json.h"
#include "cli/messages.h"

typedef struct { const cli_options *options; vs_scheme *scheme; cli_reporter reporter; } job;

static void diagnose(void *context, const vs_diagnostic *d) { cli_report_diagnostic(&((job *)context)->reporter, d); }

static const char *file_of(const job *j, size_t i) { return j->options->sources[i].text; }
static const char *target_of(const job *j) { return j->options->target_count ? j->options->targets[0].path : NULL; }

/* Returns true if the path ends in `ending`; upper and lower case are the same. */
static bool has_ending(const char *path, const char *ending) {
  size_t length = strlen(path), have = strlen(ending);
  if (length <= have) return false;
  for (size_t i = 0; i < have; i++)
    if ((path[length - have + i] | 0x20) != (ending[i] | 0x20)) return false;
  return true;
}

static vs_outcome tone(const job *j) {
  double stops = 0;
  vs_outcome outcome = vs_picture_tone(j->scheme, file_of(j, 0), target_of(j), &j->options->output.development, &stops);
  if (outcome == VS_OUTCOME_DONE && !j->options->quiet)
    fprintf(stderr, "%s: exposure %+.2f EV\n", target_of(j), stops + 0.0);
  return outcome;
}

/* Luminance in cd/m2 of the pixel value 1. In our scenes, a white surface that faces the sun has the pixel value 3.2.
 * The sun gives it about 100,000 lx (a high sun in a clear sky), thus 100,000 / pi cd/m2, which is about 3.2 times
 * 10,000. */
enum { CANDELAS_OF_ONE = 10000 };

static double candelas_of_one(const job *j) {
  return j->options->candelas > 0 ? j->options->candelas : CANDELAS_OF_ONE;
}

static vs_outcome false_color(const job *j) {
  double least = 0, most = 0, unit = candelas_of_one(j);
  vs_outcome outcome =
      j->options->lux ? vs_picture_illuminance(j->scheme, file_of(j, 0), target_of(j), unit, &least, &most)
                      : vs_picture_false_color(j->scheme, file_of(j, 0), target_of(j), unit, &least, &most);
  if (outcome == VS_OUTCOME_DONE && !j->options->quiet)
    fprintf(stderr, "%s: %.4g to %.4g %s; the number 1 is %.6g cd/m2\n", target_of(j), least, most,
            j->options->lux ? "lx" : "cd/m2", unit);
  return outcome;
}

static void json_numbers(const char *name, const double *x, int count) {
  printf(",\n  \"%s\": [", name);
  for (int i = 0; i < count; i++) {
    if (i) fputs(", ", stdout);
    cli_json_number(stdout, x[i]);
  }
  putchar(']');
}

static void json_number(const char *name, double x) {
  printf(",\n  \"%s\": ", name);
  cli_json_number(stdout, x);
}

static vs_outcome pick(const job *j) {
  vs_picture_point p;
  long at[2];
  for (size_t i = 0; i < 2; i++) {
    char *end;
    errno = 0;
    at[i] = strtol(file_of(j, i + 1), &end, 10);
    if (*end || end == file_of(j, i + 1) || errno) {
      fprintf(stderr, "vs pick: %s: expected a pixel's column and row, as in vs pick a.exr 320 240\n", file_of(j,
          i + 1));
      return VS_OUTCOME_USAGE;
    }
  }
  vs_outcome outcome = vs_picture_pick(j->scheme, file_of(j, 0), at[0], at[1], &p);
  if (outcome != VS_OUTCOME_DONE) return outcome;
  if (j->options->json) {
    printf("{\n  \"schema\": 1,\n  \"column\": %ld,\n  \"row\": %ld", at[0], at[1]);
    json_numbers("color", p.color, 3);
    if (!isnan(p.depth)) json_number("depth", p.depth);
    if (p.has_normal) json_numbers("normal", p.normal, 3);
    if (p.id >= 0) printf(",\n  \"id\": %ld", p.id);
    if (*p.material) fputs(",\n  \"material\": ", stdout), cli_json_text(stdout, p.material);
    if (!isnan(p.openness)) json_number("openness", p.openness);
    if (!isnan(p.illuminance)) json_number("illuminance", p.illuminance * candelas_of_one(j));
    if (*p.place) fputs(",\n  \"place\": ", stdout), cli_json_text(stdout, p.place);
    puts("\n}");
  } else {
    if (*p.place) printf("%s\n", p.place);
    else if (p.id == 0) puts("nothing of the model");
    printf("light %.6g %.6g %.6g\n", p.color[0], p.color[1], p.color[2]);
    if (!isnan(p.depth)) printf("depth %.6g\n", p.depth);
    if (p.has_normal) printf("normal %.4g %.4g %.4g\n", p.normal[0], p.normal[1], p.normal[2]);
    if (*p.material) printf("material %s\n", p.material);
    if (!isnan(p.openness)) printf("openness %.4g\n", p.openness);
    if (!isnan(p.illuminance)) printf("illuminance %.4g lx\n", p.illuminance * candelas_of_one(j));
  }
  if (p.id == 0 || *p.place) return VS_OUTCOME_DONE;
  fflush(stdout);
  fprintf(stderr,
          p.id < 0
              ? "vs pick: %s has no layer id, and the object at the pixel is unknown; make the picture with --layers\n"
              : "vs pick: %s has no source lines of its objects\n",
          file_of(j, 0));
  return VS_OUTCOME_MODEL;
}

static vs_outcome compare(const job *j) {
  vs_picture_difference d;
  vs_outcome outcome = vs_picture_compare(j->scheme, file_of(j, 0), file_of(j, 1), target_of(j), &d);
  if (outcome != VS_OUTCOME_DONE) return outcome;
  if (!j->options->json) {
    printf("largest %.6g at %ld %ld, mean %.6g, root mean square %.6g\n", d.most, d.column, d.row, d.mean,
           d.root_mean_square);
    if (isinf(d.psnr)) puts("equal");
    else printf("PSNR %.2f dB, structural similarity %.5f\n", d.psnr, d.ssim);
    return outcome;
  }
  printf("{\n  \"schema\": 1,\n  \"columns\": %u,\n  \"rows\": %u", (unsigned)d.columns, (unsigned)d.rows);
  json_number("max", d.most);
  printf(",\n  \"max_at\": [%ld, %ld]", d.column, d.row);
  json_number("mean", d.mean);
  json_number("rms", d.root_mean_square);
  json_number("psnr", d.psnr); /* the number is written as null if it is infinite */
  json_number("ssim", d.ssim);
  puts("\n}");
  return outcome;
}

static vs_outcome denoise(const job *j) {
  bool layers = false;
  vs_outcome outcome = vs_picture_denoise(j->scheme, file_of(j, 0), target_of(j), &layers);
  if (outcome == VS_OUTCOME_DONE && !j->options->quiet && !layers)
    fprintf(stderr,
            "%s: denoised by its colours alone, because the picture has no layers of albedo and normal (--layers "
            "writes them)\n",
            target_of(j));
  return outcome;
}

vs_outcome cli_exr_command(const cli_options *o) {
  job j = {.options = o};
  const char *target = target_of(&j), *wanted = o->command == CLI_COMMAND_denoise ? ".exr" : ".png";
  if (target && !has_ending(target, wanted)) {
    fprintf(stderr, "vs: %s: the output here is a picture that ends in %s\n", target, wanted);
    return VS_OUTCOME_USAGE;
  }
  vs_options interpreter = o->interpreter;
  interpreter.host = (vs_host){.context = &j, .diagnose = diagnose};
  j.scheme = vs_new(&interpreter);
  if (!j.scheme) return fputs("vs: out of memory\n", stderr), VS_OUTCOME_MACHINE;
  vs_outcome outcome = VS_OUTCOME_USAGE;
  if (o->command == CLI_COMMAND_tone) outcome = tone(&j);
  else if (o->command == CLI_COMMAND_falsecolor) outcome = false_color(&j);
  else if (o->command == CLI_COMMAND_pick) outcome = pick(&j);
  else if (o->command == CLI_COMMAND_compare) outcome = compare(&j);
  else outcome = denoise(&j);
  vs_free(j.scheme);
  return outcome;
}
