/* Declares the search for the name that a user probably meant: the most similar of several names. Upper and lower case
 * are equal. */
#ifndef VS_CLI_NEARBY_H
#define VS_CLI_NEARBY_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
  const char *wanted, *best; /* best: the most similar name so far, or NULL if none was similar enough */
  size_t distance;           /* distance of `best` from `wanted` */
} cli_nearby;

cli_nearby cli_nearby_start(const char *wanted);
void cli_nearby_offer(cli_nearby *n, const char *name); /* Compares a name with n->wanted. The name must exist as long
                                                         * as *n. */

/* Returns true if the name has the ending of a language, as model.vs has. */
bool cli_nearby_is_program(const char *name);

/* Called for a path that does not exist. Writes the path of the file that was probably meant: the most similar name in
 * the same folder, or the same name with a suffix. Returns false if there is no such file. */
bool cli_nearby_program(const char *path, char *room, size_t size);

#endif
