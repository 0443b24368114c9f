/* Owns the frames of --frames: their numbers, and the values of the changing parameter. */
#include "cli/batch/film_frames.h"

#include <math.h>
#include <stdio.h>

void cli_frame_number(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]) {
  int digits = snprintf(out, CLI_FRAME_ROOM, "%ld", f->count);
  snprintf(out, CLI_FRAME_ROOM, "%0*ld", digits < 3 ? 3 : digits, frame);
}

void cli_frame_value(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]) {
  double x = f->count > 1 ? f->from + (f->to - f->from) * (double)(frame - 1) / (double)(f->count - 1) : f->from;
  if (x == floor(x) && fabs(x) < 1e15) snprintf(out, CLI_FRAME_ROOM, "%.0f", x + 0.0);
  else snprintf(out, CLI_FRAME_ROOM, "%.17g", x);
}
