/* Computes the names of the frames of --frames (a sequence of pictures), and the values of the parameter that changes.
 * Makes films of the frames (H.264 in .mp4) by ffmpeg. */
#define _GNU_SOURCE
#include "cli/batch/film.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATH_ROOM = 4096, NUMBER_ROOM = 24, NO_FFMPEG = 127 };

/* Returns the length of a frame's name without its end "-001.png". */
static size_t stem_of(const char *first) {
  const char *dash = strrchr(first, '-');
  return dash ? (size_t)(dash - first) : strlen(first);
}

/* Writes the pattern of the frames' names for ffmpeg: each % in the name is doubled, and the number becomes %03d. */
static bool put_pattern(const char *first, char *out, size_t room) {
  size_t stem = stem_of(first), used = (size_t)snprintf(out, room, "file:");
  for (size_t i = 0; i < stem && used + NUMBER_ROOM + 2 < room; i++) {
    if (first[i] == '%') out[used++] = '%';
    out[used++] = first[i];
  }
  size_t digits = strspn(first + stem + (first[stem] == '-'), "0123456789");
  snprintf(out + used, room - used, "-%%0%zud.png", digits);
  return used + NUMBER_ROOM + 2 < room;
}

/* Runs ffmpeg and returns its exit code. Pads the pictures to even sizes, which H.264 requires. The option bitexact
 * keeps ffmpeg's version out of the film's file. */
static int run_ffmpeg(const cli_film *f, const char *part) {
  char rate[NUMBER_ROOM], number[NUMBER_ROOM], from[2 * PATH_ROOM], to[PATH_ROOM + NUMBER_ROOM];
  const char *digits = f->first + stem_of(f->first);
  int status = 0;
  snprintf(rate, sizeof rate, "%ld", f->rate);
  snprintf(number, sizeof number, "%.*s", *digits ? (int)strspn(digits + 1, "0123456789") : 0, digits + 1);
  snprintf(to, sizeof to, "file:%s", part);
  if (!put_pattern(f->first, from, sizeof from)) return 1;
  pid_t child = fork();
  if (child == 0) {
    execlp("ffmpeg", "ffmpeg", "-nostdin", "-y", "-loglevel", "error", "-framerate", rate, "-start_number", number,
           "-f", "image2", "-i", from, "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-fflags",
           "+bitexact", "-flags:v", "+bitexact", "-f", "mp4", to, (char *)NULL);
    _exit(NO_FFMPEG);
  }
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

void cli_film_name(const char *first, char *name, size_t room) {
  snprintf(name, room, "%.*s.mp4", (int)stem_of(first), first);
}

vs_outcome cli_film_make(const cli_film *f) {
  char name[PATH_ROOM], part[PATH_ROOM + 8];
  struct stat is;
  cli_film_name(f->first, name, sizeof name);
  if (f->stands && stat(name, &is) == 0) {
    if (!f->quiet) printf("%s: up to date\n", name);
    return VS_OUTCOME_DONE;
  }
  snprintf(part, sizeof part, "%s.part", name);
  int code = run_ffmpeg(f, part);
  if (code == 0 && rename(part, name) == 0) {
    if (!f->quiet) printf("%s: a film of %zu frames\n", name, f->count);
    return VS_OUTCOME_DONE;
  }
  remove(part);
  fprintf(stderr,
          code == NO_FFMPEG
              ? "vs render: %s: the film needs ffmpeg: install the package ffmpeg; all frames were written\n"
              : "vs render: %s: ffmpeg failed: there is no film\n",
          name);
  return VS_OUTCOME_WORKER;
}

/* ---- numbers and values of frames ---- */

void cli_frame_number(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]) {
  int digits = snprintf(out, CLI_FRAME_ROOM, "%ld", f->count);
  snprintf(out, CLI_FRAME_ROOM, "%0*ld", digits < 3 ? 3 : digits, frame);
}

void cli_frame_value(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]) {
  double x = f->count > 1 ? f->from_value + (f->to_value - f->from_value) * (double)(frame - 1) / (double)(f->count - 1)
                          : f->from_value;
  if (x == floor(x) && fabs(x) < 1e15) snprintf(out, CLI_FRAME_ROOM, "%.0f", x + 0.0);
  else snprintf(out, CLI_FRAME_ROOM, "%.17g", x);
}
