/* Declares the frames of --frames: their numbers and the values of the parameter that changes. */
#ifndef VS_CLI_BATCH_FILM_FRAMES_H
#define VS_CLI_BATCH_FILM_FRAMES_H

#include <stdbool.h>

/* --frames: count runs of the model, 0 without it, in which the parameter goes in equal steps from `from` to `to`. */
typedef struct { long count; char parameter[64]; double from, to; bool resume; } cli_frames;

enum { CLI_FRAME_ROOM = 40 };
/* The frame's number as it stands in a name: three figures at least, so that the names stand in order. */
void cli_frame_number(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);
/* The parameter's value in a frame: a whole number where the step falls on one, since a parameter may be exact. */
void cli_frame_value(const cli_frames *f, long frame, char out[CLI_FRAME_ROOM]);

#endif
