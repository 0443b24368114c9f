/* Owns "perhaps you mean": the nearest of some names, ignoring case. */
#ifndef VS_CLI_NEARBY_H
#define VS_CLI_NEARBY_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
  const char *wanted, *best; /* best: NULL if none offered was near enough */
  size_t distance;           /* of best */
} cli_nearby;

cli_nearby cli_nearby_start(const char *wanted);
void cli_nearby_offer(cli_nearby *n, const char *name); /* name must outlive n */

/* Puts the path of the program that was meant by a path where there is no file into `room`: the nearest name in its
 * folder, or, of a name without an ending, that name with one. False: there is none. */
bool cli_nearby_program(const char *path, char *room, size_t size);

#endif
