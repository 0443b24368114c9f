/* Declares films of numbered pictures. */
#ifndef VS_CLI_BATCH_FILM_H
#define VS_CLI_BATCH_FILM_H

#include <stddef.h>

#include "visualscheme.h"

typedef struct {
  const char *first; /* tower-001.png: the others are numbered on from it */
  size_t count;
  long rate;         /* frames a second */
  bool stands;       /* no frame is new: a film that is there is left as it is */
  bool quiet;
} cli_film;

/* Makes tower.mp4 of them by ffmpeg, and says so. A failure is said on standard error: VS_OUTCOME_WORKER. */
vs_outcome cli_film_make(const cli_film *film);

#endif
