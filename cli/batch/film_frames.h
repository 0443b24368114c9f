/* Owns the frames of --frames: their numbers, and the values of the changing parameter. */
#ifndef VS_CLI_BATCH_FILM_FRAMES_H
#define VS_CLI_BATCH_FILM_FRAMES_H

#include <stdbool.h>

/* --frames: count runs of the model (0 without --frames), in which the parameter goes in equal steps from `from` to
 * `to`. */
typedef struct { long count; char parameter[64]; double from, to; bool resume; } cli_frames;

enum { CLI_FRAME_ROOM = 40 };
/* Writes the frame's number as names contain it: at least three digits, so that names sort in order. */
void cli_frame_number(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);
/* Writes the parameter's value in a frame: a whole number if the step falls on one, since a parameter may be exact. */
void cli_frame_value(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);

#endif
