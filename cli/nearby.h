/* Owns "perhaps you mean": the nearest of some names, ignoring case. */
#ifndef VS_CLI_NEARBY_H
#define VS_CLI_NEARBY_H

#include <stddef.h>

typedef struct {
  const char *wanted, *best; /* best: NULL if none offered was near enough */
  size_t distance;           /* of best */
} cli_nearby;

cli_nearby cli_nearby_start(const char *wanted);
void cli_nearby_offer(cli_nearby *n, const char *name); /* name must outlive n */

#endif
