/* Owns the frames of --frames, and films of them. */
#ifndef VS_CLI_BATCH_FILM_H
#define VS_CLI_BATCH_FILM_H

#include <stdbool.h>
#include <stddef.h>

#include "visualscheme.h"

/* --frames: count runs of the model (0 without --frames), in which the parameter goes in equal steps from `from` to
 * `to`. */
typedef struct { long count; char parameter[64]; double from, to; bool resume; } cli_frames;

enum { CLI_FRAME_ROOM = 40 };
/* Writes the frame's number as names contain it: at least three digits, so that names sort in order. */
void cli_frame_number(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);
/* Writes the parameter's value in a frame: a whole number if the step falls on one, since a parameter may be exact. */
void cli_frame_value(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);

typedef struct {
  const char *first; /* tower-001.png; the others count on from it */
  size_t count;
  long rate;         /* frames a second */
  bool stands;       /* no frame is new: an existing film stays */
  bool quiet;
} cli_film;

/* Writes the film's name, tower.mp4 for tower-001.png. */
void cli_film_name(const char *first, char *name, size_t room);
/* Makes tower.mp4 of the frames by ffmpeg, and prints its name. Returns VS_OUTCOME_WORKER on failure, after a message
 * on standard error. */
vs_outcome cli_film_make(const cli_film *film);

#endif
