/* Owns films of numbered pictures. */
#ifndef VS_CLI_BATCH_FILM_H
#define VS_CLI_BATCH_FILM_H

#include <stddef.h>

#include "visualscheme.h"

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
