/* Declares the states of the parts of a batch, as its manifests list them: sets of `vs sweep`, frames or tiles of
 * `vs render`. */
#ifndef VS_CLI_BATCH_PART_STATES_H
#define VS_CLI_BATCH_PART_STATES_H

#include "cli/options.h"

/* PART_KILLED: a signal, a worker or a full disk has ended the run, which may succeed if it is repeated. PART_FAILED:
 * the model or a limit has ended it, so a repeated run would fail. */
typedef enum { PART_MISSING, PART_DONE, PART_KILLED, PART_FAILED } cli_part_state;
typedef struct cli_part_states {
  cli_part_state *at; size_t count; /* the states of the parts 1 to count, allocated */
  double seconds;        /* mean time of a done part in seconds; 0: none is done */
  int code;              /* exit code of the first part that failed or was killed, or 0 */
} cli_part_states;

/* Returns the state that follows from the exit code of a run. */
cli_part_state cli_part_state_of(int code);
/* Returns the number of parts in this state. */
size_t cli_part_states_count(const cli_part_states *p, cli_part_state state);

/* Reads the manifests of `vs render` in the folder, and sets *out to the states of its parts. The caller frees out->at.
 * Returns false after a message. */
bool cli_part_states_read(const cli_options *o, const char *folder, cli_part_states *out);

/* Writes the path of the folder of a batch with --on, without the slash at its end. Returns false, after a message, if
 * there is none. */
bool cli_part_folder(const cli_options *o, char *out, size_t room);

#endif
