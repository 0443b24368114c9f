/* Owns "perhaps you mean": the nearest of some names, ignoring case. */
#ifndef VS_CLI_NEARBY_H
#define VS_CLI_NEARBY_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
  const char *wanted, *best; /* best: NULL if no offered name was near enough */
  size_t distance;           /* of best */
} cli_nearby;

cli_nearby cli_nearby_start(const char *wanted);
void cli_nearby_offer(cli_nearby *n, const char *name); /* name must outlive n */

/* Writes the path of the program that was probably meant by a path without a file: the nearest name in its folder, or,
 * for a name without an ending, that name with one. Returns false if there is none. */
bool cli_nearby_program(const char *path, char *room, size_t size);

#endif
