/* Declares the frames of --frames, and films of them. */
#ifndef VS_CLI_BATCH_FILM_H
#define VS_CLI_BATCH_FILM_H

#include <stdbool.h>
#include <stddef.h>

#include "visualscheme.h"

/* The option --frames: the model runs `count` times (0 without the option), and the parameter changes in equal steps
 * from from_value to to_value. */
typedef struct {
  long count;
  char parameter[64];
  double from_value, to_value;
  long from, to; /* the frames to make, from 1 to count without --only; 0 and 0 without --frames */
  bool resume;
} cli_frames;

/* The option --tiles: the picture is made in columns times rows tiles, and these are joined. Without the option,
 * columns is 0. from, to: first and last tile to make, counted from 1. */
typedef struct { long columns, rows, from, to; } cli_tiles;

enum { CLI_FRAME_ROOM = 40 };
/* Writes the frame's number for a file name: with at least three digits, so that names sort in order. */
void cli_frame_number(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);
/* Writes the parameter's value in a frame. A value that is a whole number is written as an integer, since the parameter
 * may require an exact number. */
void cli_frame_value(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);

typedef struct {
  const char *first; /* name of the first frame, such as tower-001.png; those of the other frames have consecutive
                      * numbers */
  size_t count;
  long rate;         /* frames per second */
  bool stands;       /* whether no frame has changed since the last film, so that an existing film is kept */
  bool quiet;
} cli_film;

/* Writes the name of the film: tower.mp4 for tower-001.png. */
void cli_film_name(const char *first, char *name, size_t room);
/* Makes the film (tower.mp4) from the frames by ffmpeg, and prints its name. If it fails, prints a message on standard
 * error and returns VS_OUTCOME_WORKER. */
vs_outcome cli_film_make(const cli_film *film);

#endif
