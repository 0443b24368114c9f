/* Declares the states of the sets of a sweep. */
#ifndef VS_CLI_SWEEP_SWEEP_STATES_H
#define VS_CLI_SWEEP_SWEEP_STATES_H

#include "cli/batch/part_states.h"

/* Reads the manifests in the folder, and sets *out to the states of the sets. The caller frees out->at. Returns false
 * after a message. */
bool cli_sweep_states(const cli_options *o, const char *folder, cli_part_states *out);

#endif
