/* Declares the reading of sets of parameters from files in CSV or JSON. */
#ifndef VS_CLI_SWEEP_SET_FILES_H
#define VS_CLI_SWEEP_SET_FILES_H

#include "cli/sweep/parameter_axes.h"

/* Returns true if the value of --set is the name of a file: it ends in .csv or .json, and has no '='. */
bool sweep_is_set_file(const char *text);
/* Reads the sets of the file into the axis. Returns false after a message. */
bool sweep_set_file_read(sweep_memory *m, const char *path, sweep_axis *axis);

/* Appends the sets of the file to *sets as texts "a=1,b=2", in the memory m. Returns false after a message. */
bool sweep_set_file_texts(sweep_memory *m, const char *path, const char ***sets, size_t *count);

#endif
